// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The colour of a mesh that plants stand on, with the unevenness that its vertices are too far apart for. GLSL only.
#include "common_frame.glsl"
#include "common_noise.glsl"

vec3 srgb_decode(vec3 encoded) {
  vec3 low = encoded / 12.92;
  vec3 high = pow((encoded + 0.055) / 1.055, vec3(2.4));
  return mix(low, high, greaterThan(encoded, vec3(0.04045)));
}

// `encoded`: sRGB; `point`: relative to the eye. The pattern is one of space, looked at along a direction that no wall
// or level has: so it goes on around edges.
vec3 mesh_albedo(vec3 encoded, vec3 point) {
  vec2 p = frame.eye_noise.xy + point.xy + vec2(0.71, -0.59) * (frame.eye_noise.z + point.z);
  float broad = ground_noise(p, 2.0, 31u).x;
  float fine = ground_noise(p, 8.0, 32u).x;
  float shade = 1.0 + 0.35 * broad + 0.30 * fine;
  return srgb_decode(encoded) * max(shade, 0.3) * vec3(1.0 + 0.22 * broad, 1.0, 1.0 - 0.18 * broad);
}
