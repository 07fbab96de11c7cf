// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What is known about single nodes, and until when. A node is entered in a calendar by the tick up to which the finding
// surely holds; what does not hold for a tick is hot: queued by its priority and looked at in every update.
#include "roam_engine.h"

#include <algorithm>

namespace sward::roam {

Assessment RoamEngine::assess(uint32_t node, CullFlags inherited) const {
  const Corners& c = tree_.corner[node];
  if (!view_ || inherited & k_out || c.bound < 0) return {};
  Assessment found = projection_.assess(forms(c.apex), forms(c.left), forms(c.right), c.bound, inherited);
  if (!claims_.empty() && !(found.cull & k_out) && wedgie_[node].claimed) found.priority = RoamMesh::k_artificial_max;
  return found;
}

CullFlags RoamEngine::inherited_flags(uint32_t node) const {
  const uint32_t parent = tree_.nodes[node].parent;
  return parent == k_none ? CullFlags(0) : state_[parent].cull;
}

void RoamEngine::take_vertex(uint32_t vertex) {
  seen_[vertex].world = tree_.vertices.points[vertex].world;
  seen_[vertex].view = 0;
}

void RoamEngine::take_node(uint32_t node) {
  const Corners& c = tree_.corner[node];
  const VertexPool& v = tree_.vertices;
  wedgie_[node].place(v.points[c.apex].world, v.points[c.left].world, v.points[c.right].world, c.bound);
}

// All that a tree of roots has.
void RoamEngine::take_roots() {
  grow_arrays();
  for (uint32_t vertex = 0; vertex < tree_.vertices.points.size(); ++vertex) take_vertex(vertex);
  for (uint32_t root = 0; root < tree_.root_count(); ++root) take_node(root);
}

void RoamEngine::grow_arrays() {
  const size_t nodes = tree_.size();
  if (state_.size() < nodes) {
    state_.resize(nodes);
    wedgie_.resize(nodes);
    lingering_.reserve(wedgie_.capacity());
    lingered_.reserve(2 * wedgie_.capacity());
    draws_.grow(nodes);
  }
  const size_t vertices = tree_.vertices.points.size();
  if (seen_.size() < vertices) seen_.resize(vertices);
}

void RoamEngine::show(uint32_t leaf) {
  if (draws_.contains(leaf)) return;
  const Corners& c = tree_.corner[leaf];
  draws_.add(leaf, c.apex, c.left, c.right);
}

// A new list, in which nothing is noted yet.
void RoamEngine::begin_lingering() {
  lingering_.clear();
  lingering_list_ = (lingering_list_ + 1) & 0x7fffffffu;  // as many bits as nodes have for it
  lingering_ticks_ = 0;
}

void RoamEngine::note_lingering(uint32_t node) {
  if (wedgie_[node].lingers == lingering_list_) return;
  wedgie_[node].lingers = lingering_list_ & 0x7fffffffu;
  lingering_.push_back(node);
}

// `ticks`, cut to the time at which a visible node is going to be out of sight if the view goes on moving as it does.
// It may be out before that: such nodes are noted. They cost some of the budget and nothing else.
float RoamEngine::until_side_changes(uint32_t node, const Reading& reading, float ticks) {
  if (reading.side >= ticks) return ticks;
  const float leaves = std::clamp(reading.leaves, k_least_patience, k_most_patience);
  if (reading.side >= leaves) return reading.side;
  note_lingering(node);
  return std::min(ticks, leaves);
}

// For a visible node that acts as a leaf.
void RoamEngine::place(uint32_t node, const Reading& reading) {
  if (!options_.plain) {
    Wedgie& w = wedgie_[node];
    float ticks = reading.below;
    if (ticks > 0) ticks = until_side_changes(node, reading, ticks);
    if (const uint32_t tick = leaf_calendar_.tick_after(ticks); tick != 0) {
      // What is in the calendar is not queued.
      if (w.due < Calendar::k_first_tick) unplace(node);
      w.due = tick;
      leaf_calendar_.enter(node, tick);
      return;
    }
    if (w.due != hot_mark_) hot_leaves_.push_back(node);
    w.due = hot_mark_;
  }
  NodeState& s = state_[node];
  s.priority = reading.priority;
  const bool blocked = reading.bound > 0 && tree_.is_leaf(node) && !tree_.splittable(node);
  BucketQueue& queue = blocked ? blocked_queue_ : split_queue_;
  if (s.queued() && s.blocked == blocked) return queue.change_key(state_, node, reading.priority);
  if (s.queued()) (s.blocked ? blocked_queue_ : split_queue_).remove(state_, node);
  s.blocked = blocked;
  queue.insert(state_, node, reading.priority);
}

// Out of the queue and the calendar. Not for nodes that are out.
void RoamEngine::unplace(uint32_t node) {
  NodeState& s = state_[node];
  if (s.queued()) (s.blocked ? blocked_queue_ : split_queue_).remove(state_, node);
  s.blocked = false;
  if (!options_.plain) wedgie_[node].due = 0;
}

// The node itself, not its sub-tree.
void RoamEngine::mark_out(uint32_t node) {
  NodeState& s = state_[node];
  if (tree_.is_leaf(node)) {
    if (draws_.contains(node)) draws_.remove(node);
    unplace(node);
  } else if (s.cull & k_falling) {
    unplace(node);
  }
  if (!options_.plain) wedgie_[node].due = 0;
  s.priority = -1;
  s.cull = CullFlags((s.cull & k_falling) | k_out);
}

// The topmost node of what is out has to be looked at before it may come in; padding never does.
void RoamEngine::watch_out(uint32_t node, const Reading& reading) {
  Wedgie& w = wedgie_[node];
  w.due = 0;
  if (w.bound < 0) return;
  if (const uint32_t tick = out_calendar_.tick_after(reading.side); tick != 0) {
    w.due = tick | k_watch;
    out_calendar_.enter(node, tick);
  } else {
    w.due = hot_mark_ | k_watch;
    hot_outs_.push_back(node);
  }
}

// A node whose sub-tree is out. If its parent's is, too, that takes its place.
void RoamEngine::go_out(uint32_t node, const Reading& reading) {
  mark_out(node);
  const uint32_t parent = tree_.nodes[node].parent;
  if (!options_.plain && parent != k_none && !is_visible(tree_.child[parent]) && !is_visible(tree_.child[parent] + 1)) {
    if (const Reading of_parent = read(parent); of_parent.out()) {
      wedgie_[tree_.child[parent]].due = wedgie_[tree_.child[parent] + 1].due = 0;
      go_out(parent, of_parent);
      refresh_diamond(parent);
      return;
    }
  }
  watch_out(node, reading);
}

// A node that was out and is so no more, with what of its sub-tree has come in, too.
void RoamEngine::come_in(uint32_t node) {
  NodeState& s = state_[node];
  s.cull = CullFlags(s.cull & k_falling);
  wedgie_[node].due = 0;
  if (tree_.is_leaf(node)) {
    show(node);
    if (!in_falling(node)) place(node, read(node));
    return;
  }
  const uint32_t children[2] = {tree_.child[node], tree_.child[node] + 1};
  Reading readings[2];
  read(children, Projection::k_outside, readings);
  for (int turn = 0; turn < 2; ++turn) look_at_out(children[turn], readings[turn]);
  if (s.cull & k_falling) place(node, read(node));
  refresh_diamond(node);
}

// For the diamond of any node: queued or entered anew if it can be merged.
void RoamEngine::refresh_diamond(uint32_t node) {
  if (node == k_none || !tree_.mergeable(node) || state_[node].cull & k_falling || centre_moves(node)) return;
  place_diamond(tree_.diamond_of(node));
}

void RoamEngine::place_diamond(uint32_t diamond) {
  if (const std::optional<float> key = options_.plain ? plain_key(diamond) : defer_diamond(diamond))
    queue_diamond(diamond, *key);
}

void RoamEngine::queue_diamond(uint32_t diamond, float key) {
  if (state_[diamond].half_queued) return merge_queue_.change_key(state_, diamond, key);
  merge_queue_.insert(state_, diamond, key);
  mark_halves(diamond, true);
}

float RoamEngine::plain_key(uint32_t diamond) const {
  float key = -1;
  for (const uint32_t half : {diamond, tree_.neighbour[diamond].base})
    if (half != k_none && is_visible(half)) key = std::max(key, state_[half].priority);
  return key;
}

RoamEngine::Halves RoamEngine::halves_in_sight(uint32_t diamond) const {
  Halves halves;
  for (const uint32_t half : {diamond, tree_.neighbour[diamond].base})
    if (half != k_none && is_visible(half)) halves.node[halves.count++] = half;
  return halves;
}

std::optional<float> RoamEngine::defer_diamond(uint32_t diamond) {
  const Halves halves = halves_in_sight(diamond);
  Reading readings[2];
  if (halves.count > 0) read({halves.node.data(), halves.count}, Projection::k_above, readings);
  return defer_diamond(diamond, {readings, halves.count});
}

// Enters a diamond that is above the guard in the calendar; otherwise returns its priority. That a half may leave the
// view needs no looks: when its leaves have gone out, so does it.
std::optional<float> RoamEngine::defer_diamond(uint32_t diamond, std::span<const Reading> halves) {
  Wedgie& w = wedgie_[diamond];
  w.diamond_due = 0;
  float key = -1, ticks = 0;
  for (const Reading& half : halves) {
    key = std::max(key, half.priority);
    ticks = std::max(ticks, half.above);
  }
  if (halves.empty()) return key;
  if (const uint32_t tick = diamond_calendar_.tick_after(ticks); tick != 0) {
    unqueue_diamond(diamond);
    w.diamond_due = tick;
    diamond_calendar_.enter(diamond, tick);
    return {};
  }
  w.diamond_due = hot_mark_;
  hot_diamonds_.push_back(diamond);
  return key;
}

void RoamEngine::unqueue_diamond(uint32_t diamond) {
  if (!state_[diamond].half_queued) return;
  merge_queue_.remove(state_, diamond);
  mark_halves(diamond, false);
}

void RoamEngine::mark_halves(uint32_t node, bool queued) {
  state_[node].half_queued = queued;
  if (const uint32_t base = tree_.neighbour[node].base; base != k_none) state_[base].half_queued = queued;
}

void RoamEngine::forget_diamond(uint32_t node) {
  if (node == k_none) return;
  const uint32_t diamond = tree_.diamond_of(node);
  if (!options_.plain) wedgie_[diamond].diamond_due = 0;
  unqueue_diamond(diamond);
}

int RoamEngine::merge_gain(uint32_t node) const {
  int gain = 0;
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none) continue;
    const uint32_t child = tree_.child[half];
    gain += int(is_visible(child)) + int(is_visible(child + 1)) - int(is_visible(half));
  }
  return gain;
}

}  // namespace sward::roam
