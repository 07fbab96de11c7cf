// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>

namespace sward {

/// Lattice of bintree vertices. A root square is always 2^18 units wide, so that every vertex of every level is a pair
/// of integers; root square (c, r) spans [c, c+1] x [r, r+1] times k_root_side. x runs east, y runs SOUTH (image rows).
using LatticePoint = glm::ivec2;
inline constexpr int k_root_bits = 18;
inline constexpr int k_root_side = 1 << k_root_bits;
/// Deepest level of the 64-bit triangle id.
inline constexpr int k_max_level = 35;

/// A rectangle of lattice points, both corners included; empty when last < first.
struct LatticeBox {
  LatticePoint first{0}, last{-1};
  bool empty() const { return last.x < first.x || last.y < first.y; }
};

/// Where a surface's lattice lies in the world. x and y of a point are the same bits whenever they are asked for.
struct SWARD_API Lattice {
  int columns = 2, rows = 2;     ///< Samples west to east and north to south, of the whole surface.
  glm::dvec2 spacing{1.0, 1.0};  ///< Metres between samples.
  glm::dvec3 origin{0.0};        ///< World position of the data's middle.
  int root_bits = 1;             ///< log2 of the cells along a root square's side, 1..17.
  glm::ivec2 root_squares{1};    ///< Columns by rows.
  int max_level = 2;             ///< Deepest level of the mesh: data_level(), deeper with relief.

  /// Level whose triangles have legs one sample spacing long.
  int data_level() const { return 2 * root_bits; }
  /// Lattice units between samples.
  int sample_step() const { return k_root_side >> root_bits; }
  /// The lattice point of the last sample, in the south-east.
  LatticePoint last() const { return LatticePoint(columns - 1, rows - 1) * sample_step(); }
  bool inside(LatticePoint p) const {
    const LatticePoint end = last();
    return p.x >= 0 && p.y >= 0 && p.x <= end.x && p.y <= end.y;
  }
  glm::dvec2 world_xy(LatticePoint p) const {
    const double inverse = 1.0 / double(sample_step());
    return {origin.x + (p.x * inverse - 0.5 * (columns - 1)) * spacing.x,
            origin.y + (0.5 * (rows - 1) - p.y * inverse) * spacing.y};
  }
  /// Lattice coordinates (x east, y south) of a world position, on the data or beyond it.
  glm::dvec2 extended_from_world(glm::dvec2 xy) const;
  /// The same on the data; NaN beyond it.
  glm::dvec2 from_world(glm::dvec2 xy) const;
  /// Western/southern and eastern/northern corner of the data, world.
  glm::dvec2 min_corner() const { return world_xy({0, last().y}); }
  glm::dvec2 max_corner() const { return world_xy({last().x, 0}); }
  bool operator==(const Lattice&) const = default;
};

}  // namespace sward
