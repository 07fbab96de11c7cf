// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What is known about single nodes, and until when. A node is entered in a calendar by the tick up to which the finding
// surely holds; what does not hold for a tick is hot: queued by its priority and looked at in every update.
#include "roam_engine.h"

#include <algorithm>

namespace sward::roam {

namespace {

// A leaf that is about to leave the view may be drawn for so many ticks more, while the view moves.
constexpr float k_patience = 80;

}  // namespace

Assessment RoamEngine::assess(uint32_t node, CullFlags inherited) const {
  const Corners& c = tree_.corner[node];
  if (!view_ || inherited & k_out || c.bound < 0) return {};
  return projection_.assess(lanes(c.apex), lanes(c.left), lanes(c.right), c.bound, inherited);
}

CullFlags RoamEngine::inherited_flags(uint32_t node) const {
  const uint32_t parent = tree_.parent[node];
  return parent == k_none ? CullFlags(0) : state_[parent].cull;
}

void RoamEngine::take_vertex(uint32_t vertex) {
  seen_[vertex].world = tree_.vertices.world[vertex];
  seen_[vertex].view = 0;
}

void RoamEngine::grow_arrays() {
  const size_t nodes = tree_.size();
  if (state_.size() < nodes) {
    state_.resize(nodes);
    draws_.grow(nodes);
  }
  const size_t vertices = tree_.vertices.lattice.size();
  if (seen_.size() < vertices) seen_.resize(vertices);
}

void RoamEngine::show(uint32_t leaf) {
  if (draws_.contains(leaf)) return;
  const Corners& c = tree_.corner[leaf];
  draws_.add(leaf, c.apex, c.left, c.right);
}

// `ticks`, cut to the time after which a visible node may be out of sight. That it may go on for a while although it is
// out is noted for `entry`.
float RoamEngine::until_side_changes(uint32_t node, uint32_t entry, const Reading& reading, float ticks) {
  const float side_ticks = projection_.side_ticks(seen(node), reading, units_);
  if (side_ticks >= ticks) return ticks;
  if (side_ticks >= k_patience) return side_ticks;
  lingering_.push_back(entry);
  return std::min(ticks, k_patience);
}

// For a visible node that acts as a leaf.
void RoamEngine::place(uint32_t node, const Reading& reading) {
  NodeState& s = state_[node];
  s.priority = reading.priority;
  if (!options_.plain) {
    float ticks = projection_.below_ticks(seen(node), reading, leaf_guard_, units_);
    if (ticks > 0) ticks = until_side_changes(node, node, reading, ticks);
    if (const uint32_t tick = leaf_calendar_.tick_after(ticks); tick != 0) {
      unplace(node);
      s.due = tick;
      leaf_calendar_.enter(node, tick);
      return;
    }
    if (s.due != hot_mark_) hot_leaves_.push_back(node);
    s.due = hot_mark_;
  }
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
  s.due = 0;
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
  s.due = 0;
  s.priority = -1;
  s.cull = CullFlags((s.cull & k_falling) | k_out);
}

// The topmost node of what is out has to be looked at before it may come in; padding never does.
void RoamEngine::watch_out(uint32_t node, const Reading& reading) {
  NodeState& s = state_[node];
  s.due = 0;
  if (options_.plain || tree_.corner[node].bound < 0) return;
  if (const uint32_t tick = out_calendar_.tick_after(projection_.side_ticks(seen(node), reading, units_)); tick != 0) {
    s.due = tick;
    out_calendar_.enter(node, tick);
  } else {
    s.due = hot_mark_;
    hot_outs_.push_back(node);
  }
}

// A node whose sub-tree is out. If its parent's is, too, that takes its place.
void RoamEngine::go_out(uint32_t node, const Reading& reading) {
  mark_out(node);
  const uint32_t parent = tree_.parent[node];
  if (!options_.plain && parent != k_none && !is_visible(tree_.child[parent]) && !is_visible(tree_.child[parent] + 1)) {
    if (const Reading of_parent = read(parent); of_parent.out()) {
      state_[tree_.child[parent]].due = state_[tree_.child[parent] + 1].due = 0;
      go_out(parent, of_parent);
      refresh_diamond(parent);
      return;
    }
  }
  watch_out(node, reading);
}

// A node that was out and is so no more, with what of its sub-tree has come in, too.
void RoamEngine::come_in(uint32_t node, const Reading& reading) {
  NodeState& s = state_[node];
  s.cull = CullFlags(s.cull & k_falling);
  s.due = 0;
  s.priority = reading.priority;
  if (tree_.is_leaf(node)) {
    show(node);
    if (!in_falling(node)) place(node, reading);
    return;
  }
  for (uint32_t child = tree_.child[node]; child <= tree_.child[node] + 1; ++child) {
    const Reading of_child = read(child);
    ++stats_.looked_at;
    if (of_child.out()) {
      watch_out(child, of_child);
    } else {
      come_in(child, of_child);
    }
  }
  if (s.cull & k_falling) place(node, reading);
  refresh_diamond(node);
}

// For the diamond of any node: queued or entered anew if it can be merged.
void RoamEngine::refresh_diamond(uint32_t node) {
  if (node == k_none || !tree_.mergeable(node) || state_[node].cull & k_falling || centre_moves(node)) return;
  place_diamond(tree_.diamond_of(node));
}

void RoamEngine::place_diamond(uint32_t diamond) {
  NodeState& s = state_[diamond];
  float key = -1, ticks = 0;
  bool in_sight = false;
  for (const uint32_t half : {diamond, tree_.neighbour[diamond].base}) {
    if (half == k_none || !is_visible(half)) continue;
    in_sight = true;
    if (options_.plain) {
      key = std::max(key, state_[half].priority);
      continue;
    }
    const Reading reading = read(half);
    key = std::max(key, reading.priority);
    const float above_ticks = projection_.above_ticks(seen(half), reading, diamond_guard_, units_);
    // Without patience: out of sight it has no priority, which is not above the guard.
    if (above_ticks > 0)
      ticks = std::max(ticks, std::min(above_ticks, projection_.side_ticks(seen(half), reading, units_)));
  }
  s.diamond_due = 0;
  if (!options_.plain && in_sight) {
    if (const uint32_t tick = diamond_calendar_.tick_after(ticks); tick != 0) {
      if (s.half_queued) {
        merge_queue_.remove(state_, diamond);
        mark_halves(diamond, false);
      }
      s.diamond_due = tick;
      diamond_calendar_.enter(diamond, tick);
      return;
    }
    s.diamond_due = hot_mark_;
    hot_diamonds_.push_back(diamond);
  }
  if (s.half_queued) return merge_queue_.change_key(state_, diamond, key);
  merge_queue_.insert(state_, diamond, key);
  mark_halves(diamond, true);
}

void RoamEngine::mark_halves(uint32_t node, bool queued) {
  state_[node].half_queued = queued;
  if (const uint32_t base = tree_.neighbour[node].base; base != k_none) state_[base].half_queued = queued;
}

void RoamEngine::forget_diamond(uint32_t node) {
  if (node == k_none) return;
  const uint32_t diamond = tree_.diamond_of(node);
  state_[diamond].diamond_due = 0;
  if (!state_[diamond].half_queued) return;
  merge_queue_.remove(state_, diamond);
  mark_halves(diamond, false);
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
