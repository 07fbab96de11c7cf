// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/surface.h>

#include <algorithm>

namespace sward {

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
