// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a chunk is built from is compared with the mesh at every visit, instead of being told of changes: the chunk's
// corners, and, where the mesh is finer, every split below it. That costs about as much as copying the result, and no
// missed frame, restart or edit can leave a chunk stale.
#include "fixed_level_chunk.h"

#include <algorithm>
#include <cmath>

namespace sward::roam {

namespace {

TriangleCorners lattice_of(const DrawnTriangle& t) {
  return {t.apex.lattice, t.left.lattice, t.right.lattice};
}

LatticeBox box_of(const TriangleCorners& c) {
  return {glm::min(c.apex, glm::min(c.left, c.right)), glm::max(c.apex, glm::max(c.left, c.right))};
}

class StaticBuilder {
 public:
  StaticBuilder(const FixedLevelWalk& walk, Chunk& chunk)
      : surface_(walk.tree().surface()), lattice_(walk.tree().lattice()), chunk_(chunk) {
    const double cells = double(int64_t(1) << lattice_.root_bits);
    level_area_ = std::ldexp(0.5 * cells * cells * lattice_.spacing.x * lattice_.spacing.y, -walk.options().level);
  }

  void descend(const TriangleCorners& c, Cover cover, int depth, unsigned index) {
    if (depth == 0) return put(c, cover, index);
    for (unsigned turn = 0; turn < 2; ++turn) {
      const TriangleCorners child = child_corners(c, int(turn));
      descend(child, cover_of(lattice_, child, cover), depth - 1, 2 * index + turn);
    }
  }

 private:
  void put(const TriangleCorners& c, Cover cover, unsigned index) {
    if (cover == Cover::padding || surface_.all_holes(box_of(c))) return;
    const glm::dvec2 apex = lattice_.world_xy(c.apex), left = lattice_.world_xy(c.left),
                     right = lattice_.world_xy(c.right);
    chunk_.apex[index] = glm::dvec3(apex, 0);
    chunk_.to_left[index] = glm::vec3(glm::vec2(left - apex), 0);
    chunk_.to_right[index] = glm::vec3(glm::vec2(right - apex), 0);
    const glm::dvec2 gradient = surface_.data_gradient((apex + left + right) / 3.0);
    chunk_.area[index] = float(level_area_ * std::sqrt(1.0 + glm::dot(gradient, gradient)));
    if (!chunk_.altitude.empty()) {
      chunk_.altitude[index] = glm::vec3(surface_.height(apex), surface_.height(left), surface_.height(right));
    }
    chunk_.solid |= uint64_t(1) << index;
  }

  const Surface& surface_;
  const Lattice& lattice_;
  Chunk& chunk_;
  double level_area_ = 0;  // horizontal, square metres
};

// Heights alone; corners are given as their z: (apex, left, right).
class DrawnBuilder {
 public:
  DrawnBuilder(const RoamTree& tree, Chunk& chunk) : tree_(tree), chunk_(chunk), base_z_(chunk.corner_z[0]) {}

  float rise() const { return rise_; }  // the largest along a triangle's edges

  // Below a split node of the mesh.
  void descend(uint32_t node, glm::dvec3 z, int depth, unsigned index) {
    if (!tree_.is_split(node)) return descend_flat(z, depth, index);
    if (depth == 0) return put(z, index, node);
    const uint32_t first = tree_.child[node];
    const double m = drawn_position(tree_, tree_.corner[first].apex).z;
    descend(first, {m, z[0], z[1]}, depth - 1, 2 * index);
    descend(first + 1, {m, z[2], z[0]}, depth - 1, 2 * index + 1);
  }

  void descend_flat(glm::dvec3 z, int depth, unsigned index) {
    if (depth == 0) return put(z, index, k_none);
    const double m = 0.5 * (z[1] + z[2]);
    descend_flat({m, z[0], z[1]}, depth - 1, 2 * index);
    descend_flat({m, z[2], z[0]}, depth - 1, 2 * index + 1);
  }

 private:
  void put(glm::dvec3 z, unsigned j, uint32_t split_node) {
    const float left = float(z[1] - z[0]), right = float(z[2] - z[0]);
    chunk_.apex[j].z = z[0];
    chunk_.apex_z[j] = float(z[0] - base_z_);
    chunk_.to_left[j].z = chunk_.left_z[j] = left;
    chunk_.to_right[j].z = chunk_.right_z[j] = right;
    rise_ = std::max(rise_, std::abs(left) + std::abs(right));
    if (chunk_.flat) return;
    chunk_.bound[j] = split_node == k_none ? 0.0f : tree_.corner[split_node].bound;
    first_ = chunk_.first_node[j] = uint32_t(chunk_.nodes.size());
    if (split_node != k_none) refine(split_node);
    chunk_.node_count[j] = uint32_t(chunk_.nodes.size()) - first_;
  }

