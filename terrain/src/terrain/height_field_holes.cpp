// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Pull-push (Gortler et al., "The Lumigraph", 1996): means of what is known go up a pyramid until nothing is missing,
// then missing samples come down interpolated. Relaxation towards the membrane (Laplace's equation) on every level on
// the way down takes out what blocks are left, so that a fill lies between the heights at its rim.

#include "height_field_holes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sward {

namespace {

constexpr int k_sweeps = 24;

struct Level {
  int columns = 0, rows = 0;
  std::vector<float> values;
  std::vector<uint8_t> missing;

  size_t index(int column, int row) const { return size_t(row) * size_t(columns) + size_t(column); }
  float at_clamped(int column, int row) const {
    return values[index(std::clamp(column, 0, columns - 1), std::clamp(row, 0, rows - 1))];
  }
};

bool any_missing(const Level& level) {
  return std::find_if(level.missing.begin(), level.missing.end(), [](uint8_t m) { return m != 0; }) !=
         level.missing.end();
}

Level pull(const Level& fine) {
  Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
  coarse.values.assign(size_t(coarse.columns) * size_t(coarse.rows), 0.0f);
  coarse.missing.assign(coarse.values.size(), 1);
  for (int row = 0; row < coarse.rows; ++row) {
    for (int column = 0; column < coarse.columns; ++column) {
      double sum = 0.0;
      int known = 0;
      for (int y = 2 * row; y < std::min(2 * row + 2, fine.rows); ++y) {
        for (int x = 2 * column; x < std::min(2 * column + 2, fine.columns); ++x) {
          if (fine.missing[fine.index(x, y)] != 0) continue;
          sum += double(fine.values[fine.index(x, y)]);
          ++known;
        }
      }
      if (known == 0) continue;
      coarse.values[coarse.index(column, row)] = float(sum / known);
      coarse.missing[coarse.index(column, row)] = 0;
    }
  }
  return coarse;
}

// A fine sample stands a quarter of a coarse spacing from the middle of its block.
float interpolate(const Level& coarse, int column, int row) {
  const int x = column / 2, y = row / 2;
  const int across = column % 2 == 0 ? x - 1 : x + 1, along = row % 2 == 0 ? y - 1 : y + 1;
  return 0.5625f * coarse.at_clamped(x, y) + 0.1875f * coarse.at_clamped(across, y) +
         0.1875f * coarse.at_clamped(x, along) + 0.0625f * coarse.at_clamped(across, along);
}

float mean_of_neighbours(const Level& level, int column, int row) {
  double sum = 0.0;
  int count = 0;
  const auto add = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= level.columns || y >= level.rows) return;
    sum += double(level.values[level.index(x, y)]);
    ++count;
  };
  add(column - 1, row);
  add(column + 1, row);
  add(column, row - 1);
  add(column, row + 1);
  return float(sum / count);
}

struct Place {
  int column, row;
};

void relax(Level& level, const std::vector<Place>& places) {
  // Forward and backward sweeps in turn: Gauss-Seidel without a preferred direction.
  for (int sweep = 0; sweep < k_sweeps; sweep += 2) {
    for (size_t i = 0; i < places.size(); ++i) {
      level.values[level.index(places[i].column, places[i].row)] =
          mean_of_neighbours(level, places[i].column, places[i].row);
    }
    for (size_t i = places.size(); i-- > 0;) {
      level.values[level.index(places[i].column, places[i].row)] =
          mean_of_neighbours(level, places[i].column, places[i].row);
    }
  }
}

void push(const Level& coarse, Level& fine) {
  std::vector<Place> places;
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      if (fine.missing[fine.index(column, row)] == 0) continue;
      fine.values[fine.index(column, row)] = interpolate(coarse, column, row);
      places.push_back({column, row});
    }
  }
  relax(fine, places);
}

}  // namespace

void fill_holes(std::vector<float>& values, const std::vector<uint8_t>& missing, int columns, int rows) {
  std::vector<Level> pyramid;
  pyramid.push_back({columns, rows, std::move(values), missing});
  while (any_missing(pyramid.back())) pyramid.push_back(pull(pyramid.back()));
  for (size_t i = pyramid.size() - 1; i-- > 0;) push(pyramid[i + 1], pyramid[i]);
  values = std::move(pyramid.front().values);
}

}  // namespace sward
