// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The greedy loop of Duchaineau et al. (1997), section 5, with three departures:
// - The budget counts visible leaves, and the exact change by a whole chain of forced splits is known before it is
// made.
// - Diamonds out of sight are merged when nothing else can be improved: a top-down mesh would not have them, and they
//   keep coarser diamonds from merging.
// - An exchange needs a gain of more than the hysteresis.
//
// Why it ends: within one update priorities are fixed and no child's is above its parent's, so the largest priority of
// a leaf never rises, and a diamond is merged only when its own is below that. What has been split in the loop, at the
// largest priority of that moment or as its support, is therefore not merged again, and there are finitely many
// diamonds to merge. Where the data gives no such order (beyond the border, where bounds count nothing), a limit on
// the number of operations ends the loop.
#include <cmath>

#include "roam_engine.h"

namespace sward::roam {

namespace {

// Leaves, above twice the budget and the roots, that narrow views may need for the sides of their deepest triangles.
constexpr uint32_t k_spare_leaves = 4096;
constexpr uint32_t k_operations_between_clock_reads = 16;

bool same(const View& a, const View& b) {
  return a.eye == b.eye && a.eye_from_world == b.eye_from_world && a.clip_from_eye == b.clip_from_eye &&
         a.viewport == b.viewport;
}

}  // namespace

uint32_t leaf_limit(const RoamOptions& options, uint32_t roots) {
  const uint64_t limit = 2 * uint64_t(options.max_triangles) + roots + k_spare_leaves;
  return uint32_t(std::min<uint64_t>(limit, uint32_t(1) << 30));
}

Expected<RoamStats> RoamEngine::update(const View& view) {
  if (auto valid = view.validate(); !valid) return tl::unexpected<Error>(valid.error());
  if (options_.time_cap_s > 0) {
    deadline_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                       std::chrono::duration<double>(options_.time_cap_s));
  }
  tree_.vertices.begin_changes();
  stats_ = {};
  if (!view_ || !same(*view_, view)) {
    follow_eye(view.eye);
    view_ = view;
    projection_ = Projection(view);
    ++view_number_;
    settled_ = false;
    reassess_all();
  }
  if (!settled_) {
    operations_ = 0;
    operation_limit_ = 4 * (uint64_t(tree_.leaf_count()) + options_.max_triangles) + 1024;
    time_checks_ = 0;
    settled_ = converge();
    stats_.capped = !settled_;
  }
  stats_.visible = visible_count();
  stats_.leaves = tree_.leaf_count();
  return stats_;
}

// False when the time cap ended it; the clock is first read after some operations, so that every update makes progress.
bool RoamEngine::converge() {
  shrink_to_budget();
  while (operations_ < operation_limit_) {
    if (out_of_time()) return false;
    const uint32_t worst = split_queue_.highest(state_);
    if (worst == k_none || state_[worst].key <= options_.target_px) {
      trim_below_target();
      return true;
    }
    if (fits(tree_.forced_chain(worst))) {
      const uint32_t split_count = split(worst);
      stats_.splits += split_count;
      operations_ += split_count;
    } else if (!make_room(worst)) {
      return true;
    }
  }
  return true;
}

bool RoamEngine::fits(const Chain& chain) const {
  const int64_t most = 2 * int64_t(chain.length);
  if (tree_.leaf_count() + most > leaf_limit(options_, tree_.root_count())) return false;
  const int64_t room = int64_t(options_.max_triangles) - visible_count();
  return most <= room || split_cost(chain) <= room;
}

// One merge towards splitting `node`; false when none is worth it.
bool RoamEngine::make_room(uint32_t node) {
  const uint32_t hidden = merge_queue_.unprioritised();
  uint32_t victim = hidden;
  const bool crowded = tree_.leaf_count() + 2 * (k_max_level + 1) > leaf_limit(options_, tree_.root_count());
  if (!crowded || hidden == k_none) {
    const uint32_t lowest = merge_queue_.lowest(state_);
    const bool pays = lowest != k_none && state_[lowest].key * (1 + options_.hysteresis) < state_[node].key;
    if (pays) victim = lowest;
  }
  if (victim == k_none) return false;
  count_merge(victim);
  shrink_to_budget();
  return true;
}

