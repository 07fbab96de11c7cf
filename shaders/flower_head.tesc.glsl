// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of flowers' heads, a patch a cluster: each invocation finds where one plant's stem ends and which way its head
// looks. A head becomes an isoline, each segment of it a petal; where all heads of a patch are dots, one segment a dot.
#include "common_levels.glsl"
#include "common_shadow_bend.glsl"
#include "common_worth.glsl"
#include "common_blade.glsl"
#include "common_head.glsl"
#include "common_stance_control.glsl"
#include "kind_flower.glsl"
#include "common_bend.glsl"
#include "common_air.glsl"

layout(vertices = SWARD_CLUSTER_SIZE) out;

layout(location = 0) in uvec4 cluster_words[];

layout(location = 0) out vec4 head_place[];  // middle relative to the eye, radius as drawn (0: not drawn)
layout(location = 1) out vec4 head_axis[];   // where it looks, unit; its turn about that (rad)
layout(location = 2) out vec4 head_plane[];  // of the ground: unit normal; its bend (shadow_bend)
layout(location = 3) out vec4 head_color[];  // petals', linear; pixels across
layout(location = 4) out vec4 head_map[];    // base map coordinates below the eye; phase; distance
layout(location = 5) patch out uint head_slots[(SWARD_CLUSTER_SIZE + 3) / 4];  // plant of each line, 8 bits each
layout(location = 13) out vec3 head_root[];  // relative to the eye
#if SWARD_WIND
layout(location = 14) out vec4 head_air[];  // wind, m/s; sway; cycle; slow cycle
#endif

vec3 upwards() {
#if SWARD_ON_MESH
  return vec3(0.0, 0.0, 1.0);
#else
  return frame.up.xyz;
#endif
}

// Up, along the stem's end, a little aside, and towards a risen sun as far as the species turns to it.
vec3 head_direction(SpeciesParams species, vec3 tangent, float turn) {
  vec3 sun = frame.sun_direction.xyz * (frame.sun_direction.w * species.posture.w);
  vec3 own = 0.3 * vec3(cos(turn), sin(turn), 0.0);
  return normalize(0.8 * tangent + 0.45 * upwards() + own + 1.1 * sun);
}

vec3 petal_linear(SpeciesParams species, uint state, float phase) {
  vec3 color = unpack_color(species.own_a[petal_choice(species, state)]);
  return color * (0.86 + 0.2 * fract(phase * 13.7));
}

// How far petals reach below the plane of a head, in radii; `facing`: how far it looks up.
float lowest_petal(SpeciesParams species, float facing) {
  float cup = species.own_b.w;
  return facing < 0.0 ? max(cup + k_cup_room, 0.0) : max(k_cup_room - cup, 0.0);
}

// A head at the ground (freedom 0) lies on it, one a radius above it is free.
vec3 above_ground(vec3 axis, vec3 normal, float freedom) {
  vec3 raised = axis - normal * (min(dot(axis, normal), 0.0) * (1.0 - freedom));
  return normalize(mix(normal, raised, freedom * freedom) + 1.0e-4 * normal);
}

#if SWARD_WIND
// The stem as shoot.tese.glsl bends it.
BladeCurve blown_stem(SpeciesParams species, PlantAir air, Seedling s, Shoot stem, out vec2 azimuth) {
  vec2 own_way = vec2(cos(stem.azimuth), sin(stem.azimuth));
  Bend bend = bend_in_wind(own_way, stem.stiffness, stem.lean, swaying_wind(air, 0));
  azimuth = bend.way;
  float segments = segment_count(species, sward_layer.layer, s.distance);
  BladeCurve curve = laid_curve(bent_curve(bend, stem.stiffness, s.ground_normal), own_way, stem.lean, stem.stiffness,
                                s.ground_normal, segments);
  curve.scale = unpack_scale(packed_scale(curve.scale));
  return curve;
}
#endif

