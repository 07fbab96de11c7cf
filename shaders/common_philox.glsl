// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Counter-based random numbers: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3" (2011).
// Read by GLSL and C++.

// Philox-2x32: counter, key, rounds. Multiplier and Weyl increment as published. Seven rounds pass a chi-square test
// over bintree ids, three do not.
SWARD_FN uvec2 philox2x32(uvec2 counter, uint key, int rounds) {
  for (int i = 0; i < rounds; ++i) {
    uvec2 product = mul_wide(0xD256D193u, counter.x);
    counter = uvec2(product.y ^ key ^ counter.y, product.x);
    key += 0x9E3779B9u;
  }
  return counter;
}

// The two numbers of a triangle's `index`; id.x is the low word, id.y the high word.
SWARD_FN uvec2 random_pair(uint index, uvec2 id) { return philox2x32(uvec2(index, id.y), id.x, 7); }

// [0, 1), 24 bits.
SWARD_FN float uniform_float(uint u) { return float(u >> 8) * 5.9604644775390625e-8f; }

// Further numbers: a linear congruential sequence started from random_pair(index | 2^31).
SWARD_FN uint lcg_next(uint state) { return state * 1664525u + 1013904223u; }

// Index spaces, so that clusters and seeds never share numbers:
//   seed     rank                 pair: r1, r2 inside the stratum
//   seed     rank | 2^31          start of the seed's sequence: height, width, stiffness, azimuth, age, lean, phase
//   cluster  cluster | 2^30       pair: stratum, z (choice of the second species)
//   cluster  cluster | 2^30|2^31  pair: r1, r2 of the cluster's centre inside the stratum
//   triangle 2^32 - 1             where its ranks start to count (common_plant.glsl)
const uint k_cluster_space = 0x40000000u;
const uint k_sequence_space = 0x80000000u;
const uint k_triangle_index = 0xFFFFFFFFu;
