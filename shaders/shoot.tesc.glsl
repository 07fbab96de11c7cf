// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of kinds made of shoots, a patch a cluster: each invocation grows one seed, the shoots that are shown become
// isolines. A patch has at most 64 of them; further instances grow the further shoots of each plant.
#include "common_levels.glsl"
#include "common_shadow_bend.glsl"
#include "common_worth.glsl"
#include "common_blade.glsl"
#include "common_ground.glsl"
#include "common_stance_control.glsl"
#include "plant_kind.glsl"
#include "common_bend.glsl"
#include "common_air.glsl"

layout(vertices = SWARD_CLUSTER_SIZE) out;

layout(location = 0) in uvec4 cluster_words[];
layout(location = 1) in int cluster_instance[];

layout(location = 0) out vec4 plant_root[];    // root relative to the eye, height as drawn (0: not drawn)
layout(location = 1) out vec4 plant_form[];    // width as drawn, stiffness, azimuth, lean
layout(location = 2) out vec4 plant_ground[];  // surface normal x, y; base map coordinates
layout(location = 3) out vec4 plant_color[];   // ground at the root, linear; age
layout(location = 4) out vec4 plant_self[];    // shoots shown, phase, distance, bend (shadow_bend)
layout(location = 5) out uvec4 plant_words[];  // contacts of the shoots with the ground, 8 bits each; state
layout(location = 6) patch out uvec4 shoot_slots[4];  // plant and shoot of each line, 8 bits each
layout(location = 10) patch out int shoot_first;      // first shoot of each plant in this patch
#if SWARD_WIND
layout(location = 14) out vec4 plant_blown[];   // wind, sway, cycle
layout(location = 15) out float plant_slow[];   // slow cycle
layout(location = 16) out uvec3 plant_scales[];  // factors that keep the shoots' lengths, 8 bits each
#endif

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D sward_base_map;

int first_shoot() { return cluster_instance[0] * SWARD_SHOOTS_PER_PATCH; }

// Arc length at which a shoot meets the ground in 255ths, never late; 255: nowhere.
uint packed_contact(float contact) { return contact >= 1.0 ? 255u : uint(contact * 255.0); }

#if SWARD_WIND
// As grown in the wind; plant_scales takes what keeps the lengths.
uvec3 blown_contacts(SpeciesParams species, Seedling s, PlantAir air, float shown) {
  uvec3 words = uvec3(0u), scales = uvec3(0u);
  int end = min(int(ceil(shown)), first_shoot() + SWARD_SHOOTS_PER_PATCH);
  float segments = segment_count(species, sward_layer.layer, s.distance);
  for (int i = first_shoot(); i < end; ++i) {
    Shoot shoot = lay_shoot(species, s.traits, kind_shoot(species, s.traits, i));
    vec2 own_way = vec2(cos(shoot.azimuth), sin(shoot.azimuth));
    Bend bend = bend_in_wind(own_way, shoot.stiffness, shoot.lean, swaying_wind(air, i));
    BladeCurve curve = laid_curve(bent_curve(bend, shoot.stiffness, s.ground_normal), own_way, shoot.lean,
                                  shoot.stiffness, s.ground_normal, segments);
    words[i / 4] |= packed_contact(curve.contact) << uint(8 * (i % 4));
    scales[i / 4] |= packed_scale(curve.scale) << uint(8 * (i % 4));
  }
  plant_scales[gl_InvocationID] = scales;
  return words;
}
#endif

uvec3 find_contacts(SpeciesParams species, Seedling s, float shown) {
  uvec3 words = uvec3(0u);
  int end = min(int(ceil(shown)), first_shoot() + SWARD_SHOOTS_PER_PATCH);
  for (int i = first_shoot(); i < end; ++i) {
    Shoot shoot = lay_shoot(species, s.traits, kind_shoot(species, s.traits, i));
    vec2 azimuth = vec2(cos(shoot.azimuth), sin(shoot.azimuth));
    float slope = -dot(s.ground_normal.xy, azimuth) / s.ground_normal.z;
    float contact = find_contact(free_curve(shoot.stiffness, shoot.lean, slope));
    words[i / 4] |= packed_contact(contact) << uint(8 * (i % 4));
  }
  return words;
}

