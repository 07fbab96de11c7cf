// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/lattice.h>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace sward {

/// A world: a grid of root squares of 2^root_bits + 1 samples a side, neighbours sharing their border samples. Sample
/// (column, row), row 0 the northern edge, stands where HeightField puts it. Squares in the last column and row may
/// reach beyond the data: that is padding, which repeats the edge and is never drawn. Samples are what they are: a
/// world has no relief below the data.
struct SWARD_API WorldDesc {
  int columns = 0;               ///< Samples west to east of the whole world, >= 2.
  int rows = 0;                  ///< Samples north to south, >= 2.
  glm::dvec2 spacing{1.0, 1.0};  ///< Metres between samples, > 0.
  glm::dvec3 origin{0.0};        ///< World position of the data's middle; z is added to every height.
  double scale = 1.0;            ///< Metres a raw unit, not 0.
  double offset = 0.0;           ///< Metres added after scaling.
  bool floats = false;           ///< Samples are stored as 32-bit floats, else as 16-bit unsigned integers.
  /// log2 of the cells along a square's side, 2..14. A square of 2049 x 2049 samples takes 17 MB (25 as floats).
  int root_bits = 10;
  /// log2 of the cells along a square's side that are always resident, 1..root_bits - 1. Costs 8 bytes a cell.
  int coarse_bits = 5;

  /// Fails, naming the value, when one is out of range or the world needs more than 1024 x 1024 squares.
  Expected<void> validate() const;
  /// Root squares, columns by rows.
  glm::ivec2 squares() const;
};

/// What of a world is always resident: every 2^(root_bits - coarse_bits)-th sample, with bounds that contain all the
/// detail below. Bounds are in the 16-bit format of Bounds; 0xffff: no valid sample below. Row by row, north first.
struct WorldCoarse {
  std::vector<float> heights;         ///< Raw units; squares * 2^coarse_bits + 1 a side.
  std::vector<uint16_t> bounds;       ///< Of the diamonds of levels 0 to 2 coarse_bits - 1, by their centre; so many.
  std::vector<uint16_t> cell_bounds;  ///< Of level 2 coarse_bits, by cell: squares * 2^coarse_bits a side.
};

/// The fine data of one square, read-only; `owner` keeps alive what the spans show. Row by row, north first, with
/// side = 2^root_bits + 1.
struct SquareData {
  /// Raw units: (side + 2)^2 samples, the square with one ring of its neighbours' around it (the edge repeated at the
  /// world's end); in `words` or, where WorldDesc::floats, in `floats`. The other one is empty.
  std::span<const uint16_t> words;
  std::span<const float> floats;
  /// side^2 bounds of the diamonds of levels 2 coarse_bits to 2 root_bits - 1, by the sample at their centre. Entries
  /// of coarser samples are not used.
  std::span<const uint16_t> bounds;
  /// One bit a sample of the square (bit i % 64 of word i / 64, i = row * side + column): no data there, the height is
  /// filled in. Empty where there is no hole.
  std::span<const uint64_t> holes;
  std::shared_ptr<const void> owner;
};

/// A rectangle of samples: column and row of the first, columns and rows.
struct SampleBox {
  glm::ivec2 first{0};
  glm::ivec2 size{0};
};

/// Gives heights in raw units for a box within the data, row by row: finite numbers, whole ones in 0..65535 unless
/// WorldDesc::floats. `holes` arrives zeroed; an entry that is set to another value marks a sample without data, whose
/// height is filled in all the same. Both spans have one entry a sample. The same sample must always be the same.
using ReadHeights =
    std::function<Expected<void>(const SampleBox& box, std::span<float> heights, std::span<uint8_t> holes)>;

/// Computes a square's fine data from samples: the square with a margin of one coarse cell around, so that bounds on
/// its borders are the same from both sides. `threads` 0: all cores. Cost: some 40 ns a sample a core. Any thread, if
/// `read` allows. Fails where `read` does, or on samples that WorldDesc does not allow.
SWARD_API Expected<SquareData> build_square(const WorldDesc& desc, glm::ivec2 square, const ReadHeights& read,
                                            int threads = 1);

/// Computes the resident part of a world by building each of its squares once. Cost: that of all of them.
SWARD_API Expected<WorldCoarse> build_coarse(const WorldDesc& desc, const ReadHeights& read,
                                             const Progress& progress = {});

}  // namespace sward
