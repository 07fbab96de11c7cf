// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/surface.h>

#include <algorithm>

#include "bounds_parallel.h"

namespace sward {

namespace {

// at(point, place in `out`) for every point of a grid, moved onto the data.
template <class At>
void for_grid(const Lattice& lattice, const LatticeGrid& grid, At&& at) {
  const LatticePoint last = lattice.last();
  parallel_rows({grid.count.y, grid.count.x, 0}, {}, [&](int row) {
    for (int column = 0; column < grid.count.x; ++column) {
      const LatticePoint p = grid.first + grid.stride * glm::ivec2(column, row);
      at(glm::clamp(p, LatticePoint(0), last), size_t(row) * size_t(grid.count.x) + size_t(column));
    }
  });
}

}  // namespace

void Surface::data_gradients(glm::ivec2 first, int stride, glm::ivec2 count, std::span<glm::vec2> out) const {
  SWARD_ASSERT(out.size() == size_t(count.x) * size_t(count.y), "data_gradients: one place a sample");
  const Lattice& l = lattice();
  const glm::ivec2 last(l.columns - 1, l.rows - 1);
  size_t i = 0;
  for (int row = 0; row < count.y; ++row)
    for (int column = 0; column < count.x; ++column) {
      const glm::ivec2 sample = glm::clamp(first + stride * glm::ivec2(column, row), glm::ivec2(0), last);
      out[i++] = glm::vec2(data_gradient(l.world_xy(sample * l.sample_step())));
    }
}

void Surface::grid_heights(const LatticeGrid& grid, double base, std::span<float> out) const {
  SWARD_ASSERT(out.size() == grid.size(), "grid_heights: one place a point");
  const Lattice& l = lattice();
  for_grid(l, grid, [&](LatticePoint p, size_t i) { out[i] = float(height(l.world_xy(p)) - base); });
}

void Surface::grid_relief(const LatticeGrid& grid, std::span<glm::vec2> out) const {
  SWARD_ASSERT(out.size() == grid.size(), "grid_relief: one place a point");
  for_grid(lattice(), grid, [&](LatticePoint p, size_t i) { out[i] = glm::vec2(relief_gradient(p)); });
}

// Lattice points need no search for the triangle around them.
void FieldSurface::grid_heights(const LatticeGrid& grid, double base, std::span<float> out) const {
  SWARD_ASSERT(out.size() == grid.size(), "grid_heights: one place a point");
  for_grid(lattice(), grid, [&](LatticePoint p, size_t i) { out[i] = float(field_->height(p) - base); });
}

void FieldSurface::grid_relief(const LatticeGrid& grid, std::span<glm::vec2> out) const {
  SWARD_ASSERT(out.size() == grid.size(), "grid_relief: one place a point");
  for_grid(lattice(), grid, [&](LatticePoint p, size_t i) { out[i] = glm::vec2(field_->relief_gradient(p)); });
}

bool FieldSurface::all_holes(const LatticeBox& box) const {
  if (field_->hole_count() == 0) return false;
  const int step = lattice().sample_step();
  const LatticePoint low = box.first / step;
  const LatticePoint high = (box.last + (step - 1)) / step;
  const int last_column = std::min(high.x, lattice().columns - 1), last_row = std::min(high.y, lattice().rows - 1);
  for (int row = low.y; row <= last_row; ++row)
    for (int column = low.x; column <= last_column; ++column)
      if (!field_->is_hole(column, row)) return false;
  return true;
}

}  // namespace sward
