// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A flower's stem and the leaves at its foot; the head is flower_head.*.glsl's.
#include "common_shoot.glsl"

// Leaves shrink away between these distances, against the layer's full_segments_m: the grass hides them.
const vec2 k_leaves_end = vec2(1.0, 4.0);

vec2 kind_shoots(SpeciesParams species, PlantTraits traits, float ratio) {
  return vec2(1.0 + species.own_d.z * (1.0 - smoothstep(k_leaves_end.x, k_leaves_end.y, ratio)), 1.0);
}

Shoot kind_shoot(SpeciesParams species, PlantTraits traits, int index) {
  if (index == 0) return Shoot(1.0, 1.0, traits.stiffness, traits.azimuth, traits.lean, 1.0, vec2(0.0));
  uint state = part_state(traits.state, index);
  float turn = next_uniform(state);
  float height = next_uniform(state);
  float spread = next_uniform(state);
  Shoot shoot;
  shoot.azimuth = traits.azimuth + 2.3999632 * float(index) + (turn - 0.5) * 1.0;
  shoot.height = mix(0.22, 0.42, height);
  shoot.width = 3.2;
  shoot.lean = mix(0.25, 0.9, spread);
  shoot.stiffness = 0.55;
  shoot.edge = 0.35;
  shoot.foot = vec2(0.0);
  return shoot;
}

float kind_outline(SpeciesParams species, int index, float s) {
  if (index == 0) return 1.0 - 0.35 * s;
  // Narrow at its foot, broadest past the middle, pointed.
  return (0.35 + 1.4 * s) * (1.0 - s * s * s);
}

Leaf kind_leaf(SpeciesParams species, vec4 ground_and_age, int index, float s, float across, float phase) {
  vec4 own = ground_and_age;
  bool ground_green = species.own_d.y < 0.0;
  if (!ground_green) own.rgb = unpack_color(species.own_d.y) * (1.0 + species.age_tint.w) / 2.7;
  // Leaves lie low: they have the light of their height, not of their length.
  return grass_leaf(species, own, index == 0 ? s : 0.35 * s, across, phase);
}
