// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/fixed_triangles.h>
#include <array>
#include <vector>

#include "roam_projection.h"
#include "roam_tree.h"

namespace sward::roam {

/// Where a vertex is drawn, world: the one place that fixed-level triangles take heights of the mesh from.
inline glm::dvec3 drawn_position(const RoamTree& tree, uint32_t vertex) {
  return tree.vertices.drawn(vertex);
}

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
  uint32_t node = k_none;  ///< The mesh's split node; k_none where a leaf covers the triangle.
  unsigned active = 0;     ///< Halfspaces that do not hold all of it.
  uint64_t key = 0;        ///< Ascending along a walk: the root's index, then the turns.
};

/// What a triangle of the level is to the view, in double precision.
struct ExactTriangle {
  bool visible = false;
  double distance = 0;
  float screen_area = 0;
};

/// Section 3.1 of Papavasiliou (2015) in double precision: one view's tests of triangles, and the walk over the mesh's
/// tree. Of a triangle that is split only the new vertex is transformed (rule A); below a leaf it is interpolated, its
/// distances to the halfspaces included, for they are linear (rule B). Const calls are safe from several threads.
class FixedLevelWalk {
 public:
  FixedLevelWalk(const RoamTree& tree, const View& view, const FixedLevelOptions& options);

  const RoamTree& tree() const { return tree_; }
  const View& view() const { return view_; }
  const FixedLevelOptions& options() const { return options_; }
  const std::array<Plane, 6>& planes() const { return planes_; }

  /// Triangles of `chunk_level` <= options.level, in the order of their keys. Clears `visits` first.
  void run(int chunk_level, std::vector<ChunkVisit>& visits) const;
  /// Triangle `index` of a chunk `depth` levels above the seeding level; the bits of `index` are the turns.
  ExactTriangle exact(const ChunkVisit& visit, int depth, unsigned index) const;

 private:
  DrawnCorner corner(uint32_t vertex) const;
  DrawnCorner middle(const DrawnCorner& a, const DrawnCorner& b) const;
  DrawnTriangle child(const DrawnTriangle& t, int turn, const DrawnCorner& m) const;
  bool culled(const DrawnTriangle& t, double bound, unsigned& active) const;
  bool beyond_horizon(const DrawnTriangle& t, double bound) const;
  bool faces_away(const DrawnTriangle& t) const;
  float screen_area(const DrawnTriangle& t) const;

  struct Run {
    int chunk_level;
    uint32_t root;
    std::vector<ChunkVisit>& visits;
  };
  void visit(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active) const;
  void split_flat(const Run& run, const DrawnTriangle& t, unsigned active) const;
  static void add(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active);

  const RoamTree& tree_;
  const View& view_;
  const FixedLevelOptions& options_;
  std::array<Plane, 6> planes_;
  glm::dmat4 clip_;
  double horizon2_ = 0;
};

}  // namespace sward::roam
