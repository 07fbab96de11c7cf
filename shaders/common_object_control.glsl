// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of single objects (stones, leaves, trees), tessellation control: a patch a cluster; each invocation grows one
// seed, those that can be seen become isolines. The kind's file defines the two functions declared here. GLSL only.
#include "common_levels.glsl"
#include "common_grow.glsl"
#include "common_ground.glsl"
#include "common_shadow_bend.glsl"
#include "common_visible.glsl"
#include "common_stance_control.glsl"
#include "common_air.glsl"

layout(vertices = SWARD_CLUSTER_SIZE) out;

layout(location = 0) in uvec4 cluster_words[];

layout(location = 0) out vec4 object_root[];    // root relative to the eye, height as drawn (0: not drawn)
layout(location = 1) out vec4 object_form[];    // width as drawn, stiffness, azimuth, lean
layout(location = 2) out vec4 object_ground[];  // surface normal x, y; base map coordinates
layout(location = 3) out vec4 object_color[];   // ground at the root, linear; age
layout(location = 4) out vec4 object_self[];    // distance, phase, parts, bend (shadow_bend)
layout(location = 5) patch out uvec2 object_patch;  // record of the triangle; unused
layout(location = 6) patch out uint object_slots[(SWARD_CLUSTER_SIZE + 3) / 4];  // invocation of each line, 8 bits each
#if SWARD_WIND
layout(location = 14) out vec4 object_blown[];  // wind, sway, cycle
layout(location = 15) out float object_slow[];  // slow cycle
#endif

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D sward_base_map;

// Below this size, pixels, an object is left to the ground's own colour; cover_small fades it out before.
const float k_least_size_px = 0.3;

// Factors on height and width that keep the covered ground as seeds thin out by `widen`.
vec2 object_widening(float widen);

// Parts (segments of its line) that an object of this size on screen has, fractional.
float object_parts(SpeciesParams species, float distance, float size_px);

float size_px(float size, float distance) { return size * frame.focal.y / max(distance, 1.0e-3); }

void write_object(Triangle triangle, Seedling s, vec2 size) {
  vec3 color = root_color(sward_base_map, s);
#if SWARD_WIND
  PlantAir air = air_around(triangle, s);
  object_blown[gl_InvocationID] = vec4(air.wind, air.sway, air.cycle);
  object_slow[gl_InvocationID] = air.slow;
#endif
  s = take_stance(s);
  SpeciesParams species = sward_layer.species[sward_species];
  object_root[gl_InvocationID] = vec4(s.root, size.x);
  object_form[gl_InvocationID] = vec4(size.y, s.traits.stiffness, s.traits.azimuth, s.traits.lean);
  object_ground[gl_InvocationID] = vec4(s.ground_normal.xy, s.map_uv);
  object_color[gl_InvocationID] = vec4(color, s.traits.age);
  float parts = object_parts(species, s.distance, size_px(max(size.x, size.y), s.distance));
  object_self[gl_InvocationID] = vec4(s.distance, s.traits.phase, parts, shadow_bend(triangle, s, size.x));
}

// Whether an object of the species' largest size could be seen at all: asked before the ground is.
bool worth_growing(Seedling s, vec2 widening) {
  if (s.presence.fade <= 0.0) return false;
  vec2 largest = sward_layer.species[sward_species].size.yw * widening * s.presence.fade;
  float radius = length(largest);
  if (size_px(max(largest.x, largest.y), s.distance) < k_least_size_px) return false;
  return sphere_visible(s.root, radius * (1.0 + shadow_reach(sward_layer.layer, s.distance)));
}

void grow_line(FertileCluster fertile) {
  object_root[gl_InvocationID] = vec4(0.0);
#if SWARD_WIND
  object_blown[gl_InvocationID] = vec4(0.0);
  object_slow[gl_InvocationID] = 0.0;
#endif
  Triangle triangle = fetch_triangle(fertile.record);
  Seedling s = place_seed(fertile, triangle, uint(gl_InvocationID));
  vec2 widening = object_widening(s.presence.widen);
  if (!worth_growing(s, widening)) return;
  s = grow_seed(fertile, triangle, s);
  if (s.presence.fade <= 0.0) return;
  // Objects keep their proportions while they grow in.
  write_object(triangle, s, vec2(s.traits.height, s.traits.width) * widening * s.presence.fade);
}

// Lines for what is drawn; the object that wants most parts decides for all.
void write_lines() {
  uint lines = 0u;
  float parts = 1.0;
  // Outputs are only written: one vendor's compiler refuses indexed ones that are read again.
  uint slots[(SWARD_CLUSTER_SIZE + 3) / 4];
  for (int slot = 0; slot < slots.length(); ++slot) slots[slot] = 0u;
  for (uint i = 0u; i < uint(SWARD_CLUSTER_SIZE); ++i) {
    if (object_root[i].w <= 0.0) continue;
    slots[lines / 4u] |= i << (8u * (lines % 4u));
    parts = max(parts, object_self[i].z);
    ++lines;
  }
  object_patch = uvec2(cluster_words[0].x, 0u);
  for (int slot = 0; slot < slots.length(); ++slot) object_slots[slot] = slots[slot];
  set_levels(lines, parts);
}

void main() {
  grow_line(unpack_cluster(cluster_words[0]));
  barrier();
  if (gl_InvocationID == 0) write_lines();
}