void write_plant(SpeciesParams species, Triangle triangle, Seedling s) {
  vec3 color = root_color(sward_base_map, s);
#if SWARD_WIND
  PlantAir air = air_around(triangle, s);
  plant_blown[gl_InvocationID] = vec4(air.wind, air.sway, air.cycle);
  plant_slow[gl_InvocationID] = air.slow;
#endif
  s = take_stance(s);
  float ratio = s.distance / sward_layer.layer.detail.x;
  s.traits.height *= s.presence.fade;
  vec2 shoots = kind_shoots(species, s.traits, ratio);
  float shown = clamp(shoots.x, 0.0, float(SWARD_MOST_SHOOTS));
  s.traits.width *= s.presence.grow * s.presence.widen * shoots.y;
  plant_root[gl_InvocationID] = vec4(s.root, s.traits.height);
  plant_form[gl_InvocationID] = vec4(s.traits.width, s.traits.stiffness, s.traits.azimuth, s.traits.lean);
  plant_ground[gl_InvocationID] = vec4(s.ground_normal.xy, s.map_uv);
  plant_color[gl_InvocationID] = vec4(color, s.traits.age);
  plant_self[gl_InvocationID] = vec4(shown, s.traits.phase, s.distance, shadow_bend(triangle, s, species.size.y));
#if SWARD_WIND
  uvec3 contacts = blown_contacts(species, s, air, shown);
#else
  uvec3 contacts = find_contacts(species, s, shown);
#endif
  plant_words[gl_InvocationID] = uvec4(contacts, s.traits.state);
}

void grow_plant() {
  plant_root[gl_InvocationID] = vec4(0.0);
  plant_self[gl_InvocationID] = vec4(0.0);
#if SWARD_WIND
  plant_blown[gl_InvocationID] = vec4(0.0);
  plant_slow[gl_InvocationID] = 0.0;
  plant_scales[gl_InvocationID] = uvec3(0u);
#endif
  FertileCluster fertile = unpack_cluster(cluster_words[0]);
  Triangle triangle = fetch_triangle(fertile.record);
  Seedling s = place_seed(fertile, triangle, uint(gl_InvocationID));
  SpeciesParams species = sward_layer.species[sward_species];
  if (!worth_growing(s, species.size.y)) return;
  s = grow_seed(fertile, triangle, s);
  if (s.presence.fade > 0.0) write_plant(species, triangle, s);
}

// A share of a shoot's width below which it has none.
const float k_least_shoot = 0.004;

void main() {
  grow_plant();
  barrier();
  if (gl_InvocationID != 0) return;

  // Lines only for what is drawn; the nearest of them decides the segments of all.
  shoot_first = first_shoot();
  uint lines = 0u;
  float nearest = 1.0e9;
  // Outputs are only written: one vendor's compiler refuses indexed ones that are read again.
  uint slots[16];
  for (int slot = 0; slot < 16; ++slot) slots[slot] = 0u;
  for (int plant = 0; plant < SWARD_CLUSTER_SIZE; ++plant) {
    if (plant_root[plant].w <= 0.0) continue;
    int shoots = min(int(ceil(plant_self[plant].x - k_least_shoot)) - first_shoot(), SWARD_SHOOTS_PER_PATCH);
    for (int i = 0; i < shoots; ++i) {
      uint code = uint(plant * SWARD_SHOOTS_PER_PATCH + i);
      slots[lines / 4u] |= code << (8u * (lines % 4u));
      ++lines;
    }
    if (shoots > 0) nearest = min(nearest, plant_self[plant].z);
  }
  for (int slot = 0; slot < 4; ++slot)
    shoot_slots[slot] = uvec4(slots[4 * slot], slots[4 * slot + 1], slots[4 * slot + 2], slots[4 * slot + 3]);
  set_levels(lines, segment_count(sward_layer.species[sward_species], sward_layer.layer, nearest));
}
