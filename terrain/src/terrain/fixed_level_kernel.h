// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fixed_level_chunk.h"

namespace sward::roam {

/// Triangles of a chunk as weights of the chunk's edges apex-left and apex-right: (s, t) of a triangle's apex, and what
/// leads from there to its left and right. The same for every chunk of a depth.
struct ChunkPattern {
  struct Weights {
    std::array<float, k_chunk_size> s{}, t{};
  };
  Weights apex, left, right;
};
/// `depth` in [0, k_chunk_depth]. Safe from several threads.
const ChunkPattern& chunk_pattern(int depth);

/// Distances, projected areas and visibility of a chunk's triangles for one view.
///
/// In single precision, relative to the chunk, for all triangles side by side. Where a test comes out closer than
/// rounding could move it, the triangle is tested again by ChunkSource::exact(), so that the set is that of double
/// precision.
class ChunkKernel {
 public:
  /// `source` must outlive the kernel.
  explicit ChunkKernel(const ChunkSource& source);
  /// Distances and areas are written for visible triangles; others' are unspecified. Safe from several threads.
  void evaluate(const ChunkVisit& visit, int depth, const Chunk& chunk, ChunkResult& result) const;

 private:
  /// What one chunk's triangles share.
  struct Frame;
  struct Range;
  struct Columns {
    float *distance, *screen_area, *margin;  // apart from each other and from everything read
  };
  /// By how many metres a triangle passes its tests.
  using Margins = std::array<float, k_chunk_size>;

  Frame frame_of(const ChunkVisit& visit, int depth, const Chunk& chunk) const;
  unsigned blocks_in_sight(const ChunkVisit& visit, float bound) const;
  void measure(const Frame& frame, Range range, const Chunk& chunk, const Columns& to) const;
  void test_halfspace(const Frame& frame, unsigned i, Range range, const Chunk& chunk, Margins& margins) const;
  uint64_t test_near(const Frame& frame, Range range, const Chunk& chunk, ChunkResult& result) const;

  struct Halfspace {
    glm::vec3 n;
    float up, reach;  // of the canopy and what spreads from it; of a bound
  };
  const ChunkSource& source_;
  std::array<Halfspace, 6> halfspaces_;
  // Rows x, y (x scaled to units of half the viewport's height) and w of the clip matrix.
  glm::dvec4 row_w_;
  glm::vec3 w_;
  // Twice the image of a triangle with normal n (unscaled) at p has the area n . (determinant p + shift) / (w w w).
  float determinant_ = 0;
  glm::vec3 shift_{0};
  float horizon_ = 0, canopy_ = 0;
};

}  // namespace sward::roam
