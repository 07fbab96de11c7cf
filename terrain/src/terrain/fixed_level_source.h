// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/fixed_triangles.h>
#include <array>
#include <vector>

#include "roam_projection.h"
#include "roam_tree.h"

namespace sward::roam {

struct Chunk;

/// A corner on the drawn surface with its distances to the halfspaces of the frustum.
struct DrawnCorner {
  LatticePoint lattice{0};
  glm::dvec3 world{0};
  std::array<double, 6> plane{};
};

struct DrawnTriangle {
  TriangleId id;
  DrawnCorner apex, left, right;
  Cover cover = Cover::inside;
};

/// A sub-tree of the seeding level that may be in sight.
struct ChunkVisit {
  DrawnTriangle triangle;
  uint32_t node = k_none;  ///< The mesh's split node; k_none where nothing is finer than the triangle.
  unsigned active = 0;     ///< Halfspaces that do not hold all of it.
  float bound = 0;         ///< How far the surface leaves the triangle, metres, up or down.
  uint64_t key = 0;        ///< Ascending along a walk: the root's index, then the turns.
};

/// What a triangle of the level is to the view, in double precision.
struct ExactTriangle {
  bool visible = false;
  double distance = 0;
  float screen_area = 0;
};

/// Where a collection gets its chunks from, and one view's tests of triangles in double precision (Papavasiliou 2015,
/// section 3.1): of a triangle that is split only the new vertex is transformed (rule A); within a plane it is
/// interpolated, its distances to the halfspaces included, for they are linear (rule B).
class ChunkSource {
 public:
  /// All arguments must outlive it.
  ChunkSource(const Lattice& lattice, const View& view, const FixedLevelOptions& options);
  virtual ~ChunkSource() = default;

  const View& view() const { return view_; }
  const FixedLevelOptions& options() const { return options_; }
  const std::array<Plane, 6>& planes() const { return planes_; }

  /// Triangles of `chunk_level` <= options.level that may be in sight, in the order of their keys. Clears `visits`
  /// first.
  virtual void run(int chunk_level, std::vector<ChunkVisit>& visits) const = 0;
  /// Builds what is missing or out of date of a chunk `depth` levels above the seeding level; true if anything was.
  virtual bool refresh(ChunkVisit& visit, int depth, Chunk& chunk) const = 0;
  /// Whether refresh() is safe from several threads.
  virtual bool refreshes_side_by_side() const = 0;
  /// Triangle `index` of a chunk; the bits of `index` are the turns. Safe from several threads.
  virtual ExactTriangle exact(const ChunkVisit& visit, int depth, const Chunk& chunk, unsigned index) const = 0;

 protected:
  const Lattice& lattice() const { return lattice_; }
  DrawnCorner corner(LatticePoint lattice, glm::dvec3 world) const;
  DrawnCorner middle(const DrawnCorner& a, const DrawnCorner& b) const;
  /// Without its cover, which takes the corners that a split decides.
  static DrawnTriangle child(const DrawnTriangle& t, int turn, const DrawnCorner& m);
  /// What stands on the surface reaches `canopy_m` up and `spread_m` aside from it, the surface lies within `bound` of
  /// the triangle. Halfspaces that hold all of it are taken out of `active`.
  bool culled(const DrawnTriangle& t, double bound, unsigned& active) const;
  bool faces_away(const DrawnTriangle& t) const;
  /// Of a triangle that no other test leaves out.
  ExactTriangle measure(const DrawnTriangle& t) const;

 private:
  bool beyond_horizon(const DrawnTriangle& t, double bound) const;
  float screen_area(const DrawnTriangle& t) const;

  const Lattice& lattice_;
  const View& view_;
  const FixedLevelOptions& options_;
  std::array<Plane, 6> planes_;
  glm::dmat4 clip_;
  double horizon2_ = 0;
};

/// Key of a triangle below root number `root`.
inline uint64_t chunk_key(uint64_t root, TriangleId id) {
  constexpr uint64_t k_turns = (uint64_t(1) << k_max_level) - 1;
  return root << k_max_level | (id.bits & k_turns);
}

}  // namespace sward::roam
