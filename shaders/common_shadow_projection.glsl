// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The light's way onto a plane. GLSL only.
#include "common_frame.glsl"
#include "common_visible.glsl"

// Shadows lie this much of their distance before the ground, so that depth tells them apart.
const float k_shadow_lift = 0.0012;

// Where the light through a point above the plane meets it, as a matrix for directions. Low suns are cut to the longest
// shadow.
mat3 shadow_projection(vec3 plane) {
  vec3 sun = frame.sun_direction.xyz;
  float facing = dot(plane, sun);
  vec3 level = sun - plane * facing;
  float reach = min(length(level) / facing, k_longest_shadow);
  vec3 slide = reach * level / max(length(level), 1.0e-4);
  return mat3(1.0) - outerProduct(plane + slide, plane);
}