// A merge may bring more into sight than it removes, so this runs after every merge, too.
void RoamEngine::shrink_to_budget() {
  while (visible_count() > options_.max_triangles) {
    uint32_t victim = merge_queue_.lowest(state_);
    if (victim == k_none) victim = merge_queue_.unprioritised();
    if (victim == k_none) return;  // the root mesh, which no budget is below
    count_merge(victim);
  }
  while (tree_.leaf_count() > leaf_limit(options_, tree_.root_count())) {
    const uint32_t victim = merge_queue_.unprioritised();
    if (victim == k_none || int64_t(visible_count()) - merge_gain(victim) > int64_t(options_.max_triangles)) return;
    count_merge(victim);
  }
}

void RoamEngine::count_merge(uint32_t node) {
  merge(node);
  ++stats_.merges;
  ++operations_;
}

// With a target in pixels, what is finer than it by more than the hysteresis is given up.
void RoamEngine::trim_below_target() {
  if (options_.target_px <= 0) return;
  while (!out_of_time()) {
    uint32_t victim = merge_queue_.unprioritised();
    if (victim == k_none) {
      victim = merge_queue_.lowest(state_);
      if (victim == k_none || state_[victim].key * (1 + options_.hysteresis) >= options_.target_px) return;
    }
    if (int64_t(visible_count()) - merge_gain(victim) > int64_t(options_.max_triangles)) return;
    count_merge(victim);
  }
}

bool RoamEngine::out_of_time() {
  if (options_.time_cap_s <= 0 || ++time_checks_ % k_operations_between_clock_reads != 0) return false;
  return std::chrono::steady_clock::now() >= deadline_;
}

// A triangle that may not exist yet.
struct RoamEngine::Ghost {
  TriangleCorners corners;
  Lanes apex, left, right;
  int level = 0;
  Cover cover = Cover::inside;
  CullFlags cull = k_out;
};

RoamEngine::Ghost RoamEngine::ghost(uint32_t node) const {
  const Corners& c = tree_.corner[node];
  return {tree_.corners(node),    lanes(c.apex),     lanes(c.left),    lanes(c.right),
          tree_.id[node].level(), tree_.cover[node], state_[node].cull};
}

RoamEngine::Ghost RoamEngine::ghost_child(const Ghost& of, int turn, const Lanes& middle) const {
  Ghost child = of;
  child.corners = child_corners(of.corners, turn);
  child.apex = middle;
  child.left = turn == 0 ? of.apex : of.right;
  child.right = turn == 0 ? of.left : of.apex;
  child.level = of.level + 1;
  child.cover = cover_of(tree_.lattice(), child.corners, of.cover);
  const float bound = tree_.surface().bound(centre_of(child.corners), child.level);
  child.cull = child.cover == Cover::padding
                   ? k_out
                   : projection_.assess(child.apex, child.left, child.right, bound, of.cull).cull;
  return child;
}

// From the coarsest diamond of the chain down. The half across the base of each finer one is a child that the diamond
// before would have made.
int RoamEngine::split_cost(const Chain& chain) const {
  const auto seen = [](const Ghost& g) { return int(!(g.cull & k_out)); };
  int cost = 0;
  std::optional<Ghost> across;
  const uint32_t last_base = tree_.neighbour[chain.node[chain.length - 1]].base;
  if (last_base != k_none) across = ghost(last_base);
  for (int i = chain.length; i-- > 0;) {
    const Ghost own = ghost(chain.node[i]);
    const LatticePoint m = centre_of(own.corners);
    const Lanes middle = projection_.project(glm::dvec3(tree_.lattice().world_xy(m), tree_.surface().height(m)));
    const Ghost children[2] = {ghost_child(own, 0, middle), ghost_child(own, 1, middle)};
    cost += seen(children[0]) + seen(children[1]) - seen(own);
    if (across) cost += seen(ghost_child(*across, 0, middle)) + seen(ghost_child(*across, 1, middle)) - seen(*across);
    if (i > 0) across = children[tree_.neighbour[chain.node[i]].left == chain.node[i - 1] ? 0 : 1];
  }
  return cost;
}

}  // namespace sward::roam
