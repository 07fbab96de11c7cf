// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace sward::generated {

/// A square of floats in the generator's own metres, in which a terrain is always 4096 m wide: x east, y north, both
/// about the middle; row 0 is the northern edge, as in images.
struct Grid {
  int side = 0;       ///< Samples along each side.
  float spacing = 1;  ///< Metres between samples.
  std::vector<float> values;

  Grid() = default;
  Grid(int samples, float metres, float value = 0);

  float half() const { return 0.5f * float(side - 1) * spacing; }
  int index(int column, int row) const { return row * side + column; }
  float& at(int column, int row) { return values[size_t(index(column, row))]; }
  float at(int column, int row) const { return values[size_t(index(column, row))]; }
  /// Indices beyond the grid repeat its edge.
  float clamped(int column, int row) const;
  glm::vec2 position(int column, int row) const {
    return {float(column) * spacing - half(), half() - float(row) * spacing};
  }
  /// Interpolated at a position; positions beyond the grid repeat its edge.
  float bilinear(glm::vec2 p) const;
  /// Catmull-Rom: smooth slopes, passes through the samples.
  float bicubic(glm::vec2 p) const;
};

/// Twice the resolution over the same square: (2 side - 1) samples, old ones kept, new ones by cubic interpolation.
Grid refined(const Grid& grid);
/// Half the resolution over the same square: (side + 1) / 2 samples of an odd number, none changed.
Grid every_second(const Grid& grid);
/// Gaussian-like blur (three box passes) of about `radius` metres standard deviation.
Grid blurred(const Grid& grid, float radius);
/// Slope dz/dx, dz/dy (north) by central differences over `reach` samples to each side.
glm::vec2 gradient(const Grid& grid, int column, int row, int reach = 1);

/// Calls body(row) for rows 0..rows-1 from up to `threads` threads (0: as many as the machine has). Rows must be
/// independent, so that the result does not depend on how many there are. `progress` runs on the calling thread.
void for_each_row(int rows, int threads, const std::function<void(int row)>& body,
                  const std::function<void(float done)>& progress = {});

}  // namespace sward::generated
