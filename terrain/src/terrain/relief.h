// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/height_field.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace sward::relief {

// Gradients at the nodes: 16 directions, unit length. Literals, so that every platform has the same bits.
inline constexpr double k_c1 = 0.92387953251128674, k_s1 = 0.38268343236508977, k_c2 = 0.70710678118654752;
inline constexpr double k_directions[16][2] = {
    {1, 0},  {k_c1, k_s1},   {k_c2, k_c2},   {k_s1, k_c1},   {0, 1},  {-k_s1, k_c1}, {-k_c2, k_c2}, {-k_c1, k_s1},
    {-1, 0}, {-k_c1, -k_s1}, {-k_c2, -k_c2}, {-k_s1, -k_c1}, {0, -1}, {k_s1, -k_c1}, {k_c2, -k_c2}, {k_c1, -k_s1}};

// Largest |noise| with unit gradients. A value is a mean of four products with |product i| <= the distance to node i,
// weights s(u) and 1 - s(u) along each axis; by Jensen at most sqrt(E[u^2] + E[v^2]), each expectation at most 1/4.
inline constexpr double k_noise_limit = 0.70710678118654758;

// Largest noise octave count: 17 levels of root bits leave 16 halvings at most.
inline constexpr int k_max_octaves = 17;

inline const double* node_gradient(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = (x * 0x8da6b343u) ^ (y * 0xd8163841u) ^ seed;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return k_directions[h >> 28];
}

inline uint32_t octave_seed(uint32_t seed, int octave) {
  const uint32_t h = (seed + 0x9e3779b9u * (uint32_t(octave) + 1)) * 0x85ebca6bu;
  return h ^ (h >> 16);
}

inline double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
inline double fade_slope(double t) {
  return 30.0 * t * t * (t - 1.0) * (t - 1.0);
}

// Gradient noise (Perlin 2002) on cells of 2^bits lattice units; 0 at their corners.
inline double noise(glm::ivec2 p, int bits, uint32_t seed) {
  const int mask = (1 << bits) - 1;
  const double inverse = 1.0 / double(1 << bits);
  const double u = (p.x & mask) * inverse, v = (p.y & mask) * inverse;
  const uint32_t x = uint32_t(p.x >> bits), y = uint32_t(p.y >> bits);
  const double* g00 = node_gradient(x, y, seed);
  const double* g10 = node_gradient(x + 1, y, seed);
  const double* g01 = node_gradient(x, y + 1, seed);
  const double* g11 = node_gradient(x + 1, y + 1, seed);
  const double a00 = g00[0] * u + g00[1] * v, a10 = g10[0] * (u - 1.0) + g10[1] * v;
  const double a01 = g01[0] * u + g01[1] * (v - 1.0), a11 = g11[0] * (u - 1.0) + g11[1] * (v - 1.0);
  const double s = fade(u), t = fade(v);
  const double north = a00 + s * (a10 - a00), south = a01 + s * (a11 - a01);
  return north + t * (south - north);
}

// Value and derivative of the noise along x and y of its cell (z: value), in cell units.
glm::dvec3 noise_with_gradient(glm::ivec2 p, int bits, uint32_t seed);

// Sum of the octaves, that of octave 0 having amplitude 1. Ends where p is a node: it is one of every finer octave too.
inline double octave_sum(glm::ivec2 p, int step_bits, int octaves, uint32_t seed) {
  double sum = 0.0, amplitude = 1.0;
  for (int k = 0; k < octaves; ++k, amplitude *= 0.5) {
    const int bits = step_bits - k;
    if (((p.x | p.y) & ((1 << bits) - 1)) == 0) break;
    sum += amplitude * noise(p, bits, octave_seed(seed, k));
  }
  return sum;
}

// Derivative of octave_sum per sample spacing (x, y) and its value (z).
glm::dvec3 octave_sum_with_gradient(glm::ivec2 p, int step_bits, int octaves, uint32_t seed);

// Strength of the relief, 0..255, where the data's slope is that long.
uint8_t share(const ReliefOptions& options, float slope);

// Bounds per metre of octave 0's amplitude at full strength: entry i is the sum over the levels from data level + i to
// the end of what a split of such a level adds; `levels` entries and a last one of 0. See relief.cpp.
std::vector<double> bound_table(int octaves, int levels);

// Samples around a diamond's centre within which the strength counts for its bound: [first, last] of columns and rows,
// cut to the data; empty when last < first.
struct Window {
  glm::ivec2 first, last;
};
Window bound_window(const HeightField& field, LatticePoint centre, int level);

}  // namespace sward::relief
