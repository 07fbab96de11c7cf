// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/lattice.h>

#include <limits>

namespace sward {

glm::dvec2 Lattice::from_world(glm::dvec2 xy) const {
  const double column = (xy.x - origin.x) / spacing.x + 0.5 * (columns - 1);
  const double row = 0.5 * (rows - 1) - (xy.y - origin.y) / spacing.y;
  // A point computed to lie on the border may come out a rounding error beyond it.
  constexpr double k_slack = 1e-7;
  const double last_column = columns - 1, last_row = rows - 1;
  if (!(column >= -k_slack && column <= last_column + k_slack && row >= -k_slack && row <= last_row + k_slack)) {
    return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  }
  return glm::dvec2(std::clamp(column, 0.0, last_column), std::clamp(row, 0.0, last_row)) * double(sample_step());
}

}  // namespace sward
