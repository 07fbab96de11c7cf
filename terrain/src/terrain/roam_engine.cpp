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

RoamEngine::RoamEngine(const Bounds& bounds, const RoamOptions& options) : tree_(bounds), options_(options) {
  tree_.vertices.rebase(tree_.field().desc().origin);
  grow_arrays();
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
  if (cull_.size() < nodes) {
    cull_.resize(nodes, k_out);
    priority_.resize(nodes, -1.0f);
    draw_slot_.resize(nodes, k_none);
    links_.resize(nodes);
  }
  const size_t vertices = tree_.vertices.lattice.size();
  if (lanes_.size() < vertices) {
    lanes_.resize(vertices);
    lanes_view_.resize(vertices, 0);
  }
}

void RoamEngine::follow_eye(glm::dvec3 eye) {
  const bool first = !view_.has_value();
  if (first || glm::distance(eye, tree_.vertices.origin) > k_rebase_distance) tree_.vertices.rebase(glm::round(eye));
}

const Lanes& RoamEngine::lanes(uint32_t vertex) const {
  if (lanes_view_[vertex] != view_number_) {
    lanes_[vertex] = projection_.project(tree_.vertices.world[vertex]);
    lanes_view_[vertex] = view_number_;
  }
  return lanes_[vertex];
}

Assessment RoamEngine::assess(uint32_t node) const {
  const uint32_t parent = tree_.parent[node];
  const CullFlags inherited = parent == k_none ? CullFlags(0) : cull_[parent];
  if (!view_ || inherited & k_out || tree_.cover[node] == Cover::padding) return {};
  const Corners& c = tree_.corner[node];
  return projection_.assess(lanes(c.apex), lanes(c.left), lanes(c.right), tree_.bound[node], inherited);
}

// Takes the current view's flags and priority over for a node.
void RoamEngine::adopt(uint32_t node) {
  const Assessment now = assess(node);
  cull_[node] = now.cull;
  priority_[node] = now.priority;
}

// From the roots down. What lies below a node that was out and still is has not changed and is not visited.
void RoamEngine::reassess_all() {
  std::vector<uint32_t> stack;
  for (uint32_t root = tree_.root_count(); root-- > 0;) stack.push_back(root);
  while (!stack.empty()) {
    const uint32_t node = stack.back();
    stack.pop_back();
    const bool was_out = cull_[node] & k_out;
    reassess(node);
    if ((was_out && (cull_[node] & k_out)) || tree_.is_leaf(node)) continue;
    stack.push_back(tree_.child[node] + 1);
    stack.push_back(tree_.child[node]);
  }
}

void RoamEngine::reassess(uint32_t node) {
  adopt(node);
  if (tree_.is_leaf(node)) {
    refresh_leaf(node);
  } else if (const uint32_t diamond = tree_.diamond_of(node); links_.queued(diamond)) {
    // The other half may still have the last view's priority; its own visit then sets the key again.
    merge_queue_.change_key(links_, diamond, diamond_key(diamond));
  }
}

void RoamEngine::refresh_leaf(uint32_t node) {
  if (cull_[node] & k_out) {
    forget_leaf(node);
  } else if (links_.queued(node)) {
    split_queue_.change_key(links_, node, priority_[node]);
  } else {
    split_queue_.insert(links_, node, priority_[node]);
    draw(node);
  }
}

void RoamEngine::forget_leaf(uint32_t node) {
  if (!links_.queued(node)) return;
  split_queue_.remove(links_, node);
  undraw(node);
}

float RoamEngine::diamond_key(uint32_t node) const {
  const uint32_t base = tree_.neighbour[node].base;
  return base == k_none ? priority_[node] : std::max(priority_[node], priority_[base]);
}

// Queues the diamond of a node that has just become a candidate for merging, if it is one.
void RoamEngine::refresh_diamond(uint32_t node) {
  if (node == k_none || !tree_.mergeable(node)) return;
  const uint32_t diamond = tree_.diamond_of(node);
  if (!links_.queued(diamond)) merge_queue_.insert(links_, diamond, diamond_key(diamond));
}

void RoamEngine::forget_diamond(uint32_t node) {
  if (node == k_none) return;
  const uint32_t diamond = tree_.diamond_of(node);
  if (links_.queued(diamond)) merge_queue_.remove(links_, diamond);
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
  lanes_view_[tree_.corner[tree_.child[node]].apex] = 0;
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    for (uint32_t turn = 0; turn < 2; ++turn) {
      const uint32_t child = tree_.child[half] + turn;
      adopt(child);
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
  const uint32_t worst = split_queue_.highest(links_);
  return worst == k_none ? 0.0f : links_.key[worst];
}

}  // namespace sward::roam
