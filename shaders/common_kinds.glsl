// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What kinds of plants draw from a seed's own numbers beyond its traits. Read by GLSL and C++.
//
// SpeciesParams by kind:
//   tuft    own_a: blades min, max; largest lean of a blade (rad)
//   flower  own_a: petal colours (pack_color, vegetation/src/vegetation/layer_params.cpp); own_b: their cumulative
//           shares but for the last; cup; own_c: head's diameter min, max (m); petals; centre's share of the radius;
//           own_d: centre's colour; stem's colour, negative: the ground's; leaves; width of petals
//   leaf, fern  own_a: leaves
//   billboard  own_a: bare share of the height, taper of the crown
//   mesh    own_a: faces
//   a host's own: its parameters

// State of the sequence of a plant's part; parts of one plant are evenly spread.
SWARD_FN uint part_state(uint state, int part) { return lcg_next(state + (uint(part) + 2u) * 0x9E3779B1u); }

// Blades of a tuft, min..max with equal chances.
SWARD_FN float tuft_blades(SpeciesParams species, uint state) {
  float u = uniform_float(lcg_next(state));
  return min(species.own_a.x + floor(u * (species.own_a.y - species.own_a.x + 1.0f)), species.own_a.y);
}

// Which of the petal colours a flower has, 0..3.
SWARD_FN int petal_choice(SpeciesParams species, uint state) {
  float u = uniform_float(lcg_next(state));
  if (u < species.own_b.x) return 0;
  if (u < species.own_b.y) return 1;
  return u < species.own_b.z ? 2 : 3;
}

// A flower's head, metres across, full-grown.
SWARD_FN float head_diameter(SpeciesParams species, uint state) {
  float u = uniform_float(lcg_next(lcg_next(state)));
  return species.own_c.x + (species.own_c.y - species.own_c.x) * u;
}
