// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The triangle bintree of Duchaineau et al., "ROAMing Terrain" (1997), sections 3 and 4: diamonds, forced splits,
// merges. Forced splits are gathered into a chain first, so that their cost is known before anything changes.
#include "roam_tree.h"

#include <algorithm>

namespace sward::roam {

namespace {

// Whether the triangle's interior meets x < limit.x, y < limit.y: the least value over the triangle of
// max(x - limit.x, y - limit.y), found at a corner or where an edge crosses the line on which both are equal.
bool reaches_into(const TriangleCorners& corners, LatticePoint limit) {
  const LatticePoint points[3] = {corners.apex, corners.left, corners.right};
  int64_t x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = int64_t(points[i].x) - limit.x;
    y[i] = int64_t(points[i].y) - limit.y;
    if (x[i] < 0 && y[i] < 0) return true;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int64_t a = x[i] - y[i], b = x[j] - y[j];
    if ((a < 0) == (b < 0) || a == b) continue;
    // At a / (a - b) of the way x = y; its sign is that of the numerator over a - b.
    const int64_t numerator = x[i] * (a - b) + a * (x[j] - x[i]);
    if ((numerator < 0) == (a - b > 0) && numerator != 0) return true;
  }
  return false;
}

}  // namespace

Cover cover_of(const Lattice& lattice, const TriangleCorners& corners, Cover parent) {
  if (parent != Cover::straddling) return parent;
  const LatticePoint limit = lattice.last();
  const auto within = [&](LatticePoint p) { return p.x <= limit.x && p.y <= limit.y; };
  if (within(corners.apex) && within(corners.left) && within(corners.right)) return Cover::inside;
  return reaches_into(corners, limit) ? Cover::straddling : Cover::padding;
}

