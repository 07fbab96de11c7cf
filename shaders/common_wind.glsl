// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The wind, for the stages that grow plants. Needs what sward::WindTextures gives, bound to block SwardWind and to the
// units wind_maps, wind_grid and wind_painted. Costs up to seven lookups: ask once a plant.
#include "common_shared.glsl"
#include "common_wind_params.glsl"

layout(std140, binding = SWARD_BINDING_WIND) uniform SwardWind {
  WindParams sward_wind;
};
layout(binding = SWARD_BINDING_WIND_MAPS) uniform sampler2DArray wind_maps;        // layer 0: gusts, 1: noise
layout(binding = SWARD_BINDING_WIND_GRID) uniform sampler2DArray wind_grid;        // layer 0: fine, 1: coarse
layout(binding = SWARD_BINDING_WIND_PAINTED) uniform sampler2D wind_painted;

vec2 wind_gust_map(vec2 uv) { return textureLod(wind_maps, vec3(uv, 0.0), 0.0).xy; }
vec2 wind_noise_map(vec2 uv) { return textureLod(wind_maps, vec3(uv, 1.0), 0.0).xy * 2.0 - 256.0 / 255.0; }
vec2 wind_grid_map(vec2 uv, int level) { return textureLod(wind_grid, vec3(uv, float(level)), 0.0).xy; }
vec2 wind_painted_map(vec2 uv) { return textureLod(wind_painted, uv, 0.0).xy; }

#include "common_wind_field.glsl"

// `point` relative to the eye, along the world's axes.
WindHere wind_here(vec3 point) { return wind_at_place(point.xy); }
