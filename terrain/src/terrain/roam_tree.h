// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/surface.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "large_pages.h"
#include "roam_queue.h"

namespace sward::roam {

/// Where a triangle stands against the rectangle of data.
enum class Cover : uint8_t { inside, straddling, padding };

/// `parent` spares the test where it decides.
Cover cover_of(const Lattice& lattice, const TriangleCorners& corners, Cover parent);

/// The lattice point that a split of the triangle creates.
inline LatticePoint centre_of(const TriangleCorners& c) {
  return (c.left + c.right) / 2;
}
inline TriangleCorners child_corners(const TriangleCorners& c, int turn) {
  const LatticePoint m = centre_of(c);
  return turn == 0 ? TriangleCorners{m, c.apex, c.left} : TriangleCorners{m, c.right, c.apex};
}

/// Vertices in stable slots. Every vertex but those of the root squares' corners is the centre of one split diamond.
/// A vertex stands at its height on the surface, or moves between two heights for some time.
class VertexPool {
 public:
  uint32_t add(const Surface& surface, LatticePoint point);
  void free(uint32_t slot);
  /// Takes the height of the surface anew.
  void reread(const Surface& surface, uint32_t slot);
  /// Forgets what was written so far.
  void begin_changes();
  /// Moves the origins of positions and times and rewrites every living slot.
  void rebase(glm::dvec3 origin);
  void clear();

  /// From `from_z` to `to_z` within `seconds` (> 0) from now on.
  void begin_motion(uint32_t slot, double from_z, double to_z, float seconds);
  /// The motion is over; nothing is written, since its end is what is drawn.
  void end_motion(uint32_t slot) {
    moving -= moves(slot);
    points[slot].motion.seconds = 0;
  }
  bool moves(uint32_t slot) const { return points[slot].motion.seconds > 0; }
  double arrival(uint32_t slot) const { return points[slot].motion.start + double(points[slot].motion.seconds); }
  /// The height that is drawn now.
  double drawn_z(uint32_t slot) const {
    const Motion& m = points[slot].motion;
    if (m.seconds <= 0) return points[slot].world.z;
    const double t = std::clamp((now - m.start) / double(m.seconds), 0.0, 1.0);
    return m.from_z + t * (m.to_z - m.from_z);
  }
  /// How far that is from where the surface is, metres.
  float off_surface(uint32_t slot) const {
    return moves(slot) ? float(std::abs(drawn_z(slot) - points[slot].world.z)) : 0.0f;
  }
  /// The point that is drawn now.
  glm::dvec3 drawn(uint32_t slot) const { return {glm::dvec2(points[slot].world), drawn_z(slot)}; }

  struct Motion {
    double from_z = 0, to_z = 0, start = 0;
    float seconds = 0;  // 0: the vertex rests on the surface
  };
  /// One cache line.
  struct alignas(64) Point {
    glm::dvec3 world{0};  // on the surface
    Motion motion;
  };

  LargeVector<LatticePoint> lattice;
  LargeVector<Point> points;
  std::vector<RoamVertex> gpu;
  std::vector<uint8_t> alive;
  std::vector<uint32_t> changed;  // slots written since begin_changes()
  glm::dvec3 origin{0};
  double now = 0, time_origin = 0;  // seconds
  uint32_t moving = 0;              // vertices
  bool all_changed = false;

 private:
  void write(uint32_t slot);
  void mark_changed(uint32_t slot);

  std::vector<uint32_t> free_;
  std::vector<uint32_t> change_;  // the number of the change period in which a slot was written last
  uint32_t period_ = 1;
};

/// Vertex slots of a node, counter-clockwise seen from above, and its bound in metres, negative in the padding: what
/// culling reads of a node.
struct Corners {
  uint32_t apex, left, right;
  float bound;
};

/// Leaves across the base, the edge apex-left and the edge apex-right. A split node's base is the other half of its
/// diamond (k_none at the outer border); its other two are stale until it is merged.
struct Neighbours {
  uint32_t base, left, right;
};

/// The forced splits that one split needs, in the order found: from the leaf itself to the coarsest.
struct Chain {
  std::array<uint32_t, k_max_level + 1> node;
  int length = 0;

  std::span<const uint32_t> nodes() const { return {node.data(), size_t(length)}; }
};

/// What only splits and merges read of a node.
struct Node {
  TriangleId id;
  uint32_t parent = k_none;
  Cover cover = Cover::inside;
};

/// Topology of the bintree: nodes in pairs (siblings are i and i ^ 1). Node 2 s + r is root r of root square s. Knows
/// nothing of views.
class RoamTree {
 public:
  explicit RoamTree(const Surface& surface);
  /// Back to the root mesh. Slots of vertices begin anew.
  void clear();

  const Surface& surface() const { return *surface_; }
  const Lattice& lattice() const { return lattice_; }
  uint32_t root_count() const { return root_count_; }
  size_t size() const { return nodes.size(); }
  uint32_t leaf_count() const { return leaf_count_; }

  bool is_alive(uint32_t node) const { return child[node] != k_dead; }
  bool is_leaf(uint32_t node) const { return child[node] == k_none; }
  bool is_split(uint32_t node) const { return child[node] < k_dead; }
  /// Whether the surface lets the leaf be split.
  bool splittable(uint32_t leaf) const {
    return nodes[leaf].id.level() < lattice_.max_level &&
           surface_->can_split(centre_of(corners(leaf)), nodes[leaf].id.level());
  }
  /// Takes the bound of a node anew.
  void reread(uint32_t node);
  TriangleCorners corners(uint32_t node) const;

  /// Leaves that have to be split so that `leaf` can be; split_diamond() them from the last to the first.
  Chain forced_chain(uint32_t leaf) const;
  /// Splits a leaf and the leaf across its base, which has the same level or does not exist.
  void split_diamond(uint32_t node);
  /// True when the node is split and no child of its diamond is.
  bool mergeable(uint32_t node) const;
  /// Undoes split_diamond() for a mergeable node.
  void merge_diamond(uint32_t node);
  /// The vertex that the split of a node's diamond brought.
  uint32_t centre_vertex(uint32_t node) const { return corner[child[node]].apex; }
  /// The half of the node's diamond that stands for it: the lower index.
  uint32_t diamond_of(uint32_t node) const { return std::min(node, neighbour[node].base); }

  LargeVector<Node> nodes;
  LargeVector<Corners> corner;
  LargeVector<Neighbours> neighbour;
  LargeVector<uint32_t> child;  // first of the two; k_none: leaf; k_dead: unused
  VertexPool vertices;

 private:
  static constexpr uint32_t k_dead = 0xfffffffeu;

  uint32_t allocate_pair();
  void set_node(uint32_t node, TriangleId node_id, Corners slots, uint32_t parent_node, Cover parent_cover);
  void add_roots();
  void link_roots(uint32_t square);
  void make_children(uint32_t node, uint32_t middle);
  void replace_neighbour(uint32_t node, uint32_t old_node, uint32_t new_node);
  void join_as_leaf(uint32_t node);

  const Surface* surface_;
  Lattice lattice_;
  uint32_t root_count_ = 0;
  uint32_t leaf_count_ = 0;
  std::vector<uint32_t> free_pairs_;
};

}  // namespace sward::roam
