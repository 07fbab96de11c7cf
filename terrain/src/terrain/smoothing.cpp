// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the bicubic surface B adds to bounds. Base edges below the data's level lie in one cell, where B is a
// polynomial, so that a split at the middle m of an edge from l to r moves the surface by
//   |B(m) - (B(l) + B(r)) / 2| <= 1/8 max |second derivative along r - l|.
// In units of samples (u east, v south), j halvings below the data: an edge along an axis is 2^-j long and adds at most
// 4^-j / 8 max(|B_uu|, |B_vv|); a diagonal (2^-j, +-2^-j) adds at most 4^-j / 8 |B_uu +- 2 B_uv + B_vv|. With K a bound
// of the first and of half the second, splits of level data + 2j add K 4^-j / 4, those of level data + 2j + 1 K 4^-j
// / 8.
//
// K of a cell. Along one row z the cubic's second derivative is linear, from 2 D0 - D1 to 2 D1 - D0 with the second
// differences D0 = z[0] - 2 z[1] + z[2], D1 alike. B_uu is the mean of the four rows' with the weights w of v: those of
// the outer rows add up to -v (1 - v) / 2, at least -1/8, so those of the inner ones to at most 9/8. B_uv is a
// biquadratic: it lies within its Bezier points, which are M X M^T with X the 3 x 3 mixed differences of the samples
// and M the Bezier points of a Catmull-Rom segment's derivative by first differences.

#include "smoothing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sward::smoothing {

namespace {

constexpr double k_round_up = 1.0 + 1e-12;  // Of sums of a few products.
// Codes have three bits of mantissa; the first stands for 2^-8.
constexpr int k_dropped_bits = 52 - 3;
constexpr int64_t k_bias = (int64_t(1023 - 8) << 3) - 1;

// Second derivative of a row's cubic at the ends of the cell.
struct Bend {
  double begin, end;
};
Bend bend(double a, double b, double c, double d) {
  const double first = a - 2.0 * b + c, second = b - 2.0 * c + d;
  return {2.0 * first - second, 2.0 * second - first};
}

// Largest of the Bezier points of the cubic through b and c.
double largest_point(double a, double b, double c, double d) {
  return std::max({std::abs(b), std::abs(b + (c - a) / 6.0), std::abs(c - (d - b) / 6.0), std::abs(c)});
}

double over_rows(const std::array<Bend, 4>& bends) {
  return std::max(largest_point(bends[0].begin, bends[1].begin, bends[2].begin, bends[3].begin),
                  largest_point(bends[0].end, bends[1].end, bends[2].end, bends[3].end));
}

// Bezier points of the derivative by first differences.
std::array<double, 3> derivative_points(double a, double b, double c) {
  return {0.5 * (a + b), 2.0 * b - 0.5 * (a + c), 0.5 * (b + c)};
}

double twist(const Patch& z) {
  std::array<std::array<double, 3>, 3> rows;
  for (size_t j = 0; j < 3; ++j) {
    std::array<double, 3> mixed;
    for (size_t i = 0; i < 3; ++i) mixed[i] = z[j + 1][i + 1] - z[j + 1][i] - z[j][i + 1] + z[j][i];
    rows[j] = derivative_points(mixed[0], mixed[1], mixed[2]);
  }
  double largest = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    for (const double point : derivative_points(rows[0][i], rows[1][i], rows[2][i])) {
      largest = std::max(largest, std::abs(point));
    }
  }
  return largest;
}

// The K of a cell.
double curvature(const Patch& z) {
  std::array<Bend, 4> rows, columns;
  for (size_t i = 0; i < 4; ++i) {
    rows[i] = bend(z[i][0], z[i][1], z[i][2], z[i][3]);
    columns[i] = bend(z[0][i], z[1][i], z[2][i], z[3][i]);
  }
  const double uu = over_rows(rows), vv = over_rows(columns);
  return std::max({uu, vv, 0.5 * (uu + vv) + twist(z)});
}

constexpr std::array<std::array<double, 4>, 5> k_weights{weights(0.0), weights(0.25), weights(0.5), weights(0.75),
                                                         weights(1.0)};

