// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the surface says anew: after edits, and when parts of a world were loaded or dropped.
#include <algorithm>

#include "roam_engine.h"

namespace sward::roam {

namespace {

LatticeBox box_of(const TriangleCorners& c) {
  return {glm::min(c.apex, glm::min(c.left, c.right)), glm::max(c.apex, glm::max(c.left, c.right))};
}

bool meet(const LatticeBox& a, const LatticeBox& b) {
  return a.first.x <= b.last.x && a.first.y <= b.last.y && a.last.x >= b.first.x && a.last.y >= b.first.y;
}

// A diamond's bound holds what lies below it, which reaches no farther beyond it than its own larger side. That of the
// relief at the data's level also depends on slopes two samples around.
bool may_depend(const TriangleCorners& c, const LatticeBox& box, int step) {
  const LatticeBox own = box_of(c);
  const int reach = std::max(own.last.x - own.first.x, own.last.y - own.first.y) + 3 * step;
  return meet({own.first - reach, own.last + reach}, box);
}

}  // namespace

void RoamEngine::read_surface_again() {
  for (const Change& change : changes_) {
    if (change.box.empty()) continue;
    for (uint32_t root = 0; root < tree_.root_count(); ++root) collapse_forbidden(root, change.box);
    if (!change.heights) {
      release_slowly();
      continue;
    }
    visits_.clear();
    for (uint32_t root = 0; root < tree_.root_count(); ++root) reread(root, change.box);
    // Only now all that a node may lead to is known.
    for (const Visit& visit : visits_) look_again(visit.node);
  }
  changes_.clear();
  forget_clearances();
  settled_ = false;
  ask_again_what_splits();
}

// What could not be split may be by now, and what could may not. Leaves in calendars are asked when they come due.
void RoamEngine::ask_again_what_splits() {
  if (options_.plain) return look_at_all();
  visits_.clear();
  for (uint32_t node = 0; (node = blocked_queue_.highest(state_)) != k_none; visits_.push_back({node, 0}))
    unplace(node);
  for (const uint32_t node : hot_leaves_) {
    const bool alive = node < tree_.size() && tree_.is_alive(node);
    if (alive && tree_.is_leaf(node) && state_[node].queued()) visits_.push_back({node, 0});
  }
  for (const Visit& visit : visits_) place(visit.node, read(visit.node));
}

void RoamEngine::collapse_forbidden(uint32_t node, const LatticeBox& box) {
  if (tree_.is_leaf(node) || !meet(box_of(tree_.corners(node)), box)) return;
  if (!tree_.surface().can_split(centre_of(tree_.corners(node)), tree_.nodes[node].id.level())) return collapse(node);
  for (uint32_t turn = 0; turn < 2 && tree_.is_split(node); ++turn) collapse_forbidden(tree_.child[node] + turn, box);
}

// Heights and bounds; the nodes that may have changed are put into visits_, parents first.
void RoamEngine::reread(uint32_t node, const LatticeBox& box) {
  if (!may_depend(tree_.corners(node), box, tree_.lattice().sample_step())) return;
  const Corners& c = tree_.corner[node];
  for (const uint32_t vertex : {c.apex, c.left, c.right}) {
    const LatticePoint p = tree_.vertices.lattice[vertex];
    if (!meet({p, p}, box) || tree_.surface().height(p) == tree_.vertices.points[vertex].world.z) continue;
    tree_.vertices.reread(tree_.surface(), vertex);
    take_vertex(vertex);
  }
  tree_.reread(node);
  take_node(node);
  visits_.push_back({node, 0});
  if (tree_.is_leaf(node)) return;
  reread(tree_.child[node], box);
  reread(tree_.child[node] + 1, box);
}

void RoamEngine::look_again(uint32_t node) {
  if (options_.plain) return look(node, inherited_flags(node));
  const uint32_t parent = tree_.nodes[node].parent;
  const bool below_out = parent != k_none && !is_visible(parent);
  if (below_out) return;
  if (!is_visible(node)) {
    look_at_out(node, read(node));
  } else if (acts_as_leaf(node)) {
    look_at_leaf(node, read(node));
  }
  if (tree_.is_split(node)) refresh_diamond(node);
}

// Merges the node's diamond after all that depends on it.
void RoamEngine::collapse(uint32_t node) {
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none) continue;
    for (uint32_t turn = 0; turn < 2; ++turn)
      if (const uint32_t child = tree_.child[half] + turn; tree_.is_split(child)) collapse(child);
  }
  merge_now(node);
  ++stats_.merges;
}

}  // namespace sward::roam
