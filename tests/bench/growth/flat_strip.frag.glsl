// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// For the benchmark of growth: the strips of grass_blade.geom in one colour, with the plant's own samples.
#include "common_frame.glsl"
#include "common_cover.glsl"

#define SWARD_LINK in
#include "common_strip_links.glsl"
layout(location = 0) out vec4 color;

void main() {
  int mask = k_all_samples;
  if (frame.eye_noise.w > 1.0) mask = coverage_mask(strip_place.z, strip_self.x);
  else if (hidden_by_hash(strip_place.z, strip_self.x, strip_place.x)) mask = 0;
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(0.25, 0.35, 0.15, 1.0);
}
