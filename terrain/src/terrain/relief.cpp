// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Relief below the data: gradient noise (Ken Perlin, "Improving Noise", 2002) summed over octaves whose nodes contain
// the samples, times a strength f that is linear over each triangle of the data's level.
//
//   relief(p) = f(p) S(p),  S = sum over octaves k of A_k N_k,  A_k = roughness * cell_k = A_0 / 2^k,  0 <= f <= 1
//
// What a split below the data adds. Write j for the number of halvings from the sample spacing. Level data + 2j splits
// cells of spacing / 2^j along a diagonal, at the cell's centre; level data + 2j + 1 splits a side of such a cell, at
// its middle. Let the base edge run from l to r, m its middle, dev g = g(m) - (g(l) + g(r)) / 2.
//   - The base edge lies in one triangle of the data's level, where heights of the data and f are linear: the data
//     adds nothing, and f(l) = f(m) - a, f(r) = f(m) + a, so that dev(f S) = f(m) dev S - a (S(r) - S(l)) / 2.
//   - Octaves k > j are 0 at all three points: they are nodes.
//   - For k <= j the edge lies in one cell of octave k, and N_k there is linear in the four node gradients g_i:
//     N_k(p) = sum g_i . w_i(p) (p - node_i). So |dev N_k| <= sum |w_i(m)(m - node_i) - (w_i(l)(l - node_i) + ..)/2|
//     because |g_i| = 1. In units of that cell only d = j - k matters, and the largest value over the 4^d places is
//     found by trying them all. |N_k(r) - N_k(l)| is bounded alike; for d = 0 it is 0. Nothing depends on dx and dy,
//     since the noise, too, is a function of cell units.
//   - f changes by at most its range F over a triangle's legs and hypotenuse, so |a| <= F 2^-j / 2 along an axis and
//     <= F 2^-j along a diagonal.
// With F an upper bound of f, a split of that level adds at most
//   F sum over k of A_k ( D(j - k) + E(j - k) 2^-j h ),  h = 1/4 for sides, 1/2 for diagonals,
// D and E the two suprema. Beyond k_tried halvings they are not tried but bounded by the second and first derivative.

#include "relief.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::relief {

namespace {

// Rounding of the directions and of the sums below.
constexpr double k_round_up = 1.0 + 1e-9;
constexpr int k_tried = 6;

// Suprema over all edges of one kind, d halvings below the noise's cell.
struct EdgeLimits {
  double bend = 0;    // |N(m) - (N(l) + N(r)) / 2|
  double change = 0;  // |N(r) - N(l)|
};

struct LimitTable {
  std::array<EdgeLimits, k_max_octaves + 1> diagonal, side;
};

// Weight of node (i, j) at p times the vector from the node to p.
glm::dvec2 node_term(glm::dvec2 p, int i, int j) {
  const double wx = i == 0 ? 1.0 - fade(p.x) : fade(p.x);
  const double wy = j == 0 ? 1.0 - fade(p.y) : fade(p.y);
  return wx * wy * (p - glm::dvec2(i, j));
}

void try_edge(glm::dvec2 middle, glm::dvec2 half, EdgeLimits& limits) {
  double bend = 0.0, change = 0.0;
  for (int node = 0; node < 4; ++node) {
    const int i = node & 1, j = node >> 1;
    const glm::dvec2 l = node_term(middle - half, i, j), r = node_term(middle + half, i, j);
    bend += glm::length(node_term(middle, i, j) - 0.5 * (l + r));
    change += glm::length(r - l);
  }
  limits.bend = std::max(limits.bend, bend * k_round_up);
  limits.change = std::max(limits.change, change * k_round_up);
}

// Corner terms T = w(u) w(v) (u, v) with |w'| <= 15/8 and |w''| <= 10/sqrt(3), u, v <= 1: |T_u| <= sqrt(2) 15/8 w(v) +
// w(u) w(v), and sums over the corners, where weights add up to 1, give 6.4 for the first derivative along an axis. The
// second derivative is bounded alike: 24 along an axis, 120 along (1, 1) and (1, -1).
EdgeLimits derivative_limits(int halvings, bool diagonal) {
  const double half = std::ldexp(0.5, -halvings);
  const double first = diagonal ? 2.0 * 6.4 : 6.4;
  const double second = diagonal ? 120.0 : 24.0;
  return {0.5 * half * half * second, 2.0 * half * first};
}

LimitTable make_limits() {
  LimitTable table;
  for (int d = 0; d <= k_max_octaves; ++d) {
    if (d > k_tried) {
      table.diagonal[size_t(d)] = derivative_limits(d, true);
      table.side[size_t(d)] = derivative_limits(d, false);
      continue;
    }
    const int cells = 1 << d;
    const double size = 1.0 / cells;
    for (int row = 0; row <= cells; ++row) {
      for (int column = 0; column < cells; ++column) {
        const double along = (column + 0.5) * size, across = row * size;
        try_edge({along, across}, {0.5 * size, 0.0}, table.side[size_t(d)]);
        try_edge({across, along}, {0.0, 0.5 * size}, table.side[size_t(d)]);
        if (row == cells) continue;
        const glm::dvec2 centre(along, across + 0.5 * size);
        try_edge(centre, glm::dvec2(0.5, 0.5) * size, table.diagonal[size_t(d)]);
        try_edge(centre, glm::dvec2(0.5, -0.5) * size, table.diagonal[size_t(d)]);
      }
    }
  }
  // Both ends are nodes of the octave.
  table.diagonal[0].change = table.side[0].change = 0.0;
  return table;
}

}  // namespace

