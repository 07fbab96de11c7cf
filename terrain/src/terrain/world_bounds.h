// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace sward::world {

/// Nodes over which diamonds' bounds are computed: part of a world's samples, or all of its coarse ones. Corners are
/// multiples of twice the widest spacing asked for.
struct BoundsGrid {
  glm::ivec2 first{0}, last{0};      // nodes, both included
  std::span<const float> raw;        // by node, row by row
  std::span<const uint8_t> missing;  // by node: not 0 where there is no data
  double scale = 1;                  // metres a raw unit
  std::span<uint16_t> stored;        // by node; what is not computed stays
  /// Bounds of the level below the nodes', by cell between them, row by row; empty: nothing lies below.
  std::span<const uint16_t> cells;
};

/// Bottom-up over spacings 1, 2, 4 .. `widest`: for each the diamonds with their base along an axis, then those with
/// their base along a diagonal. `root_spacing`: where half a root square's side is reached, bases all run the same way;
/// 0: never. `threads` 0: all cores.
void build_bounds(const BoundsGrid& grid, int widest, int root_spacing, int threads);

}  // namespace sward::world