  uint32_t refine(uint32_t node) {
    const auto index = uint32_t(chunk_.nodes.size());
    const uint32_t first = tree_.child[node];
    chunk_.nodes.push_back({drawn_position(tree_, tree_.corner[first].apex).z, {0, 0}});
    for (uint32_t turn = 0; turn < 2; ++turn) {
      if (!tree_.is_split(first + turn)) continue;
      const uint32_t below = refine(first + turn);
      chunk_.nodes[index].child[turn] = below - first_;
    }
    return index;
  }

  const RoamTree& tree_;
  Chunk& chunk_;
  double base_z_;
  float rise_ = 0;
  uint32_t first_ = 0;
};

// A lower bound of the legs of a level's triangles, metres.
double shortest_leg(const Lattice& lattice, int level) {
  const double cells = std::ldexp(1.0, lattice.root_bits) * std::exp2(-0.5 * level);
  return cells * std::min(lattice.spacing.x, lattice.spacing.y);
}

SplitMark mark_of(const RoamTree& tree, uint32_t node, int depth) {
  const uint32_t first = tree.child[node];
  return {drawn_position(tree, tree.corner[first].apex).z, depth == 0 ? tree.corner[node].bound : 0.0f,
          uint32_t(tree.is_split(first)) | uint32_t(tree.is_split(first + 1)) << 1};
}

// In the same order as same_marks().
void record_marks(const RoamTree& tree, uint32_t node, int depth, std::vector<SplitMark>& marks) {
  const SplitMark mark = mark_of(tree, node, depth);
  marks.push_back(mark);
  for (uint32_t turn = 0; turn < 2; ++turn)
    if (mark.children_split >> turn & 1) record_marks(tree, tree.child[node] + turn, depth - 1, marks);
}

bool same_marks(const RoamTree& tree, uint32_t node, int depth, const SplitMark*& mark) {
  const SplitMark now = mark_of(tree, node, depth);
  if (!(now == *mark++)) return false;
  for (uint32_t turn = 0; turn < 2; ++turn)
    if (now.children_split >> turn & 1 && !same_marks(tree, tree.child[node] + turn, depth - 1, mark)) return false;
  return true;
}

bool up_to_date(const RoamTree& tree, const ChunkVisit& visit, int depth, const Chunk& chunk, glm::dvec3 corner_z) {
  if (!chunk.has_drawn || chunk.flat != (visit.node == k_none) || chunk.corner_z != corner_z) return false;
  const SplitMark* mark = chunk.marks.data();
  return chunk.flat || same_marks(tree, visit.node, depth, mark);
}

}  // namespace

void build_static(const FixedLevelWalk& walk, const ChunkVisit& visit, int depth, Chunk& chunk) {
  const TriangleCorners corners = lattice_of(visit.triangle);
  chunk.solid = 0;
  chunk.box = box_of(corners);
  chunk.altitude.assign(walk.options().altitudes ? k_chunk_size : 0, glm::vec3(0));
  StaticBuilder(walk, chunk).descend(corners, visit.triangle.cover, depth, 0);
  chunk.has_static = true;
  chunk.has_drawn = false;  // heights stand beside what was just written
}

bool refresh_drawn(const RoamTree& tree, const ChunkVisit& visit, int depth, Chunk& chunk) {
  const DrawnTriangle& t = visit.triangle;
  const glm::dvec3 corner_z(t.apex.world.z, t.left.world.z, t.right.world.z);
  if (up_to_date(tree, visit, depth, chunk, corner_z)) return false;
  chunk.corner_z = corner_z;
  chunk.flat = visit.node == k_none;
  chunk.nodes.clear();
  chunk.marks.clear();
  DrawnBuilder builder(tree, chunk);
  if (chunk.flat) {
    builder.descend_flat(corner_z, depth, 0);
  } else {
    builder.descend(visit.node, corner_z, depth, 0);
    record_marks(tree, visit.node, depth, chunk.marks);
  }
  chunk.steepness = builder.rise() / float(shortest_leg(tree.lattice(), t.id.level() + depth));
  chunk.has_drawn = true;
  return true;
}

}  // namespace sward::roam
