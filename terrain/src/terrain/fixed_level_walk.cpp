// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "fixed_level_walk.h"

#include "fixed_level_chunk.h"

namespace sward::roam {

void FixedLevelWalk::run(int chunk_level, std::vector<ChunkVisit>& visits) const {
  visits.clear();
  for (uint32_t root = 0; root < tree_.root_count(); ++root) {
    const Corners& c = tree_.corner[root];
    visit({chunk_level, root, visits}, root,
          {tree_.nodes[root].id, corner(c.apex), corner(c.left), corner(c.right), tree_.nodes[root].cover},
          k_all_halfspaces);
  }
}

DrawnCorner FixedLevelWalk::corner(uint32_t vertex) const {
  return ChunkSource::corner(tree_.vertices.lattice[vertex], drawn_position(tree_, vertex));
}

void FixedLevelWalk::visit(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active) const {
  const bool leaf = tree_.is_leaf(node);
  if (culled(t, leaf ? 0.0 : double(tree_.corner[node].bound), active)) return;
  if (leaf) {
    if (!faces_away(t)) split_flat(run, t, active);
  } else if (t.id.level() == run.chunk_level) {
    add(run, node, t, active);
  } else {
    const uint32_t first = tree_.child[node];
    const DrawnCorner m = corner(tree_.corner[first].apex);
    for (int turn = 0; turn < 2; ++turn) {
      DrawnTriangle below = child(t, turn, m);
      below.cover = tree_.nodes[first + uint32_t(turn)].cover;
      visit(run, first + uint32_t(turn), below, active);
    }
  }
}

// `t` lies in the plane of a leaf and has been culled against `active`.
void FixedLevelWalk::split_flat(const Run& run, const DrawnTriangle& t, unsigned active) const {
  if (t.id.level() == run.chunk_level) return add(run, k_none, t, active);
  const DrawnCorner m = middle(t.left, t.right);
  for (int turn = 0; turn < 2; ++turn) {
    DrawnTriangle below = child(t, turn, m);
    below.cover = cover_of(lattice(), {below.apex.lattice, below.left.lattice, below.right.lattice}, t.cover);
    unsigned still_active = active;
    if (!culled(below, 0.0, still_active)) split_flat(run, below, still_active);
  }
}

void FixedLevelWalk::add(const Run& run, uint32_t node, const DrawnTriangle& t, unsigned active) const {
  const float bound = node == k_none ? 0.0f : tree_.corner[node].bound;
  run.visits.push_back({t, node, active, bound, chunk_key(run.root, t.id)});
}

bool FixedLevelWalk::refresh(ChunkVisit& visit, int depth, Chunk& chunk) const {
  const bool stale = !chunk.has_static || chunk.altitude.empty() == options().altitudes;
  if (stale) build_static(*this, visit, depth, chunk);
  return refresh_drawn(tree_, visit, depth, chunk) || stale;
}

ExactTriangle FixedLevelWalk::exact(const ChunkVisit& visit, int depth, const Chunk&, unsigned index) const {
  DrawnTriangle t = visit.triangle;
  uint32_t node = visit.node;
  unsigned active = visit.active;
  while (depth-- > 0) {
    const int turn = int(index >> depth & 1);
    const bool flat = node == k_none;
    const uint32_t first = flat ? k_none : tree_.child[node];
    t = child(t, turn, flat ? middle(t.left, t.right) : corner(tree_.corner[first].apex));
    t.cover = cover_of(lattice(), {t.apex.lattice, t.left.lattice, t.right.lattice}, t.cover);
    if (!flat) node = first + uint32_t(turn);
    const bool leaf = !flat && tree_.is_leaf(node);
    if (culled(t, flat || leaf ? 0.0 : double(tree_.corner[node].bound), active) || (leaf && faces_away(t))) return {};
    if (leaf) node = k_none;
  }
  if (node != k_none && faces_away(t)) return {};
  return measure(t);
}

}  // namespace sward::roam
