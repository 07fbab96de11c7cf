// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding, third pass: a row of bin sizes for each work group.
#include "common_seeding.glsl"

layout(local_size_x = 256) in;

shared uint bin_sizes[k_bins];

void main() {
  if (gl_LocalInvocationIndex < k_bins) bin_sizes[gl_LocalInvocationIndex] = 0u;
  barrier();
  uint index = gl_GlobalInvocationID.x;
  if (index < candidates()) {
    uint submitted = seed_counts[index].x;
    if (submitted > 0u) atomicAdd(bin_sizes[bin_of(submitted)], 1u);
  }
  barrier();
  if (gl_LocalInvocationIndex < k_bins)
    seed_groups[gl_WorkGroupID.x * k_bins + gl_LocalInvocationIndex] = bin_sizes[gl_LocalInvocationIndex];
}
