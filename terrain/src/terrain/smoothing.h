// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// The smooth surface through the samples: bicubic convolution (Keys, "Cubic Convolution Interpolation for Digital Image
// Processing", 1981), once continuously differentiable, with central differences for slopes at the samples. See
// smoothing.cpp for what it adds to bounds.
namespace sward::smoothing {

// Samples around a cell; the cell's own are [1][1] (north-west) to [2][2]; rows run south, columns east.
using Patch = std::array<std::array<double, 4>, 4>;

// Fills a patch for cell (column, row) of a field of `size` samples; beyond the border samples go on straight.
template <class Sample>
Patch gather(const Sample* samples, glm::ivec2 size, glm::ivec2 cell) {
  Patch patch;
  const bool inner = cell.x > 0 && cell.y > 0 && cell.x + 2 < size.x && cell.y + 2 < size.y;
  for (int j = 0; j < 4; ++j) {
    const int row = inner ? cell.y + j - 1 : glm::clamp(cell.y + j - 1, 0, size.y - 1);
    const Sample* from = samples + int64_t(row) * size.x;
    for (int i = 0; i < 4; ++i) {
      const int column = inner ? cell.x + i - 1 : glm::clamp(cell.x + i - 1, 0, size.x - 1);
      patch[size_t(j)][size_t(i)] = double(from[column]);
    }
  }
  if (inner) return patch;
  for (auto& row : patch) {
    if (cell.x == 0) row[0] = 2.0 * row[1] - row[2];
    if (cell.x + 2 == size.x) row[3] = 2.0 * row[2] - row[1];
  }
  for (size_t i = 0; i < 4; ++i) {
    if (cell.y == 0) patch[0][i] = 2.0 * patch[1][i] - patch[2][i];
    if (cell.y + 2 == size.y) patch[3][i] = 2.0 * patch[2][i] - patch[1][i];
  }
  return patch;
}

constexpr std::array<double, 4> weights(double t) {
  return {0.5 * t * ((2.0 - t) * t - 1.0), 1.0 + 0.5 * t * t * (3.0 * t - 5.0), 0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
          0.5 * t * t * (t - 1.0)};
}

// Their derivatives.
constexpr std::array<double, 4> slope_weights(double t) {
  return {0.5 * (t * (4.0 - 3.0 * t) - 1.0), 0.5 * t * (9.0 * t - 10.0), 0.5 * (1.0 + t * (8.0 - 9.0 * t)),
          0.5 * t * (3.0 * t - 2.0)};
}

inline double weighted(const Patch& patch, const std::array<double, 4>& across, const std::array<double, 4>& along) {
  double sum = 0.0;
  for (size_t j = 0; j < 4; ++j) {
    const std::array<double, 4>& row = patch[j];
    sum += along[j] * (across[0] * row[0] + across[1] * row[1] + across[2] * row[2] + across[3] * row[3]);
  }
  return sum;
}

// A curvature, or metres, in eight bits: eight codes an octave from 2^-8 on, rounded up; 0 is 0.
uint8_t encode_up(double curvature);
double decode(uint8_t code);

// Bounds per unit of curvature: entry i is the sum over the levels from data level + i to the end of what splits of
// them add; `levels` entries and a last one of 0.
std::vector<double> bound_table(int levels);

// Levels below the data whose splits are tried one by one, and the shares of a cell's coarse value (metres) that bound
// what splits of data level + i and below add in it.
inline constexpr int k_tried_levels = 4;
inline constexpr std::array<double, k_tried_levels> k_coarse_shares{1.0, 0.75, 0.5, 0.4};

// Codes for a cell, heights in units of `scale`. `fine`: its curvature. `falls_east`: its diagonal begins in the
// north-west.
struct Codes {
  uint8_t coarse = 0, fine = 0;
};
Codes curvature_codes(const Patch& patch, double scale, bool falls_east, std::span<const double> table);

// What splits of data level + below and finer add at most where no cell has larger codes.
inline double bound(const Codes& largest, size_t below, std::span<const double> table) {
  if (below < k_tried_levels) return decode(largest.coarse) * k_coarse_shares[below];
  return decode(largest.fine) * table[below];
}

}  // namespace sward::smoothing
