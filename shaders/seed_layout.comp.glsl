// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding, fourth pass, one work group: bins one after the other, in each the groups in order; and a draw for each bin.
// A row of 32 threads takes a run of groups, a thread one bin of them.
#include "common_seeding.glsl"

layout(local_size_x = 1024) in;

const uint k_runs = 32u;

shared uint sizes[k_runs * k_bins];
shared uint totals[k_bins];

void main() {
  uint bin = gl_LocalInvocationIndex % k_bins, run = gl_LocalInvocationIndex / k_bins;
  uint groups = uint(sward_seeding.level.w), a_run = (groups + k_runs - 1u) / k_runs;
  uint begin = min(run * a_run, groups), end = min(begin + a_run, groups);
  uint size = 0u;
  for (uint group = begin; group < end; ++group) size += seed_groups[group * k_bins + bin];
  sizes[run * k_bins + bin] = size;
  barrier();
  if (run == 0u) {
    uint total = 0u;
    for (uint i = 0u; i < k_runs; ++i) {
      uint of_run = sizes[i * k_bins + bin];
      sizes[i * k_bins + bin] = total;
      total += of_run;
    }
    totals[bin] = total;
  }
  barrier();
  uint first = 0u;
  for (uint i = 0u; i < bin; ++i) first += totals[i];
  uint next = first + sizes[run * k_bins + bin];
  for (uint group = begin; group < end; ++group) {
    uint of_group = seed_groups[group * k_bins + bin];
    seed_groups[group * k_bins + bin] = next;
    next += of_group;
  }
  if (run != 0u) return;
  uint clusters = 0u;
  if (totals[bin] > 0u) clusters = uint(ceil(seed_frame.edges[k_bins - 1u - bin] / sward_seeding.reach.y));
  seed_frame.commands[bin] = DrawCommand(totals[bin], clusters, first, 0u);
  atomicAdd(seed_frame.clusters, totals[bin] * clusters);
}
