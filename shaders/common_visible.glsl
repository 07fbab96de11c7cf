// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What is worth drawing: frustum, reach of shadows. GLSL only.
#include "common_frame.glsl"
#include "common_layer.glsl"

// Longest planar shadow, in heights of what casts it.
const float k_longest_shadow = 3.0;

// 0..1: how dark shadows at this distance are; they fade towards the layer's shadow distance and as the sun sets.
float shadow_strength(LayerParams layer, float distance) {
  float reach = layer.detail.y;
  if (reach <= 0.0 || frame.sun_direction.z <= 0.0) return 0.0;
  return frame.sun_direction.w * (1.0 - smoothstep(0.1 * reach, 0.8 * reach, distance));
}

float shadow_reach(LayerParams layer, float distance) {
  return SWARD_GROWTH_INVOCATIONS > 1 && shadow_strength(layer, distance) > 0.0 ? k_longest_shadow : 0.0;
}

vec4 clip_row(int i) {
  mat4 m = frame.clip_from_relative;
  return vec4(m[0][i], m[1][i], m[2][i], m[3][i]);
}

bool beyond(vec4 plane, vec3 centre, float radius) {
  return dot(plane.xyz, centre) + plane.w < -radius * length(plane.xyz);
}

// Against the sides and what lies behind the eye; the near and far planes, which may be reversed or infinite, are left
// to clipping.
bool sphere_visible(vec3 centre, float radius) {
  vec4 x = clip_row(0), y = clip_row(1), w = clip_row(3);
  return !(beyond(w, centre, radius) || beyond(w + x, centre, radius) || beyond(w - x, centre, radius) ||
           beyond(w + y, centre, radius) || beyond(w - y, centre, radius));
}