glm::dvec3 noise_with_gradient(glm::ivec2 p, int bits, uint32_t seed) {
  const int mask = (1 << bits) - 1;
  const double inverse = 1.0 / double(1 << bits);
  const double u = (p.x & mask) * inverse, v = (p.y & mask) * inverse;
  const uint32_t x = uint32_t(p.x >> bits), y = uint32_t(p.y >> bits);
  glm::dvec3 result(0.0);
  for (uint32_t node = 0; node < 4; ++node) {
    const uint32_t i = node & 1u, j = node >> 1;
    const double* g = node_gradient(x + i, y + j, seed);
    const double wx = i == 0 ? 1.0 - fade(u) : fade(u), wy = j == 0 ? 1.0 - fade(v) : fade(v);
    const double dwx = i == 0 ? -fade_slope(u) : fade_slope(u), dwy = j == 0 ? -fade_slope(v) : fade_slope(v);
    const double plane = g[0] * (u - i) + g[1] * (v - j);
    result += glm::dvec3(wy * (dwx * plane + wx * g[0]), wx * (dwy * plane + wy * g[1]), wx * wy * plane);
  }
  return result;
}

glm::dvec3 octave_sum_with_gradient(glm::ivec2 p, int step_bits, int octaves, uint32_t seed) {
  glm::dvec3 sum(0.0);
  for (int k = 0; k < octaves; ++k) {
    const glm::dvec3 octave = noise_with_gradient(p, step_bits - k, octave_seed(seed, k));
    // An octave's cell is 2^-k spacings, as is its amplitude: slopes of all octaves weigh the same.
    sum += glm::dvec3(octave.x, octave.y, octave.z * std::ldexp(1.0, -k));
  }
  return sum;
}

uint8_t share(const ReliefOptions& options, float slope) {
  const float t = std::min(slope / options.full_slope, 1.0f);
  const float rise = t * t * (3.0f - 2.0f * t);
  return uint8_t(255.0f * (options.flat_share + (1.0f - options.flat_share) * rise) + 0.5f);
}

std::vector<double> bound_table(int octaves, int levels) {
  static const LimitTable limits = make_limits();
  std::vector<double> table(size_t(levels) + 1, 0.0);
  for (int i = levels - 1; i >= 0; --i) {
    const int j = i / 2;
    const bool diagonal = i % 2 == 0;
    const auto& kind = diagonal ? limits.diagonal : limits.side;
    double added = 0.0;
    for (int k = 0; k <= std::min(j, octaves - 1); ++k) {
      const EdgeLimits& edge = kind[size_t(j - k)];
      const double strength_change = std::ldexp(diagonal ? 0.5 : 0.25, -j);
      added += std::ldexp(edge.bend + edge.change * strength_change, -k);
    }
    table[size_t(i)] = table[size_t(i) + 1] + added;
  }
  return table;
}

// A diamond's descendants reach beyond it. For an axis-aligned diamond (even level) of side s they stay within 1.5 s of
// its centre along x and y, for a diamond standing on its corner (odd level) with a base of 2 h within 2 h: the
// children of the first are of the second kind with h = s/2 at s/2 from the centre (s/2 + 2 s/2 = 1.5 s), those of the
// second are of the first kind with s = h at h/2 (h/2 + 1.5 h = 2 h). These boxes are nested, so the largest strength
// in them never grows from parent to child.
Window bound_window(const HeightField& field, LatticePoint centre, int level) {
  const int step = field.sample_step();
  const int side = k_root_side >> (level / 2);
  const int reach = level % 2 == 0 ? side + side / 2 : side;
  const glm::ivec2 data(field.desc().columns - 1, field.desc().rows - 1);
  const glm::ivec2 first = glm::max(centre - reach, glm::ivec2(0)) / step;
  const glm::ivec2 last = glm::min((centre + reach + (step - 1)) / step, data);
  return {first, last};
}

}  // namespace sward::relief
