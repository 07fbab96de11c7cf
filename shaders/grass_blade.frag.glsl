// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, and of all that is made of shoots: a leaf lit from both sides (Papavasiliou 2015, section 2.4), or
// its shadow on the ground. Light comes from the vertices; a host's kinds, whose colours may change within a segment,
// are asked here.
#include "common_strip.glsl"
#include "plant_kind.glsl"

layout(location = 7) in vec3 strip_lit;  // of the shadow, and of the leaf where SWARD_LIT_AT_VERTICES

// Metres within which shadows lie on the ground's own structure; beyond twice that they are of one colour.
const float k_near_shadow = 1.0;

vec3 leaf_color() {
  vec2 place = vec2(strip_normal.w, strip_point.w);
  if (SWARD_LIT_AT_VERTICES == 1) return strip_lit * (leaf_vein(place.x) * image_detail(place));
  SpeciesParams species = sward_layer.species[sward_species];
  return meadow_color(species, kind_leaf(species, strip_color, strip_shoot(), place.y, place.x, strip_self.z));
}

vec3 ground_color() {
  float far = smoothstep(k_near_shadow, 2.0 * k_near_shadow, length(strip_point.xyz));
  if (far >= 1.0) return strip_lit;
  return mix(shadow_color(strip_self.w), strip_lit, far);
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(encode_output(strip_is_shadow() ? ground_color() : leaf_color()), 1.0);
}
