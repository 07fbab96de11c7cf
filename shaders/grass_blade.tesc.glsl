// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, a patch a cluster: each invocation grows one seed; those that can be seen become isolines.
#include "common_levels.glsl"
#include "common_grow.glsl"
#include "common_blade.glsl"
#include "common_ground.glsl"
#include "common_shadow_bend.glsl"
#include "common_worth.glsl"
#include "common_stance_control.glsl"
#include "common_bend.glsl"
#include "common_air.glsl"

layout(vertices = SWARD_CLUSTER_SIZE) out;

layout(location = 0) in uvec4 cluster_words[];

layout(location = 0) out vec4 blade_root[];    // root relative to the eye, height as drawn (0: not drawn)
layout(location = 1) out vec4 blade_form[];    // half width as drawn, stiffness, azimuth, lean
layout(location = 2) out vec4 blade_ground[];  // surface normal x, y; base map coordinates
layout(location = 3) out vec4 blade_color[];   // ground at the root, linear; age
layout(location = 4) out vec4 blade_self[];    // contact with the ground, phase, distance, bend (shadow_bend)
layout(location = 5) patch out uint blade_slots[(SWARD_CLUSTER_SIZE + 3) / 4];  // invocation of each line, 8 bits each
#if SWARD_WIND
layout(location = 14) out vec2 blade_bend[];  // layer of the table of shapes; factor that keeps the length
#endif

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D sward_base_map;

float blade_contact(BladeCurve curve) {
#if SWARD_WIND
  return curve.contact;
#else
  return find_contact(curve);
#endif
}

#if SWARD_WIND
// The curve in the wind; the traits take on its azimuth and lean.
BladeCurve blown_curve(PlantAir air, inout Seedling s) {
  vec2 own_way = vec2(cos(s.traits.azimuth), sin(s.traits.azimuth));
  Bend bend = bend_in_wind(own_way, s.traits.stiffness, s.traits.lean, swaying_wind(air, 0));
  float own_lean = s.traits.lean;
  s.traits.azimuth = atan(bend.way.y, bend.way.x);
  s.traits.lean = bend.lean;
  float segments = segment_count(sward_layer.species[sward_species], sward_layer.layer, s.distance);
  BladeCurve curve = laid_curve(bent_curve(bend, s.traits.stiffness, s.ground_normal), own_way, own_lean,
                                s.traits.stiffness, s.ground_normal, segments);
  blade_bend[gl_InvocationID] = vec2(curve.layer, curve.scale);
  return curve;
}
#endif

void write_blade(Triangle triangle, Seedling s) {
  vec3 color = root_color(sward_base_map, s);
#if SWARD_WIND
  PlantAir air = air_around(triangle, s);
  s = take_stance(s);
  BladeCurve curve = blown_curve(air, s);
#else
  s = take_stance(s);
  vec2 azimuth = vec2(cos(s.traits.azimuth), sin(s.traits.azimuth));
  float slope = -dot(s.ground_normal.xy, azimuth) / s.ground_normal.z;
  BladeCurve curve = free_curve(s.traits.stiffness, s.traits.lean, slope);
#endif
  float half_width = 0.5 * s.traits.width * s.presence.grow * s.presence.widen;
  blade_root[gl_InvocationID] = vec4(s.root, s.traits.height * s.presence.fade);
  blade_form[gl_InvocationID] = vec4(half_width, s.traits.stiffness, s.traits.azimuth, s.traits.lean);
  blade_ground[gl_InvocationID] = vec4(s.ground_normal.xy, s.map_uv);
  blade_color[gl_InvocationID] = vec4(color, s.traits.age);
  blade_self[gl_InvocationID] = vec4(blade_contact(curve), s.traits.phase, s.distance,
                                      shadow_bend(triangle, s, sward_layer.species[sward_species].size.y));
}

void grow_line() {
  blade_root[gl_InvocationID] = vec4(0.0);
#if SWARD_WIND
  blade_bend[gl_InvocationID] = vec2(0.0);
#endif
  FertileCluster fertile = unpack_cluster(cluster_words[0]);
  Triangle triangle = fetch_triangle(fertile.record);
  Seedling s = place_seed(fertile, triangle, uint(gl_InvocationID));
  if (!worth_growing(s, sward_layer.species[sward_species].size.y)) return;
  s = grow_seed(fertile, triangle, s);
  if (s.presence.fade > 0.0) write_blade(triangle, s);
}

void main() {
  grow_line();
  barrier();
  if (gl_InvocationID != 0) return;

  // Lines only for what is drawn; the nearest of them decides the segments of all.
  uint lines = 0u;
  float nearest = 1.0e9;
  // Outputs are only written: one vendor's compiler refuses indexed ones that are read again.
  uint slots[(SWARD_CLUSTER_SIZE + 3) / 4];
  for (int slot = 0; slot < slots.length(); ++slot) slots[slot] = 0u;
  for (uint i = 0u; i < uint(SWARD_CLUSTER_SIZE); ++i) {
    if (blade_root[i].w <= 0.0) continue;
    slots[lines / 4u] |= i << (8u * (lines % 4u));
    nearest = min(nearest, blade_self[i].z);
    ++lines;
  }
  for (int slot = 0; slot < slots.length(); ++slot) blade_slots[slot] = slots[slot];
  set_levels(lines, segment_count(sward_layer.species[sward_species], sward_layer.layer, nearest));
}
