// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A blade of grass, as its strip asks for it; its shape is the stages grass_blade.*.glsl.
#include "common_leaf.glsl"

Leaf kind_leaf(SpeciesParams species, vec4 ground_and_age, int index, float s, float across, float phase) {
  return grass_leaf(species, ground_and_age, s, across, phase);
}
