// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass: a blade lit from both sides (Papavasiliou 2015, section 2.4), or its shadow on the ground.
#include "common_strip.glsl"

vec3 blade_color() {
  SpeciesParams species = sward_layer.species[sward_species];
  return meadow_color(species, grass_leaf(species, strip_color, strip_point.w, strip_normal.w, strip_self.z));
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(encode_output(strip_is_shadow() ? shadow_color(strip_self.w) : blade_color()), 1.0);
}