uint32_t VertexPool::add(const Surface& surface, LatticePoint point) {
  uint32_t slot = uint32_t(points.size());
  if (free_.empty()) {
    lattice.emplace_back();
    points.emplace_back();
    gpu.emplace_back();
    alive.push_back(0);
    change_.push_back(0);
    changed.reserve(points.capacity());
    free_.reserve(points.capacity());
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  lattice[slot] = point;
  alive[slot] = 1;
  reread(surface, slot);
  return slot;
}

void VertexPool::free(uint32_t slot) {
  alive[slot] = 0;
  moving -= moves(slot);
  points[slot].motion = {};
  free_.push_back(slot);
}

void VertexPool::reread(const Surface& surface, uint32_t slot) {
  const LatticePoint point = lattice[slot];
  const bool rises = moves(slot) && points[slot].motion.to_z == points[slot].world.z;
  points[slot].world = glm::dvec3(surface.lattice().world_xy(point), surface.height(point));
  if (rises) points[slot].motion.to_z = points[slot].world.z;
  gpu[slot].relief_gradient = glm::vec2(surface.relief_gradient(point));
  write(slot);
}

void VertexPool::begin_changes() {
  changed.clear();
  all_changed = false;
  ++period_;
}

void VertexPool::begin_motion(uint32_t slot, double from_z, double to_z, float seconds) {
  moving += !moves(slot);
  points[slot].motion = {from_z, to_z, now, seconds};
  write(slot);
}

void VertexPool::rebase(glm::dvec3 new_origin) {
  origin = new_origin;
  time_origin = now;
  all_changed = true;
  for (uint32_t slot = 0; slot < points.size(); ++slot)
    if (alive[slot]) write(slot);
}

void VertexPool::clear() {
  lattice.clear();
  points.clear();
  moving = 0;
  gpu.clear();
  alive.clear();
  change_.clear();
  free_.clear();
  changed.clear();
  all_changed = true;
}

void VertexPool::write(uint32_t slot) {
  const Motion& m = points[slot].motion;
  const bool still = m.seconds <= 0;
  RoamVertex& vertex = gpu[slot];
  vertex.position =
      glm::vec3(glm::dvec3(glm::dvec2(points[slot].world), still ? points[slot].world.z : m.to_z) - origin);
  vertex.from_z = still ? vertex.position.z : float(m.from_z - origin.z);
  vertex.start_s = still ? 0.0f : float(m.start - time_origin);
  vertex.per_second = still ? 0.0f : 1.0f / m.seconds;
  mark_changed(slot);
}

void VertexPool::mark_changed(uint32_t slot) {
  if (change_[slot] == period_) return;
  change_[slot] = period_;
  changed.push_back(slot);
}

RoamTree::RoamTree(const Surface& surface) : surface_(&surface), lattice_(surface.lattice()) {
  add_roots();
}

void RoamTree::clear() {
  nodes.clear();
  corner.clear();
  neighbour.clear();
  child.clear();
  free_pairs_.clear();
  vertices.clear();
  add_roots();
}

void RoamTree::reread(uint32_t node) {
  if (nodes[node].cover != Cover::padding)
    corner[node].bound = surface_->bound(centre_of(corners(node)), nodes[node].id.level());
}

void RoamTree::add_roots() {
  const glm::ivec2 squares = lattice_.root_squares;
  for (int row = 0; row <= squares.y; ++row)
    for (int column = 0; column <= squares.x; ++column)
      vertices.add(*surface_, LatticePoint{column, row} * k_root_side);
  const auto slot = [&](int column, int row) { return uint32_t(row * (squares.x + 1) + column); };
  for (int row = 0; row < squares.y; ++row) {
    for (int column = 0; column < squares.x; ++column) {
      const uint32_t first = allocate_pair();
      const uint32_t nw = slot(column, row), ne = slot(column + 1, row);
      const uint32_t sw = slot(column, row + 1), se = slot(column + 1, row + 1);
      set_node(first, TriangleId::root(0, {column, row}), {nw, sw, ne, 0}, k_none, Cover::straddling);
      set_node(first + 1, TriangleId::root(1, {column, row}), {se, ne, sw, 0}, k_none, Cover::straddling);
    }
  }
  root_count_ = leaf_count_ = uint32_t(size());
  for (uint32_t square = 0; square < root_count_ / 2; ++square) link_roots(square);
}

// Root 0 touches the west and the north neighbour's root 1, root 1 the east and the south neighbour's root 0.
void RoamTree::link_roots(uint32_t square) {
  const glm::ivec2 squares = lattice_.root_squares;
  const int column = int(square) % squares.x, row = int(square) / squares.x;
  const auto root = [&](int c, int r, uint32_t which) {
    const bool exists = c >= 0 && r >= 0 && c < squares.x && r < squares.y;
    return exists ? uint32_t(2 * (r * squares.x + c)) + which : k_none;
  };
  const uint32_t first = 2 * square;
  neighbour[first] = {first + 1, root(column - 1, row, 1), root(column, row - 1, 1)};
  neighbour[first + 1] = {first, root(column + 1, row, 0), root(column, row + 1, 0)};
}

uint32_t RoamTree::allocate_pair() {
  if (!free_pairs_.empty()) {
    const uint32_t first = free_pairs_.back();
    free_pairs_.pop_back();
    return first;
  }
  const uint32_t first = uint32_t(size());
  nodes.resize(first + 2);
  corner.resize(first + 2);
  neighbour.resize(first + 2);
  child.resize(first + 2, k_dead);
  free_pairs_.reserve(nodes.capacity() / 2);
  return first;
}

void RoamTree::set_node(uint32_t node, TriangleId node_id, Corners slots, uint32_t parent_node, Cover parent_cover) {
  nodes[node].id = node_id;
  corner[node] = slots;
  neighbour[node] = {k_none, k_none, k_none};
  nodes[node].parent = parent_node;
  child[node] = k_none;
  const TriangleCorners points = corners(node);
  nodes[node].cover = cover_of(lattice_, points, parent_cover);
  corner[node].bound =
      nodes[node].cover == Cover::padding ? -1.0f : surface_->bound(centre_of(points), node_id.level());
}

TriangleCorners RoamTree::corners(uint32_t node) const {
  const Corners& c = corner[node];
  return {vertices.lattice[c.apex], vertices.lattice[c.left], vertices.lattice[c.right]};
}

Chain RoamTree::forced_chain(uint32_t leaf) const {
  Chain chain;
  for (uint32_t node = leaf;;) {
    chain.node[chain.length++] = node;
    const uint32_t base = neighbour[node].base;
    if (base == k_none || neighbour[base].base == node) return chain;
    node = base;
  }
}

void RoamTree::make_children(uint32_t node, uint32_t middle) {
  const uint32_t first = allocate_pair();
  const Corners c = corner[node];
  set_node(first, nodes[node].id.child(0), {middle, c.apex, c.left, 0}, node, nodes[node].cover);
  set_node(first + 1, nodes[node].id.child(1), {middle, c.right, c.apex, 0}, node, nodes[node].cover);
  child[node] = first;
  // A child's base is a leg of its parent; its legs at the middle are shared with its sibling and with the children
  // across the parent's base.
  const Neighbours n = neighbour[node];
  neighbour[first] = {n.left, first + 1, k_none};
  neighbour[first + 1] = {n.right, k_none, first};
  replace_neighbour(n.left, node, first);
  replace_neighbour(n.right, node, first + 1);
}

void RoamTree::replace_neighbour(uint32_t node, uint32_t old_node, uint32_t new_node) {
  if (node == k_none) return;
  Neighbours& n = neighbour[node];
  if (n.base == old_node) {
    n.base = new_node;
  } else if (n.left == old_node) {
    n.left = new_node;
  } else if (n.right == old_node) {
    n.right = new_node;
  }
}

void RoamTree::split_diamond(uint32_t node) {
  const uint32_t base = neighbour[node].base;
  const uint32_t middle = vertices.add(*surface_, centre_of(corners(node)));
  make_children(node, middle);
  leaf_count_ += 1;
  if (base == k_none) return;
  make_children(base, middle);
  leaf_count_ += 1;
  const uint32_t own = child[node], other = child[base];
  neighbour[own].right = other + 1;
  neighbour[own + 1].left = other;
  neighbour[other].right = own + 1;
  neighbour[other + 1].left = own;
}

bool RoamTree::mergeable(uint32_t node) const {
  const auto childless = [this](uint32_t n) { return is_split(n) && is_leaf(child[n]) && is_leaf(child[n] + 1); };
  return childless(node) && (neighbour[node].base == k_none || childless(neighbour[node].base));
}

void RoamTree::join_as_leaf(uint32_t node) {
  const uint32_t first = child[node];
  neighbour[node].left = neighbour[first].base;
  neighbour[node].right = neighbour[first + 1].base;
  replace_neighbour(neighbour[node].left, first, node);
  replace_neighbour(neighbour[node].right, first + 1, node);
  child[first] = child[first + 1] = k_dead;
  free_pairs_.push_back(first);
  child[node] = k_none;
}

void RoamTree::merge_diamond(uint32_t node) {
  const uint32_t base = neighbour[node].base;
  const uint32_t middle = centre_vertex(node);
  join_as_leaf(node);
  leaf_count_ -= 1;
  if (base != k_none) {
    join_as_leaf(base);
    leaf_count_ -= 1;
  }
  vertices.free(middle);
}

}  // namespace sward::roam
