// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What is static of the triangles around the eye, for seeding on the GPU: like a clipmap's ring, a window of cells over
// a torus of memory, of which only rows and columns that the window has come to are filled.
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <sward/vegetation/placement.h>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "vegetation/exclusion_index.h"
#include "vegetation/fertile_ground.h"
#include "vegetation/triangle_record.h"

namespace sward {

/// Mirror of `SeedGround` in shaders/common_seeding.glsl, std430.
struct SeedGround {
  glm::ivec2 texel{0};
  glm::vec2 texel_fraction{0};
  float area = 0;  ///< 0: no plant stands on it: padding, a hole, colours that feed no species, an excluded shape.
  float slope = 0;
  float bound = 0;          ///< How far the finest surface leaves the triangle, metres.
  uint32_t exclusions = 0;  ///< First texel of its run in ClipmapTable::exclusions(), 0: none.
  glm::vec4 altitude{0};
};
static_assert(sizeof(SeedGround) == 48);

/// Cells of a layer's seeding level. A cell of an even level holds two triangles, one of an odd level four, numbered as
/// point_in_candidate() in shaders/common_seeding.glsl does.
class ClipmapTable {
 public:
  /// `surface` must outlive it.
  ClipmapTable(const Layer& layer, const Surface& surface, const ColorMap& map);

  /// Moves the window to a view. Fails where it would hold more than k_most_candidates.
  Expected<void> follow(const View& view, const Exclusions* exclusions);
  /// Layer::season: references that move change what can be fed.
  void set_season(float season) { layer_.season = season; }
  /// The surface or its holes may have changed here: the next follow() fills what is around anew.
  void changed(const LatticeBox& box);

  static constexpr size_t k_most_candidates = size_t(1) << 22;
  int level() const { return level_; }
  int shift() const { return shift_; }     ///< log2 of a cell's side, lattice units.
  int cell_bits() const { return bits_; }  ///< log2 of cells along a root square's side.
  int triangles_a_cell() const { return a_cell_; }
  glm::ivec2 first() const { return first_; }
  glm::ivec2 cells() const { return cells_; }    ///< Of the window.
  glm::ivec2 memory() const { return memory_; }  ///< Of the torus: powers of two.
  size_t candidates() const { return size_t(cells_.x) * size_t(cells_.y) * size_t(a_cell_); }
  std::span<const SeedGround> ground() const { return ground_; }
  std::span<const glm::vec4> exclusions() const { return runs_; }

  /// Runs of ground() that the last follow() wrote: first element and how many.
  struct Run {
    size_t first, count;
  };
  std::span<const Run> written() const { return written_; }
  bool exclusions_written() const { return runs_written_; }

  /// No view from the window's middle cell submits more clusters than this.
  size_t most_clusters() const { return most_clusters_; }

 private:
  Expected<void> resize(glm::ivec2 cells);
  void fill(glm::ivec2 first, glm::ivec2 end);
  SeedGround make(glm::ivec2 cell, int triangle);
  bool references_moved();
  bool exclude(glm::dvec2 apex, glm::vec2 to_left, glm::vec2 to_right, SeedGround& ground);
  void bound_clusters(const View& view);
  size_t place_of(glm::ivec2 cell) const;

  Layer layer_;
  const Surface* surface_;
  RecordMaker maker_;
  ExclusionIndex index_;
  FertileGround fertile_;
  ColorMap map_;  // without texels
  float known_season_ = NAN;
  std::vector<glm::vec3> references_;  // of all species, now and at the season's next step
  int level_ = 0, bits_ = 0, shift_ = 0, a_cell_ = 2;
  double level_area_ = 0, reach_m_ = 0;
  glm::dvec2 cell_m_{1};
  bool filled_ = false, altitudes_ = false, runs_written_ = false;
  glm::ivec2 first_{0}, cells_{0}, memory_{0};
  glm::ivec2 stale_first_{0}, stale_end_{0};  // cells that have changed; none where the end is not beyond the first
  uint64_t exclusions_version_ = 0;
  double zoom_ = 0;
  size_t most_clusters_ = 0, runs_at_fill_ = 0;
  FixedTriangles scratch_;
  std::vector<SeedGround> ground_;
  std::vector<glm::vec4> runs_;
  std::vector<Run> written_;
};

/// Lattice corners of a cell's triangle, with its id: find_candidate() of shaders/common_seeding.glsl.
struct CandidateTriangle {
  TriangleId id;
  TriangleCorners corners;
};
CandidateTriangle find_candidate(int level, glm::ivec2 cell, int triangle);

}  // namespace sward
