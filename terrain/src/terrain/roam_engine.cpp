// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// State of the mesh and the operations that keep it consistent; roam_refine.cpp decides which operations are made.
#include "roam_engine.h"

#include <cmath>
#include <string>

namespace sward::roam {

namespace {

// The eye may go this far from the origin of the GPU's floats, metres.
constexpr double k_rebase_distance = 1000.0;

}  // namespace

Expected<void> check_options(const RoamOptions& options, uint32_t drawable_roots) {
  if (options.max_triangles < drawable_roots) {
    return fail("a budget of " + std::to_string(options.max_triangles) + " triangles is below the root mesh of " +
                std::to_string(drawable_roots) + "; raise max_triangles to at least that");
  }
  if (!(options.target_px >= 0)) return fail("target_px must be 0 or a positive number of pixels");
  if (!(options.hysteresis >= 0) || !std::isfinite(options.hysteresis))
    return fail("hysteresis must be 0 or a positive number");
  if (!(options.time_cap_s >= 0)) return fail("time_cap_s must be 0 or a positive number of seconds");
  return {};
}

RoamEngine::RoamEngine(const Surface& surface, const RoamOptions& options) : tree_(surface), options_(options) {
  tree_.vertices.rebase(tree_.lattice().origin);
  grow_arrays();
  for (uint32_t vertex = 0; vertex < tree_.vertices.world.size(); ++vertex) take_vertex(vertex);
}

void RoamEngine::take_vertex(uint32_t vertex) {
  seen_[vertex].world = tree_.vertices.world[vertex];
  seen_[vertex].view = 0;
}

Expected<void> RoamEngine::set_options(const RoamOptions& options) {
  uint32_t drawable = 0;
  for (uint32_t root = 0; root < tree_.root_count(); ++root) drawable += tree_.cover[root] != Cover::padding;
  if (auto checked = check_options(options, drawable); !checked) return checked;
  options_ = options;
  settled_ = false;
  return {};
}

void RoamEngine::grow_arrays() {
  const size_t nodes = tree_.size();
  if (state_.size() < nodes) {
    state_.resize(nodes);
    draw_slot_.resize(nodes, k_none);
  }
  const size_t vertices = tree_.vertices.lattice.size();
  if (seen_.size() < vertices) seen_.resize(vertices);
}

void RoamEngine::follow_eye(glm::dvec3 eye) {
  const bool first = !view_.has_value();
  if (first || glm::distance(eye, tree_.vertices.origin) > k_rebase_distance) tree_.vertices.rebase(glm::round(eye));
}

Assessment RoamEngine::assess(uint32_t node, CullFlags inherited) const {
  const Corners& c = tree_.corner[node];
  if (!view_ || inherited & k_out || c.bound < 0) return {};
  return projection_.assess(lanes(c.apex), lanes(c.left), lanes(c.right), c.bound, inherited);
}

CullFlags RoamEngine::inherited_flags(uint32_t node) const {
  const uint32_t parent = tree_.parent[node];
  return parent == k_none ? CullFlags(0) : state_[parent].cull;
}

// Takes the current view's flags and priority over for a node.
void RoamEngine::adopt(uint32_t node, CullFlags inherited) {
  const Assessment now = assess(node, inherited);
  state_[node].cull = now.cull;
  state_[node].priority = now.priority;
}

// From the roots down, level by level, so that memory can be fetched ahead. What lies below a node that was out and
// still is has not changed and is not visited.
void RoamEngine::reassess_all() {
  visits_.clear();
  for (uint32_t root = 0; root < tree_.root_count(); ++root) visits_.push_back({root, 0});
  for (size_t i = 0; i < visits_.size(); ++i) {
    prefetch_nodes(i);
    const Visit visit = visits_[i];
    const bool was_out = state_[visit.node].cull & k_out;
    reassess(visit.node, visit.inherited);
    const CullFlags cull = state_[visit.node].cull;
    if ((was_out && (cull & k_out)) || tree_.is_leaf(visit.node)) continue;
    visits_.push_back({tree_.child[visit.node], cull});
    visits_.push_back({tree_.child[visit.node] + 1, cull});
  }
}

void RoamEngine::prefetch_nodes(size_t place) const {
  constexpr size_t k_nodes_ahead = 24, k_vertices_ahead = 12;
  if (place + k_nodes_ahead < visits_.size()) {
    const uint32_t node = visits_[place + k_nodes_ahead].node;
    __builtin_prefetch(&tree_.corner[node]);
    __builtin_prefetch(&tree_.child[node]);
    __builtin_prefetch(&state_[node]);
  }
  if (place + k_vertices_ahead < visits_.size()) {
    const Corners& c = tree_.corner[visits_[place + k_vertices_ahead].node];
    for (const uint32_t vertex : {c.apex, c.left, c.right}) __builtin_prefetch(&seen_[vertex]);
  }
}

void RoamEngine::reassess(uint32_t node, CullFlags inherited) {
  adopt(node, inherited);
  if (tree_.is_leaf(node)) {
    refresh_leaf(node);
  } else if (state_[node].half_queued) {
    // The other half may still have the last view's priority; its own visit then sets the key again.
    const uint32_t diamond = tree_.diamond_of(node);
    merge_queue_.change_key(state_, diamond, diamond_key(diamond));
  }
}

void RoamEngine::refresh_leaf(uint32_t node) {
  if (state_[node].cull & k_out) {
    forget_leaf(node);
  } else if (state_[node].queued()) {
    split_queue_.change_key(state_, node, state_[node].priority);
  } else {
    split_queue_.insert(state_, node, state_[node].priority);
    draw(node);
  }
}

void RoamEngine::forget_leaf(uint32_t node) {
  if (!state_[node].queued()) return;
  split_queue_.remove(state_, node);
  undraw(node);
}

float RoamEngine::diamond_key(uint32_t node) const {
  const uint32_t base = tree_.neighbour[node].base;
  return base == k_none ? state_[node].priority : std::max(state_[node].priority, state_[base].priority);
}

// Queues the diamond of a node that has just become a candidate for merging, if it is one.
void RoamEngine::refresh_diamond(uint32_t node) {
  if (node == k_none || !tree_.mergeable(node)) return;
  const uint32_t diamond = tree_.diamond_of(node);
  if (state_[diamond].queued()) return;
  merge_queue_.insert(state_, diamond, diamond_key(diamond));
  mark_halves(diamond, true);
}

void RoamEngine::mark_halves(uint32_t node, bool queued) {
  state_[node].half_queued = queued;
  if (const uint32_t base = tree_.neighbour[node].base; base != k_none) state_[base].half_queued = queued;
}

void RoamEngine::forget_diamond(uint32_t node) {
  if (node == k_none) return;
  const uint32_t diamond = tree_.diamond_of(node);
  if (!state_[diamond].queued()) return;
  merge_queue_.remove(state_, diamond);
  mark_halves(diamond, false);
}

void RoamEngine::draw(uint32_t node) {
  draw_slot_[node] = uint32_t(drawn_.size());
  drawn_.push_back(node);
  const Corners& c = tree_.corner[node];
  indices_.insert(indices_.end(), {c.apex, c.left, c.right});
}

// The last drawn leaf takes the free place.
void RoamEngine::undraw(uint32_t node) {
  const uint32_t slot = draw_slot_[node], last = drawn_.back();
  drawn_[slot] = last;
  draw_slot_[last] = slot;
  std::copy_n(indices_.end() - 3, 3, indices_.begin() + 3 * std::ptrdiff_t(slot));
  drawn_.pop_back();
  indices_.resize(indices_.size() - 3);
  draw_slot_[node] = k_none;
}

uint32_t RoamEngine::split(uint32_t leaf) {
  settled_ = false;
  const Chain chain = tree_.forced_chain(leaf);
  for (int i = chain.length; i-- > 0;) split_one(chain.node[i]);
  return uint32_t(chain.length);
}

void RoamEngine::split_one(uint32_t node) {
  const uint32_t halves[2] = {node, tree_.neighbour[node].base};
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    forget_leaf(half);
    if (tree_.parent[half] != k_none) forget_diamond(tree_.parent[half]);
  }
  tree_.split_diamond(node);
  grow_arrays();
  take_vertex(tree_.corner[tree_.child[node]].apex);
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    for (uint32_t turn = 0; turn < 2; ++turn) {
      const uint32_t child = tree_.child[half] + turn;
      adopt(child, state_[half].cull);
      refresh_leaf(child);
    }
  }
  refresh_diamond(node);
}

void RoamEngine::merge(uint32_t node) {
  settled_ = false;
  const uint32_t halves[2] = {node, tree_.neighbour[node].base};
  forget_diamond(node);
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    forget_leaf(tree_.child[half]);
    forget_leaf(tree_.child[half] + 1);
  }
  tree_.merge_diamond(node);
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    refresh_leaf(half);
    refresh_diamond(tree_.parent[half]);
  }
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

float RoamEngine::bound_px() const {
  const uint32_t worst = split_queue_.highest(state_);
  return worst == k_none ? 0.0f : state_[worst].key;
}

}  // namespace sward::roam
