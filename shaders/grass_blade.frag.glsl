// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, and of all that is made of shoots: a leaf lit from both sides (Papavasiliou 2015, section 2.4), or
// its shadow on the ground. Light comes from the vertices; a host's kinds, whose colours may change within a segment,
// are asked here.
#include "common_strip.glsl"
#include "plant_kind.glsl"

layout(location = 7) in vec3 strip_lit;  // of the shadow, and of the leaf where SWARD_LIT_AT_VERTICES

// A factor on light, of a colour that is encoded already: the exponent of sRGB's curve.
float encoded_factor(float factor) { return frame.sky_radiance.w == 1.0 ? pow(factor, 0.4545) : factor; }

vec3 leaf_color() {
  vec2 place = vec2(strip_normal.w, strip_point.w);
  if (SWARD_LIT_AT_VERTICES == 1) return strip_lit * encoded_factor(leaf_vein(place.x) * image_detail(place));
  SpeciesParams species = sward_layer.species[sward_species];
  Leaf leaf = kind_leaf(species, strip_color, strip_shoot(), place.y, place.x, strip_self.z);
  return encode_output(meadow_color(species, leaf));
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(strip_is_shadow() ? strip_lit : leaf_color(), 1.0);
}
