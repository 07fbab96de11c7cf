// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The air around a plant, tessellation control: the wind is asked here, once a plant. Nothing in programs for still air.
// GLSL only.
#include "common_grow.glsl"
#include "common_stance.glsl"
#include "common_sway.glsl"
#include "plant_wind.glsl"

#if SWARD_WIND
layout(location = 2) uniform vec2 sward_heights;  // range of the species' height all year, metres

// Height on screen, pixels: lower plants stand as in still air, higher ones than the second number move in full. What a
// plant bends by is less than its height.
const vec2 k_moving_px = vec2(1.0, 2.5);
// Neighbours ask so far away from one another, metres: a front does not reach them at once.
const float k_own_place_m = 0.35;

// Of a plant that has been grown but has not taken its stance.
PlantAir air_around(Triangle triangle, Seedling s) {
  float px = s.traits.height * s.presence.fade * frame.focal.y / max(s.distance, 1.0e-3);
  float share = smoothstep(k_moving_px.x, k_moving_px.y, px);
  if (share <= 0.0) return still_air();
  SwayTraits own =
      sway_traits(sward_layer.species[sward_species], sward_heights, triangle.id, s.rank, s.traits.phase);
  float angle = 6.2831853 * 11.0 * s.traits.phase;
  WindHere here = wind_here(s.root + vec3(cos(angle), sin(angle), 0.0) * k_own_place_m);
  PlantAir air = plant_air(own, s.traits.height, s.traits.lean, here.velocity, here.ambient, here.gust, frame.focal.w,
                           share);
#if SWARD_ON_MESH
  air.wind = (vec3(air.wind, 0.0) * stance_axes(s.ground_normal)).xy;
#endif
  return air;
}
#endif
