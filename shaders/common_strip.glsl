// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Fragments of strips, whatever they are strips of: coverage, light, the shadow on the ground. GLSL only, fragment
// stage.
#include "common_light.glsl"
#include "common_ground.glsl"
#include "common_leaf.glsl"
#include "common_ground_shadow.glsl"
#include "common_layer.glsl"
#include "common_cover.glsl"
#include "common_plant_image.glsl"

layout(location = 0) uniform int sward_species;

layout(location = 0) in vec4 strip_point;        // relative to the eye; arc length
layout(location = 1) in vec4 strip_normal;       // towards the viewer, rounded, the ground's share in it; -1..1 across
layout(location = 2) in vec2 strip_cover;        // share of the strip that the plant covers; gloss (leaf_gloss)
layout(location = 3) flat in vec4 strip_color;   // ground at the root; age
layout(location = 4) flat in vec4 strip_ground;  // normal; melting
layout(location = 5) flat in vec4 strip_self;    // base map coordinates below the eye; phase; shadow's strength, or
                                                 // -1 - shoot
layout(location = 6) in vec4 strip_light;        // canopy_light: sky, sun; leaf_through; cosine for leaf_streak

layout(location = 0) out vec4 color;

vec3 shadow_color(float strength) {
  return darkened_ground(strip_point.xyz, strip_self.xy, strip_ground.xyz, 1.0, shadow_light(strength));
}

// A leaf's light, in the shade of its neighbours.
vec3 lit_leaf(SpeciesParams species, Leaf leaf) {
  return strip_leaf(species, leaf, strip_light, strip_cover.y, normalize(strip_normal.xyz));
}

// A leaf of a meadow: far away it becomes the ground.
vec3 meadow_color(SpeciesParams species, Leaf leaf) {
  leaf.albedo *= image_detail(vec2(strip_normal.w, strip_point.w));
  vec3 lit = lit_leaf(species, leaf);
  return melt_into_ground(lit, strip_color.rgb, strip_ground, strip_point.xyz);
}

// The samples of this fragment that are covered; 0: none, it is to be discarded.
int strip_mask() {
  float phase = strip_self.z;
  float cover = strip_cover.x;
  if (has_cutout()) cover *= cutout_cover(vec2(strip_normal.w, strip_point.w));
  if (frame.eye_noise.w > 1.0) return coverage_mask(cover, phase);
  return hidden_by_hash(cover, phase, strip_point) ? 0 : k_all_samples;
}

bool strip_is_shadow() { return strip_self.w >= 0.0; }
int strip_shoot() { return int(-0.5 - strip_self.w); }
