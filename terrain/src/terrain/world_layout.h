// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/world_data.h>
#include <cstdint>
#include <glm/glm.hpp>

namespace sward::world {

/// Code of a diamond below which there is no valid sample.
inline constexpr uint16_t k_nothing = 0xffff;

/// Sizes and indices that follow from a valid description.
///
///   square (c, r)            samples [c * cells, (c + 1) * cells] x the same for rows, borders shared
///   coarse samples           every coarse_step-th sample, one grid over all squares
struct WorldLayout {
  explicit WorldLayout(const WorldDesc& desc);

  int side() const { return cells + 1; }
  int ring_side() const { return cells + 3; }
  size_t square_count() const { return size_t(squares.x) * size_t(squares.y); }
  size_t square_index(glm::ivec2 square) const { return size_t(square.y) * size_t(squares.x) + size_t(square.x); }
  bool has(glm::ivec2 square) const {
    return square.x >= 0 && square.y >= 0 && square.x < squares.x && square.y < squares.y;
  }
  size_t ring_samples() const { return size_t(ring_side()) * size_t(ring_side()); }
  size_t square_samples() const { return size_t(side()) * size_t(side()); }
  size_t hole_words() const { return (square_samples() + 63) / 64; }
  /// Bytes of a square's fine data; `holes`: with a mask.
  size_t square_bytes(bool holes) const;
  size_t coarse_samples() const { return size_t(coarse_last.x + 1) * size_t(coarse_last.y + 1); }
  size_t coarse_cells() const { return size_t(coarse_last.x) * size_t(coarse_last.y); }
  size_t coarse_index(glm::ivec2 at) const { return size_t(at.y) * size_t(coarse_last.x + 1) + size_t(at.x); }
  size_t cell_index(glm::ivec2 at) const { return size_t(at.y) * size_t(coarse_last.x) + size_t(at.x); }
  /// The lattice points of a square with all those whose diamonds depend on its fine data.
  LatticeBox reach_of(glm::ivec2 square) const;

  WorldDesc desc;
  Lattice lattice;
  glm::ivec2 squares;
  int cells;               // along a square's side
  int coarse_step;         // samples between coarse samples
  glm::ivec2 data_last;    // last sample of the data
  glm::ivec2 grid_last;    // last sample, padding included
  glm::ivec2 coarse_last;  // last coarse sample
  int step_bits;           // log2 of lattice units between samples
  int coarse_unit_bits;    // log2 of lattice units between coarse samples
};

/// Mask bit of a sample of a square (0-based within it).
inline bool is_hole(const WorldLayout& layout, const SquareData& data, glm::ivec2 at) {
  if (data.holes.empty()) return false;
  const size_t i = size_t(at.y) * size_t(layout.side()) + size_t(at.x);
  return (data.holes[i / 64] >> (i % 64) & 1) != 0;
}

/// Raw sample of a square; `at` 0-based within it, from -1 to side().
inline double raw_sample(const WorldLayout& layout, const SquareData& data, glm::ivec2 at) {
  const size_t i = size_t(at.y + 1) * size_t(layout.ring_side()) + size_t(at.x + 1);
  return layout.desc.floats ? double(data.floats[i]) : double(data.words[i]);
}

/// Gathers the coarse data from squares, each added once, in any order.
class CoarseBuilder {
 public:
  explicit CoarseBuilder(const WorldLayout& layout);
  void add(glm::ivec2 square, const SquareData& data);
  /// After all squares.
  WorldCoarse finish(int threads);

 private:
  WorldLayout layout_;
  WorldCoarse coarse_;
  std::vector<uint8_t> missing_;
};

}  // namespace sward::world
