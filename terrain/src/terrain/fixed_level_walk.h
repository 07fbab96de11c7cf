// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fixed_level_source.h"

namespace sward::roam {

/// Where a vertex is drawn, world: the one place that fixed-level triangles take heights of the mesh from.
inline glm::dvec3 drawn_position(const RoamTree& tree, uint32_t vertex) {
  return tree.vertices.drawn(vertex);
}

/// The walk over the mesh's tree. Const calls are safe from several threads.
class FixedLevelWalk final : public ChunkSource {
 public:
  FixedLevelWalk(const RoamTree& tree, const View& view, const FixedLevelOptions& options)
      : ChunkSource(tree.lattice(), view, options), tree_(tree) {}

  const RoamTree& tree() const { return tree_; }

  void run(int chunk_level, std::vector<ChunkVisit>& visits) const override;
  bool refresh(ChunkVisit& visit, int depth, Chunk& chunk) const override;
  bool refreshes_side_by_side() const override { return true; }
  ExactTriangle exact(const ChunkVisit& visit, int depth, const Chunk& chunk, unsigned index) const override;

 private:
  DrawnCorner corner(uint32_t vertex) const;

  struct Run {
    int chunk_level;
    uint32_t root;
    std::vector<ChunkVisit>& visits;
  };
  void visit(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active) const;
  void split_flat(const Run& run, const DrawnTriangle& t, unsigned active) const;
  void add(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active) const;

  const RoamTree& tree_;
};

}  // namespace sward::roam