void write_head(SpeciesParams species, Triangle triangle, Seedling s) {
#if SWARD_WIND
  PlantAir air = air_around(triangle, s);
  head_air[gl_InvocationID] = vec4(length(air.wind), air.sway, air.cycle, air.slow);
#endif
  s = take_stance(s);
  Shoot stem = lay_shoot(species, s.traits, kind_shoot(species, s.traits, 0));
  vec3 normal = s.ground_normal;
#if SWARD_WIND
  vec2 azimuth;
  BladeCurve curve = blown_stem(species, air, s, stem, azimuth);
#else
  vec2 azimuth = vec2(cos(stem.azimuth), sin(stem.azimuth));
  BladeCurve curve = free_curve(stem.stiffness, stem.lean, -dot(normal.xy, azimuth) / normal.z);
  curve.contact = find_contact(curve);
#endif
  BladePoint end = curve_point(curve, 1.0);
  vec3 tangent = vec3(azimuth * sin(end.inclination), cos(end.inclination));
  vec3 middle = s.root + s.traits.height * s.presence.fade * vec3(azimuth * end.along, end.up);

  // Where plants are fewer their heads are larger, in area as blades are in width.
  float radius = 0.5 * head_diameter(species, s.traits.state) * s.presence.fade * sqrt(s.presence.widen);
  // A cut or burnt stem has none.
  radius *= smoothstep(0.6, 0.9, s.left);
  if (radius <= 0.0) return;
  vec3 axis = head_direction(species, tangent, 6.2831853 * fract(s.traits.phase * 5.618));
  float clearance = dot(normal, middle - s.root);
  float need = radius * (0.1 + lowest_petal(species, dot(axis, normal)));
  axis = above_ground(axis, normal, clamp((clearance - need) / radius, 0.0, 1.0));
  middle += normal * max(need - clearance, 0.0);
  vec2 uv_per_m = sward_layer.layer.map.xy / sward_layer.layer.map.zw;
  float distance = max(length(middle), 1.0e-3);
  head_place[gl_InvocationID] = vec4(middle, radius);
  head_axis[gl_InvocationID] = vec4(axis, s.traits.phase * 6.2831853);
  head_plane[gl_InvocationID] = vec4(normal, shadow_bend(triangle, s, species.size.y));
  head_root[gl_InvocationID] = s.root;
  vec3 petals = disturbed_color(petal_linear(species, s.traits.state, s.traits.phase), s.disturbed);
  head_color[gl_InvocationID] = vec4(petals, 2.0 * radius * frame.focal.y / distance);
  head_map[gl_InvocationID] = vec4(s.map_uv - s.root.xy * uv_per_m, s.traits.phase, s.distance);
}

void grow_head() {
  head_place[gl_InvocationID] = vec4(0.0);
#if SWARD_WIND
  head_air[gl_InvocationID] = vec4(0.0);
#endif
  FertileCluster fertile = unpack_cluster(cluster_words[0]);
  Triangle triangle = fetch_triangle(fertile.record);
  Seedling s = place_seed(fertile, triangle, uint(gl_InvocationID));
  SpeciesParams species = sward_layer.species[sward_species];
  if (!worth_growing(s, species.size.y + 2.0 * species.own_c.y)) return;
  s = grow_seed(fertile, triangle, s);
  if (s.presence.fade > 0.0) write_head(species, triangle, s);
}

void main() {
  grow_head();
  barrier();
  if (gl_InvocationID != 0) return;

  uint lines = 0u;
  float largest = 0.0;
  // Outputs are only written: one vendor's compiler refuses indexed ones that are read again.
  uint slots[(SWARD_CLUSTER_SIZE + 3) / 4];
  for (int slot = 0; slot < slots.length(); ++slot) slots[slot] = 0u;
  for (uint i = 0u; i < uint(SWARD_CLUSTER_SIZE); ++i) {
    if (head_place[i].w <= 0.0) continue;
    slots[lines / 4u] |= i << (8u * (lines % 4u));
    largest = max(largest, head_color[i].w);
    ++lines;
  }
  for (int slot = 0; slot < slots.length(); ++slot) head_slots[slot] = slots[slot];
  set_levels(lines, largest > k_dot_px ? head_petals(sward_layer.species[sward_species]) : 1.0);
}
