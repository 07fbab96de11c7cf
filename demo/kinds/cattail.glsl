// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A kind of a host's own: cattail, a stiff stem with a brown head below its tip, among long leaves. What the four
// functions are asked for: shaders/common_shoot.glsl. Parameters: own_a.x, own_a.y arc lengths between which the head
// sits; own_a.z its width against the stem's.
#include "common_shoot.glsl"

const int k_leaves = 5;

vec2 kind_shoots(SpeciesParams species, PlantTraits traits, float ratio) {
  // From all leaves near by to two far away, wider by as much; the stem always.
  float leaves = mix(float(k_leaves), 2.0, smoothstep(1.0, 6.0, ratio));
  return vec2(1.0 + leaves, (1.0 + float(k_leaves)) / (1.0 + leaves));
}

Shoot kind_shoot(SpeciesParams species, PlantTraits traits, int index) {
  if (index == 0) return Shoot(1.0, 0.4, 1.0, traits.azimuth, 0.4 * traits.lean, 1.0, vec2(0.0));
  uint state = part_state(traits.state, index);
  float turn = next_uniform(state);
  float length_share = mix(0.7, 1.0, next_uniform(state));
  float lean = mix(0.05, 0.3, next_uniform(state));
  float azimuth = traits.azimuth + 2.3999632 * float(index) + turn;
  return Shoot(length_share, 1.0, traits.stiffness, azimuth, lean, 0.35, 0.02 * vec2(cos(azimuth), sin(azimuth)));
}

bool in_head(SpeciesParams species, float s) { return s > species.own_a.x && s < species.own_a.y; }

float kind_outline(SpeciesParams species, int index, float s) {
  if (index > 0) return 1.0 - s * s * s;
  float head = smoothstep(species.own_a.x - 0.02, species.own_a.x + 0.02, s) *
               (1.0 - smoothstep(species.own_a.y - 0.02, species.own_a.y + 0.02, s));
  return mix(1.0 - 0.6 * s, species.own_a.z, head);
}

Leaf kind_leaf(SpeciesParams species, vec4 ground_and_age, int index, float s, float across, float phase) {
  Leaf leaf = grass_leaf(species, ground_and_age, s, across, phase);
  if (index == 0 && in_head(species, s)) leaf.albedo = vec3(0.06, 0.030, 0.013) * (0.85 + 0.3 * phase);
  return leaf;
}
