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
#include <cmath>

namespace sward::smoothing {

namespace {

constexpr double k_round_up = 1.0 + 1e-12;
constexpr int k_codes_an_octave = 8;
constexpr int k_lowest_exponent = -8;

double bend(double a, double b, double c, double d) {
  const double first = a - 2.0 * b + c, second = b - 2.0 * c + d;
  return std::max(std::abs(2.0 * first - second), std::abs(2.0 * second - first));
}

double over_rows(const std::array<double, 4>& bends) {
  return 1.125 * std::max(bends[1], bends[2]) + 0.125 * std::max(bends[0], bends[3]);
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

const std::array<double, 256>& codes() {
  static const std::array<double, 256> values = [] {
    std::array<double, 256> made{};
    for (int code = 1; code < 256; ++code) {
      made[size_t(code)] = std::exp2(double(code - 1) / k_codes_an_octave + k_lowest_exponent);
    }
    return made;
  }();
  return values;
}

}  // namespace

double curvature(const Patch& z) {
  std::array<double, 4> rows, columns;
  for (size_t i = 0; i < 4; ++i) {
    rows[i] = bend(z[i][0], z[i][1], z[i][2], z[i][3]);
    columns[i] = bend(z[0][i], z[1][i], z[2][i], z[3][i]);
  }
  const double uu = over_rows(rows), vv = over_rows(columns);
  return std::max({uu, vv, 0.5 * (uu + vv) + twist(z)});
}

uint8_t encode_up(double curvature) {
  if (!(curvature > 0.0)) return 0;
  const double up = curvature * k_round_up;
  const double place = std::ceil((std::log2(up) - k_lowest_exponent) * k_codes_an_octave) + 1.0;
  auto code = uint8_t(std::clamp(place, 1.0, 255.0));
  // The logarithm's rounding.
  if (codes()[code] < up && code < 255) ++code;
  return code;
}

double decode(uint8_t code) {
  return codes()[code];
}

std::vector<double> bound_table(int levels) {
  std::vector<double> table(size_t(levels) + 1, 0.0);
  for (int i = levels - 1; i >= 0; --i) {
    table[size_t(i)] = table[size_t(i) + 1] + std::ldexp(i % 2 == 0 ? 0.25 : 0.125, -2 * (i / 2));
  }
  return table;
}

}  // namespace sward::smoothing
