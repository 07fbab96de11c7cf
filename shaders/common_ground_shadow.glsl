// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Shadows on the ground, shaded as the ground itself without its sun, so that overlapping ones do not darken twice.
// GLSL only.
#include "common_light.glsl"
#include "common_ground.glsl"
#include "common_layer.glsl"
#include "common_shadow_light.glsl"

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D sward_base_map;

// The ground at `point` (relative to the eye). `uv_at_eye`: base map coordinates below the eye; `normal`: of the drawn
// surface; `open`: share of all light, `sun`: share of the sun's that comes here.
vec3 darkened_ground(vec3 point, vec2 uv_at_eye, vec3 normal, float open, float sun) {
  vec2 uv = uv_at_eye + point.xy * sward_layer.layer.map.xy / sward_layer.layer.map.zw;
  GroundDetail detail = ground_detail(point, normal);
  vec3 albedo = ground_albedo(sward_base_map, uv, detail) * open;
  vec3 rough_normal = normalize(vec3(normal.xy / normal.z - detail.slope, 1.0));
  return shade_ground(albedo, rough_normal, point, sun);
}
