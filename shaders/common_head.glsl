// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a flower's head looks like from near and from far. In units of the head's radius; petals are strips along it.
// Far away petals widen until they meet, with as much less coverage: the head becomes a disc of the same lit area, and
// at last a dot of its mean colour. GLSL only.
#include "common_shoot.glsl"

// Across a head, pixels: petals are themselves above .y and have met below .x; below the last number it is a dot.
const vec2 k_petals_meet_px = vec2(6.0, 14.0);
const float k_dot_px = 4.0;

const int k_petal_sections = 5;
// Most that a petal's cup differs from its species'.
const float k_cup_spread = 0.13;
#if SWARD_WIND
// Share of the cup by which a petal beats, of what a leaf would turn by (fluttering(), at most 0.45).
const float k_petal_flutter = 0.25;
const float k_cup_room = k_cup_spread + 0.45 * k_petal_flutter;
#else
const float k_cup_room = k_cup_spread;
#endif

// Petals of a head, and its centre's radius.
float head_petals(SpeciesParams species) { return species.own_c.z; }
float head_centre(SpeciesParams species) { return species.own_c.w; }

// Half of the angle that a petal has to itself, as a slope: half the width of the wedge at radius 1.
float head_wedge(SpeciesParams species) { return tan(3.14159265 / head_petals(species)); }

// Radius of a petal's section: from below the rim of the centre to the tip.
float petal_radius(SpeciesParams species, int section) {
  const float along[k_petal_sections] = float[k_petal_sections](0.0, 0.35, 0.7, 0.91, 1.0);
  return mix(0.85 * head_centre(species), 1.0, along[section]);
}

// Half a petal's own width there.
float petal_half_width(SpeciesParams species, int section) {
  const float share[k_petal_sections] = float[k_petal_sections](0.45, 0.84, 1.0, 0.84, 0.36);
  return min(0.75 * head_wedge(species), 0.8) * species.own_d.w * share[section];
}

// Lit area of a wedge: the centre's part of it, the petal's.
vec2 wedge_areas(SpeciesParams species) {
  float petal = 0.0;
  for (int i = 0; i + 1 < k_petal_sections; ++i) {
    float near = petal_radius(species, i), far = petal_radius(species, i + 1);
    float wedge = head_wedge(species);
    float width = min(petal_half_width(species, i), near * wedge) + min(petal_half_width(species, i + 1), far * wedge);
    petal += width * (far - near);
  }
  float centre = head_centre(species);
  return vec2(centre * centre * head_wedge(species), petal);
}

// 1: petals have met and lie in a disc, 0: they are themselves. `px`: across the head.
float petals_met(float px) { return 1.0 - smoothstep(k_petals_meet_px.x, k_petals_meet_px.y, px); }
