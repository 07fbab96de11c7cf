// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A tuft: blades fanned out from one root.
#include "common_shoot.glsl"

// With distance fewer blades, down to this share, each as much wider.
const float k_least_blades = 0.34;

vec2 kind_shoots(SpeciesParams species, PlantTraits traits, float ratio) {
  float blades = tuft_blades(species, traits.state);
  float shown = max(blades * max(inversesqrt(max(ratio, 1.0)), k_least_blades), 1.0);
  return vec2(shown, blades / shown);
}

Shoot kind_shoot(SpeciesParams species, PlantTraits traits, int index) {
  uint state = part_state(traits.state, index);
  float turn = next_uniform(state);
  float height = next_uniform(state);
  float spread = next_uniform(state);
  float firm = next_uniform(state);
  float aside = next_uniform(state);
  Shoot shoot;
  // Golden angles: however many of them are shown, they stand around evenly.
  shoot.azimuth = traits.azimuth + 2.3999632 * float(index) + (turn - 0.5) * 1.2;
  shoot.height = index == 0 ? 1.0 : mix(0.5, 1.0, height);
  shoot.width = mix(0.7, 1.0, firm);
  shoot.lean = index == 0 ? traits.lean : max(species.own_a.z * mix(0.1, 1.0, spread), 0.0);
  shoot.stiffness = clamp(traits.stiffness + 0.3 * (firm - 0.5), 0.0, 1.0);
  shoot.edge = 0.35;
  shoot.foot = vec2(cos(shoot.azimuth), sin(shoot.azimuth)) * (0.04 * traits.height * aside);
  return shoot;
}

float kind_outline(SpeciesParams species, int index, float s) { return 1.0 - s * s * (0.55 + 0.45 * s); }

Leaf kind_leaf(SpeciesParams species, vec4 ground_and_age, int index, float s, float across, float phase) {
  return grass_leaf(species, ground_and_age, s, across, fract(phase + 0.381966 * float(index)));
}
