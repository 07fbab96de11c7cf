// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// For the benchmark of growth: the strips of grass_blade.geom in one colour, with the plant's own samples.
#include "common_frame.glsl"
#include "common_cover.glsl"

layout(location = 0) in vec4 strip_point;
layout(location = 2) in vec2 strip_cover;
layout(location = 3) flat in vec4 strip_color;
layout(location = 5) flat in vec4 strip_self;
layout(location = 0) out vec4 color;

void main() {
  int mask = k_all_samples;
  if (frame.eye_noise.w > 1.0) mask = coverage_mask(strip_cover.x, strip_self.z);
  else if (hidden_by_hash(strip_cover.x, strip_self.z, strip_point)) mask = 0;
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(strip_color.rgb, 1.0);
}
