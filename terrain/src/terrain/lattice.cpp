// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/lattice.h>

#include <limits>

namespace sward {

namespace {

// Column and row of a world position, fractions included.
glm::dvec2 sample_at(const Lattice& l, glm::dvec2 xy) {
  return {(xy.x - l.origin.x) / l.spacing.x + 0.5 * (l.columns - 1),
          0.5 * (l.rows - 1) - (xy.y - l.origin.y) / l.spacing.y};
}

}  // namespace

glm::dvec2 Lattice::extended_from_world(glm::dvec2 xy) const {
  return sample_at(*this, xy) * double(sample_step());
}

glm::dvec2 Lattice::from_world(glm::dvec2 xy) const {
  const glm::dvec2 sample = sample_at(*this, xy);
  const double column = sample.x, row = sample.y;
  // A point computed to lie on the border may come out a rounding error beyond it.
  constexpr double k_slack = 1e-7;
  const double last_column = columns - 1, last_row = rows - 1;
  if (!(column >= -k_slack && column <= last_column + k_slack && row >= -k_slack && row <= last_row + k_slack)) {
    return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  }
  return glm::dvec2(std::clamp(column, 0.0, last_column), std::clamp(row, 0.0, last_row)) * double(sample_step());
}

}  // namespace sward
