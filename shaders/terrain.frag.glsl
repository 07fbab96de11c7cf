// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Base map and slope map, lit. Map coordinates come from the position relative to the eye and offsets that the CPU
// computed in double precision.
#include "common_light.glsl"
#include "common_ground.glsl"

layout(location = 0) in vec3 relative_position;
layout(location = 1) in vec2 relief;

layout(location = 1) uniform vec4 base_map_transform;   // uv = xy * relative + zw
layout(location = 2) uniform vec4 slope_map_transform;
layout(location = 3) uniform vec4 data_rectangle;       // west, south, east, north of the data, relative to the eye

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D base_map;
layout(binding = SWARD_BINDING_SLOPE_MAP) uniform sampler2D slope_map;

layout(location = 0) out vec4 color;

void main() {
  vec2 xy = relative_position.xy;
  vec2 slope = texture(slope_map, xy * slope_map_transform.xy + slope_map_transform.zw).rg;
  // Far away the mesh is coarser than the relief, whose slope at single vertices then says nothing about the surface.
  slope += relief * (1.0 - smoothstep(80.0, 500.0, length(relative_position) / max(frame.focal.z, 0.1)));
  vec3 normal = normalize(vec3(-slope, 1.0));
  GroundDetail detail = ground_detail(relative_position, normal);
  vec3 albedo = ground_albedo(base_map, xy * base_map_transform.xy + base_map_transform.zw, detail);
  if (any(lessThan(xy, data_rectangle.xy)) || any(greaterThan(xy, data_rectangle.zw))) discard;
  vec3 rough_normal = normalize(vec3(-slope - detail.slope, 1.0));
  color = vec4(encode_output(shade_ground(albedo, rough_normal, relative_position, 1.0)), 1.0);
}
