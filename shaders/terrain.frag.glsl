// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Base map and slope map, lit. Map coordinates come from the position relative to the eye and offsets that the CPU
// computed in double precision.
#include "common_light.glsl"
#include "common_ground.glsl"

layout(location = 0) in vec3 relative_position;
layout(location = 1) in vec2 relief;

layout(location = 1) uniform vec4 base_map_transform;   // uv = xy * relative + zw
layout(location = 2) uniform vec4 slope_windows;        // samples a metre in x, y; reach of layer 0 in samples; layers
layout(location = 3) uniform vec4 data_rectangle;       // west, south, east, north of the data, relative to the eye
layout(location = 5) uniform vec4 slope_map_transform[12];  // by layer, as the base map's

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D base_map;
layout(binding = SWARD_BINDING_SLOPE_MAP) uniform sampler2DArray slope_map;

layout(location = 0) out vec4 color;

const float SLOPE_FACTOR = 4.0;  // k_slope_factor

// Not by texture(): neighbouring pixels may be in different layers.
vec2 layer_slope(int layer, vec2 xy, vec2 dx, vec2 dy) {
  vec4 t = slope_map_transform[layer];
  return textureGrad(slope_map, vec3(xy * t.xy + t.zw, float(layer)), dx * t.xy, dy * t.xy).rg;
}

// From the finest window that holds the place, blended with the next over the last fifth of its reach.
vec2 data_slope(vec2 xy) {
  int last = int(slope_windows.w) - 1;
  if (last == 0) return texture(slope_map, vec3(xy * slope_map_transform[0].xy + slope_map_transform[0].zw, 0.0)).rg;
  vec2 dx = dFdx(xy), dy = dFdy(xy);
  vec2 samples = abs(xy) * slope_windows.xy;
  float away = max(samples.x, samples.y), reach = slope_windows.z;
  int layer = 0;
  for (; layer < last && away > reach; ++layer) reach *= SLOPE_FACTOR;
  vec2 slope = layer_slope(layer, xy, dx, dy);
  if (layer == last || away < 0.8 * reach) return slope;
  return mix(slope, layer_slope(layer + 1, xy, dx, dy), smoothstep(0.8, 1.0, away / reach));
}

void main() {
  vec2 xy = relative_position.xy;
  vec2 slope = data_slope(xy);
  // Far away the mesh is coarser than the relief, whose slope at single vertices then says nothing about the surface.
  slope += relief * (1.0 - smoothstep(80.0, 500.0, length(relative_position) / max(frame.focal.z, 0.1)));
  vec3 normal = normalize(vec3(-slope, 1.0));
  GroundDetail detail = ground_detail(relative_position, normal);
  vec3 albedo = ground_albedo(base_map, xy * base_map_transform.xy + base_map_transform.zw, detail);
  if (any(lessThan(xy, data_rectangle.xy)) || any(greaterThan(xy, data_rectangle.zw))) discard;
  vec3 rough_normal = normalize(vec3(-slope - detail.slope, 1.0));
  color = vec4(encode_output(shade_ground(albedo, rough_normal, relative_position, 1.0)), 1.0);
}
