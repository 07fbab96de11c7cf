// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/surface.h>

#include <algorithm>

namespace sward {

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
