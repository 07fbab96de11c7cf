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

#define SWARD_LINK in
#include "common_strip_links.glsl"

layout(location = 0) out vec4 color;

#if !SWARD_LIT_AT_VERTICES
vec3 shadow_color(float strength) {
  return darkened_ground(strip_point, strip_map, strip_ground.xyz, 1.0, shadow_light(strength));
}

// A leaf's light, in the shade of its neighbours.
vec3 lit_leaf(SpeciesParams species, Leaf leaf) {
  return strip_leaf(species, leaf, strip_light, strip_normal.w, normalize(strip_normal.xyz));
}

// A leaf of a meadow: far away it becomes the ground.
vec3 meadow_color(SpeciesParams species, Leaf leaf) {
  leaf.albedo *= image_detail(strip_place.yx);
  vec3 lit = lit_leaf(species, leaf);
  return melt_into_ground(lit, strip_color.rgb, strip_ground, strip_point);
}
#endif

// The samples of this fragment that are covered; 0: none, it is to be discarded.
int strip_mask() {
  float phase = strip_self.x;
  float cover = strip_place.z;
  if (has_cutout()) cover *= cutout_cover(strip_place.yx);
  if (frame.eye_noise.w > 1.0) return coverage_mask(cover, phase);
  return hidden_by_hash(cover, phase, strip_place.x) ? 0 : k_all_samples;
}

bool strip_is_shadow() { return strip_self.y >= 0.0; }
int strip_shoot() { return int(-0.5 - strip_self.y); }
