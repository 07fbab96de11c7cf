// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "world_layout.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sward {

namespace {

constexpr int k_least_root_bits = 2, k_most_root_bits = 14;
// Root squares that a triangle's id can name, along a side.
constexpr int k_most_squares = 1024;

}  // namespace

Expected<void> WorldDesc::validate() const {
  const std::string name = "world of " + std::to_string(columns) + " x " + std::to_string(rows) + " samples";
  if (columns < 2 || rows < 2) return fail(name + " is too small: at least 2 x 2 are needed");
  if (root_bits < k_least_root_bits || root_bits > k_most_root_bits) {
    return fail(name + ": root_bits must lie in 2..14 (squares of 5 to 16385 samples a side)");
  }
  if (coarse_bits < 1 || coarse_bits >= root_bits) return fail(name + ": coarse_bits must lie in 1..root_bits - 1");
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(spacing.x) || !positive(spacing.y)) return fail(name + ": spacing must be above 0 metres");
  if (!std::isfinite(scale) || scale == 0.0 || !std::isfinite(offset)) {
    return fail(name + ": height scale must be finite and not 0, offset finite");
  }
  if (!std::isfinite(origin.x) || !std::isfinite(origin.y) || !std::isfinite(origin.z)) {
    return fail(name + ": the origin must be finite");
  }
  const glm::ivec2 needed = squares();
  if (needed.x > k_most_squares || needed.y > k_most_squares) {
    return fail(name + " needs " + std::to_string(needed.x) + " x " + std::to_string(needed.y) +
                " squares; at most 1024 x 1024 can be: make them larger");
  }
  return {};
}

glm::ivec2 WorldDesc::squares() const {
  const int cells = 1 << root_bits;
  return {(columns - 2) / cells + 1, (rows - 2) / cells + 1};
}

namespace world {

WorldLayout::WorldLayout(const WorldDesc& d)
    : desc(d),
      squares(d.squares()),
      cells(1 << d.root_bits),
      coarse_step(1 << (d.root_bits - d.coarse_bits)),
      data_last(d.columns - 1, d.rows - 1),
      grid_last(squares * cells),
      coarse_last(squares * (1 << d.coarse_bits)),
      step_bits(k_root_bits - d.root_bits),
      coarse_unit_bits(k_root_bits - d.coarse_bits) {
  lattice = {d.columns, d.rows, d.spacing, d.origin, d.root_bits, squares, 2 * d.root_bits};
}

size_t WorldLayout::square_bytes(bool holes) const {
  const size_t sample = desc.floats ? sizeof(float) : sizeof(uint16_t);
  return ring_samples() * sample + square_samples() * sizeof(uint16_t) +
         (holes ? hole_words() * sizeof(uint64_t) : size_t(0));
}

// The finest coarse diamonds of the square have their descendants within one and a half of their cells' sides of their
// centres (bound_window in relief.cpp derives it): one cell beyond the square.
LatticeBox WorldLayout::reach_of(glm::ivec2 square) const {
  const int cell = 1 << coarse_unit_bits;
  const LatticePoint first = square * k_root_side;
  return {glm::max(first - cell, LatticePoint(0)), glm::min(first + k_root_side + cell, squares * k_root_side)};
}

}  // namespace world

}  // namespace sward
