// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/generated_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace sward::generated {

Grid::Grid(int samples, float metres, float value)
    : side(samples), spacing(metres), values(size_t(samples) * size_t(samples), value) {}

float Grid::clamped(int column, int row) const {
  return at(std::clamp(column, 0, side - 1), std::clamp(row, 0, side - 1));
}

namespace {

// Sample north-west of a position, and the fraction of a cell beyond it; inside the grid.
struct Cell {
  int column, row;
  float fx, fy;
};

Cell locate(const Grid& grid, glm::vec2 p) {
  const float last = float(grid.side - 1);
  const float u = std::clamp((p.x + grid.half()) / grid.spacing, 0.0f, last);
  const float v = std::clamp((grid.half() - p.y) / grid.spacing, 0.0f, last);
  const int column = std::min(int(u), grid.side - 2);
  const int row = std::min(int(v), grid.side - 2);
  return {column, row, u - float(column), v - float(row)};
}

float catmull_rom(float a, float b, float c, float d, float t) {
  return b + 0.5f * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

}  // namespace

float Grid::bilinear(glm::vec2 p) const {
  const Cell c = locate(*this, p);
  const float* north = &values[size_t(index(c.column, c.row))];
  const float* south = north + side;
  const float top = north[0] + (north[1] - north[0]) * c.fx;
  const float bottom = south[0] + (south[1] - south[0]) * c.fx;
  return top + (bottom - top) * c.fy;
}

float Grid::bicubic(glm::vec2 p) const {
  const Cell c = locate(*this, p);
  float line[4];
  for (int j = 0; j < 4; ++j) {
    const int row = c.row + j - 1;
    line[j] = catmull_rom(clamped(c.column - 1, row), clamped(c.column, row), clamped(c.column + 1, row),
                          clamped(c.column + 2, row), c.fx);
  }
  return catmull_rom(line[0], line[1], line[2], line[3], c.fy);
}

namespace {

// Cubic value halfway between b and c.
float middle(float a, float b, float c, float d) {
  return (9 * (b + c) - (a + d)) * 0.0625f;
}

}  // namespace

Grid refined(const Grid& grid) {
  Grid fine(2 * grid.side - 1, 0.5f * grid.spacing);
  for (int row = 0; row < grid.side; ++row) {
    for (int column = 0; column < grid.side; ++column) {
      fine.at(2 * column, 2 * row) = grid.at(column, row);
      if (column + 1 == grid.side) continue;
      fine.at(2 * column + 1, 2 * row) = middle(grid.clamped(column - 1, row), grid.at(column, row),
                                                grid.at(column + 1, row), grid.clamped(column + 2, row));
    }
  }
  for (int row = 1; row < fine.side; row += 2) {
    for (int column = 0; column < fine.side; ++column) {
      const int before = std::max(row - 3, 0);
      const int after = std::min(row + 3, fine.side - 1);
      fine.at(column, row) =
          middle(fine.at(column, before), fine.at(column, row - 1), fine.at(column, row + 1), fine.at(column, after));
    }
  }
  return fine;
}

Grid every_second(const Grid& grid) {
  Grid coarse((grid.side + 1) / 2, 2 * grid.spacing);
  for (int row = 0; row < coarse.side; ++row)
    for (int column = 0; column < coarse.side; ++column) coarse.at(column, row) = grid.at(2 * column, 2 * row);
  return coarse;
}

namespace {

// Box filter of 2 reach + 1 samples along one line of `count` samples `stride` apart; edges repeat.
void box_line(const float* source, float* target, int count, int stride, int reach) {
  const auto sample = [&](int i) { return double(source[std::ptrdiff_t(std::clamp(i, 0, count - 1)) * stride]); };
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += sample(i);
  const double scale = 1.0 / (2 * reach + 1);
  for (int i = 0; i < count; ++i) {
    target[std::ptrdiff_t(i) * stride] = float(sum * scale);
    sum += sample(i + reach + 1) - sample(i - reach);
  }
}

}  // namespace

Grid blurred(const Grid& grid, float radius) {
  // Three boxes of width w have the variance of a Gaussian of sigma^2 = (w^2 - 1) / 4.
  const float sigma = radius / grid.spacing;
  const int reach = int(0.5f * (std::sqrt(4 * sigma * sigma + 1) - 1) + 0.5f);
  if (reach < 1) return grid;
  Grid result = grid;
  Grid other(grid.side, grid.spacing);
  for (int pass = 0; pass < 3; ++pass) {
    for (int row = 0; row < grid.side; ++row) box_line(&result.at(0, row), &other.at(0, row), grid.side, 1, reach);
    for (int column = 0; column < grid.side; ++column)
      box_line(&other.at(column, 0), &result.at(column, 0), grid.side, grid.side, reach);
  }
  return result;
}

glm::vec2 gradient(const Grid& grid, int column, int row, int reach) {
  const int west = std::max(column - reach, 0), east = std::min(column + reach, grid.side - 1);
  const int north = std::max(row - reach, 0), south = std::min(row + reach, grid.side - 1);
  return {(grid.at(east, row) - grid.at(west, row)) / (float(east - west) * grid.spacing),
          (grid.at(column, north) - grid.at(column, south)) / (float(south - north) * grid.spacing)};
}

void for_each_row(int rows, int threads, const std::function<void(int row)>& body,
                  const std::function<void(float done)>& progress) {
  if (threads <= 0) threads = std::clamp(int(std::thread::hardware_concurrency()), 1, 16);
  std::atomic<int> next{0};
  const auto work = [&](bool reports) {
    for (int row = next++; row < rows; row = next++) {
      body(row);
      if (reports && progress && row % 64 == 0) progress(float(row) / float(rows));
    }
  };
  std::vector<std::jthread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work, false);
  work(true);
}

}  // namespace sward::generated
