// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The body below plants: dark, as what is seen between leaves is; where they have melted into one, their colour.
#include "common_light.glsl"
#include "common_mesh_color.glsl"

layout(location = 0) in vec3 body_point;
layout(location = 1) in vec3 body_normal;
layout(location = 2) in vec3 body_color;

layout(location = 1) uniform vec2 body_cover;  // where plants end (m, times zoom); share of the light between them

layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(body_normal);
  float melted = smoothstep(0.02, 0.6, length(body_point) / body_cover.x);
  float light = mix(body_cover.y, 1.0, melted);
  vec3 albedo = mesh_albedo(body_color, body_point);
  color = vec4(encode_output(shade_ground(albedo * light, normal, body_point, light)), 1.0);
}
