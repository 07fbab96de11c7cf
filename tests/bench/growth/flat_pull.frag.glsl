// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// For the benchmark of growth: one colour, the plant's own samples.
#include "common_frame.glsl"
#include "common_cover.glsl"

layout(location = 0) in vec4 flat_cover;
layout(location = 1) flat in vec4 flat_color;
layout(location = 0) out vec4 color;

void main() {
  int mask = k_all_samples;
  if (frame.eye_noise.w > 1.0) mask = coverage_mask(flat_cover.x, flat_cover.y);
  else if (hidden_by_hash(flat_cover.x, flat_cover.y, flat_cover.z)) mask = 0;
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(flat_color.rgb, 1.0);
}
