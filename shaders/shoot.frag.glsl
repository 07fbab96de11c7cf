// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of kinds made of shoots: a shoot in the colours of its kind, or its shadow on the ground.
#include "common_strip.glsl"
#include "plant_kind.glsl"

vec3 shoot_color() {
  SpeciesParams species = sward_layer.species[sward_species];
  return meadow_color(species, kind_leaf(species, strip_color, strip_shoot(), strip_point.w, strip_normal.w,
                                         strip_self.z));
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(encode_output(strip_is_shadow() ? shadow_color(strip_self.w) : shoot_color()), 1.0);
}
