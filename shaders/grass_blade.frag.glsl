// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, and of all that is made of shoots: a leaf lit from both sides (Papavasiliou 2015, section 2.4), or
// its shadow on the ground. Light comes from the vertices; a host's kinds, whose colours may change within a segment,
// are asked here.
#include "common_strip.glsl"
#include "plant_kind.glsl"

// A factor on light, of a colour that is encoded already: the exponent of sRGB's curve.
float encoded_factor(float factor) { return frame.sky_radiance.w == 1.0 ? pow(factor, 0.4545) : factor; }

#if SWARD_LIT_AT_VERTICES
vec3 leaf_color() { return strip_lit * encoded_factor(leaf_vein(strip_place.y) * image_detail(strip_place.yx)); }
#else
vec3 leaf_color() {
  SpeciesParams species = sward_layer.species[sward_species];
  Leaf leaf = kind_leaf(species, strip_color, strip_shoot(), strip_place.x, strip_place.y, strip_self.x);
  return encode_output(meadow_color(species, leaf));
}
#endif

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(strip_is_shadow() ? strip_lit : leaf_color(), 1.0);
}