// Heights at quarters of the cell.
using Quarters = std::array<std::array<double, 5>, 5>;

Quarters evaluate(const Patch& z) {
  std::array<std::array<double, 5>, 4> rows;
  for (size_t j = 0; j < 4; ++j) {
    for (size_t i = 0; i < 5; ++i) {
      const auto& w = k_weights[i];
      rows[j][i] = w[0] * z[j][0] + w[1] * z[j][1] + w[2] * z[j][2] + w[3] * z[j][3];
    }
  }
  Quarters quarters;
  for (size_t j = 0; j < 5; ++j) {
    const auto& w = k_weights[j];
    for (size_t i = 0; i < 5; ++i) {
      quarters[j][i] = w[0] * rows[0][i] + w[1] * rows[1][i] + w[2] * rows[2][i] + w[3] * rows[3][i];
    }
  }
  return quarters;
}

double off_middle(double middle, double left, double right) {
  return std::abs(middle - 0.5 * (left + right));
}

// Split of the square of side 2 h that begins at (i, j), along its diagonal.
double diagonal_split(const Quarters& z, size_t i, size_t j, size_t h, bool falls_east) {
  const size_t near = falls_east ? i : i + 2 * h, far = falls_east ? i + 2 * h : i;
  return off_middle(z[j + h][i + h], z[j][near], z[j + 2 * h][far]);
}

// Largest of the splits of sides of length 2 h.
double side_splits(const Quarters& z, size_t h) {
  double largest = 0.0;
  for (size_t across = 0; across < 5; across += 2 * h) {
    for (size_t at = 0; at < 4; at += 2 * h) {
      largest = std::max(largest, off_middle(z[across][at + h], z[across][at], z[across][at + 2 * h]));
      largest = std::max(largest, off_middle(z[at + h][across], z[at][across], z[at + 2 * h][across]));
    }
  }
  return largest;
}

}  // namespace

// A double's upper bits are the code but for the exponent's bias; adding all the lower bits rounds up.
uint8_t encode_up(double curvature) {
  if (!(curvature > 0.0)) return 0;
  const int64_t bits = std::bit_cast<int64_t>(curvature * k_round_up) + ((int64_t(1) << k_dropped_bits) - 1);
  return uint8_t(std::clamp<int64_t>((bits >> k_dropped_bits) - k_bias, 1, 255));
}

double decode(uint8_t code) {
  return code == 0 ? 0.0 : std::bit_cast<double>((code + k_bias) << k_dropped_bits);
}

std::vector<double> bound_table(int levels) {
  std::vector<double> table(size_t(levels) + 1, 0.0);
  for (int i = levels - 1; i >= 0; --i) {
    table[size_t(i)] = table[size_t(i) + 1] + std::ldexp(i % 2 == 0 ? 0.25 : 0.125, -2 * (i / 2));
  }
  return table;
}

Codes curvature_codes(const Patch& patch, double scale, bool falls_east, std::span<const double> table) {
  Codes codes;
  codes.fine = encode_up(scale * curvature(patch));
  if (codes.fine == 0) return codes;
  const Quarters z = evaluate(patch);
  // Squares of half a cell: the one in the north-west begins at even numbers.
  const double second = std::max(std::max(diagonal_split(z, 0, 0, 1, true), diagonal_split(z, 2, 2, 1, true)),
                                 std::max(diagonal_split(z, 2, 0, 1, false), diagonal_split(z, 0, 2, 1, false)));
  const std::array<double, k_tried_levels> splits{diagonal_split(z, 0, 0, 2, falls_east), side_splits(z, 2), second,
                                                  side_splits(z, 1)};
  const int levels = int(table.size()) - 1, tried = std::min(levels, k_tried_levels);
  double below = decode(codes.fine) * table[size_t(tried)], coarse = 0.0;
  for (int i = tried - 1; i >= 0; --i) {
    below += scale * splits[size_t(i)] * (1.0 + 1e-9);
    coarse = std::max(coarse, below / k_coarse_shares[size_t(i)]);
  }
  codes.coarse = encode_up(coarse);
  return codes;
}

}  // namespace sward::smoothing
