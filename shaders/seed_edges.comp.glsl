// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding, second pass: upper edges of the bins, e_i = n_min (n_max / n_min)^((i + 1) / 32), the last n_max itself.
#include "common_seeding.glsl"

layout(local_size_x = 32) in;

void main() {
  uint i = gl_LocalInvocationIndex;
  float least = float(seed_frame.n_min), most = float(seed_frame.n_max);
  if (seed_frame.n_max == 0u) least = 1.0;
  float ratio = max(most, 1.0) / least;
  seed_frame.edges[i] = i == k_bins - 1u ? most : least * pow(ratio, float(i + 1u) / float(k_bins));
}
