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
#include <algorithm>
#include <cmath>

#include "roam_engine.h"

namespace sward::roam {

namespace {

// Leaves, above twice the budget and the roots, that narrow views may need for the sides of their deepest triangles.
constexpr uint32_t k_spare_leaves = 4096;
constexpr uint32_t k_operations_between_clock_reads = 16;
// Share of the budget that decisions keep for triangles on their way out.
constexpr uint32_t k_reserve_divisor = 24;
// Diamonds out of sight that an update may merge, and the share of the leaves that it may in any case.
constexpr uint32_t k_hidden_merges = 256, k_hidden_merges_divisor = 64;

}  // namespace

uint32_t leaf_limit(const RoamOptions& options, uint32_t roots) {
  const uint64_t limit = 2 * uint64_t(options.max_triangles) + roots + k_spare_leaves;
  return uint32_t(std::min<uint64_t>(limit, uint32_t(1) << 30));
}

uint32_t RoamEngine::decision_budget() const {
  return morphs() ? options_.max_triangles - options_.max_triangles / k_reserve_divisor : options_.max_triangles;
}

uint32_t RoamEngine::split_chain(const Chain& chain) {
  priced_.chain.clear();
  for (int i = chain.length; i-- > 0;) split_one(chain.node[i]);
  return uint32_t(chain.length);
}

// Of a diamond that has just been split.
void RoamEngine::take_children(std::span<const uint32_t, 2> halves) {
  std::array<uint32_t, 4> in_sight;
  size_t count = 0;
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    for (uint32_t child = tree_.child[half]; child <= tree_.child[half] + 1; ++child) {
      state_[child] = {};
      wedgie_[child] = {};
      take_node(child);
      if (wedgie_[half].claimed) claim_child(child);
      if (!is_visible(half)) continue;
      if (options_.plain) {
        look_plainly(child, state_[half].cull);
      } else {
        in_sight[count++] = child;
      }
    }
  }
  if (count == 0) return;
  std::array<Reading, 4> readings;
  read({in_sight.data(), count}, Projection::k_below, readings.data());
  for (size_t i = 0; i < count; ++i) take_reading(in_sight[i], readings[i]);
}

void RoamEngine::split_one(uint32_t node) {
  const uint32_t halves[2] = {node, tree_.neighbour[node].base};
  bool seen = false, stands = false;
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    const uint32_t parent = tree_.nodes[half].parent;
    if (in_falling(half)) stop_fall(parent);
    if (parent != k_none) forget_diamond(parent);
    stands |= wedgie_[half].claimed;
    if (!is_visible(half)) continue;
    seen = true;
    const NodeState& s = state_[half];
    stands |= morphs() && (s.queued() ? s.key : read(half).priority) > modest();
    unplace(half);
    if (draws_.contains(half)) draws_.remove(half);
  }
  const Corners& c = tree_.corner[node];
  const double from_z = 0.5 * (tree_.vertices.drawn_z(c.left) + tree_.vertices.drawn_z(c.right));
  tree_.split_diamond(node);
  grow_arrays();
  if (options_.plain) take_vertex(tree_.centre_vertex(node));
  take_children(halves);
  // What crosses the near plane has no bound in pixels to keep while it moves; what is claimed must be right at once.
  if (morphs() && seen && !stands) {
    rise(node, from_z);
  } else {
    refresh_diamond(node);
  }
}

// Without any motion.
void RoamEngine::merge_now(uint32_t node) {
  const uint32_t halves[2] = {node, tree_.neighbour[node].base};
  forget_diamond(node);
  for (const uint32_t half : halves) {
    if (half == k_none) continue;
    if (state_[half].cull & k_falling) {
      if (is_visible(half)) unplace(half);
      state_[half].cull = CullFlags(state_[half].cull & ~k_falling);
    }
    for (uint32_t child = tree_.child[half]; child <= tree_.child[half] + 1; ++child) {
      unplace(child);
      if (wedgie_[child].claimed) claims_.forget(child);
      if (draws_.contains(child)) draws_.remove(child);
      state_[child].cull = k_out;
    }
  }
  tree_.merge_diamond(node);
  for (const uint32_t half : halves) {
    if (half == k_none || !is_visible(half)) continue;
    const Reading reading = options_.plain ? plain_reading(half) : read(half);
    if (reading.out() && !options_.plain) {
      go_out(half, reading);
    } else {
      show(half);
      place(half, reading);
    }
  }
  for (const uint32_t half : halves)
    if (half != k_none) refresh_diamond(tree_.nodes[half].parent);
}

Reading RoamEngine::plain_reading(uint32_t node) const {
  Reading reading;
  reading.bound = tree_.corner[node].bound;
  reading.priority = state_[node].priority;
  return reading;
}

// What the coming splits read and write lies scattered: the nodes, their parents' diamonds, heights, and the bounds of
// children, of which each is a cell of a large table. In passes, since each finds the addresses of the next.
void RoamEngine::prefetch_splits() const {
  std::array<uint32_t, 96> halves;
  const size_t first = split_queue_.some_highest(state_, {halves.data(), halves.size() / 2});
  size_t count = first;
  for (size_t i = 0; i < first; ++i) __builtin_prefetch(&tree_.neighbour[halves[i]]);
  for (size_t i = 0; i < first; ++i) {
    const uint32_t base = tree_.neighbour[halves[i]].base;
    if (base != k_none) halves[count++] = base;
  }
  for (size_t i = 0; i < count; ++i) {
    const uint32_t half = halves[i];
    __builtin_prefetch(&tree_.nodes[half]);
    __builtin_prefetch(&tree_.corner[half]);
    __builtin_prefetch(&tree_.child[half]);
    __builtin_prefetch(&state_[half]);
    __builtin_prefetch(&wedgie_[half]);
    __builtin_prefetch(&tree_.neighbour[half]);
  }
  for (size_t i = 0; i < count; ++i) {
    const Corners& c = tree_.corner[halves[i]];
    for (const uint32_t vertex : {c.apex, c.left, c.right}) {
      __builtin_prefetch(&tree_.vertices.lattice[vertex]);
      __builtin_prefetch(&tree_.vertices.points[vertex]);
    }
    if (const uint32_t parent = tree_.nodes[halves[i]].parent; parent != k_none) {
      __builtin_prefetch(&tree_.neighbour[parent]);
      __builtin_prefetch(&state_[parent]);
      __builtin_prefetch(&wedgie_[parent]);
    }
  }
  for (size_t i = 0; i < count; ++i) {
    const TriangleCorners c = tree_.corners(halves[i]);
    tree_.surface().prefetch(centre_of(c));
    for (int turn = 0; turn < 2; ++turn) tree_.surface().prefetch(centre_of(child_corners(c, turn)));
  }
}

// False when there is more to do: the time cap, what loaded squares set free, or triangles on their way out ended it.
// The clock is first read after some operations, so that every update makes progress.
bool RoamEngine::converge() {
  hidden_merges_left_ = options_.plain ? ~0u : k_hidden_merges + visible_count() / k_hidden_merges_divisor;
  balanced_ = true;
  priced_.chain.clear();
  shrink_to_budget();
  prefetch_splits();
  while (operations_ < operation_limit_) {
    if (out_of_time() || operations_ >= released_) {
      stats_.capped = true;
      balanced_ = false;
      return false;
    }
    const uint32_t worst = worst_leaf();
    if (worst == k_none) {
      trim_below_target();
      return motions_.empty() && hidden_merges_left_ > 0;
    }
    const bool falls = !tree_.is_leaf(worst);
    const Room room = falls ? room_for_stop(worst) : room_for(tree_.forced_chain(worst));
    if (room == Room::later) {
      if (!end_falls_for(worst)) {
        balanced_ = false;
        return false;
      }
    } else if (room == Room::full) {
      if (!make_room(worst) && !end_rises_for(worst)) return motions_.empty() && hidden_merges_left_ > 0;
    } else if (falls) {
      stop_fall(worst);
      ++operations_;
    } else {
      const uint32_t split_count = split(worst);
      stats_.splits += split_count;
      operations_ += split_count;
    }
  }
  return true;
}

// The visible leaf of the largest priority; k_none when none is above the target.
uint32_t RoamEngine::worst_leaf() {
  for (;;) {
    const uint32_t worst = split_queue_.top(state_);
    const float key = worst == k_none ? 0.0f : state_[worst].key;
    if (key >= leaf_guard_ || leaf_guard_ <= target_priority())
      return worst != k_none && key > target_priority() ? worst : k_none;
    lower_leaf_guard();
  }
}

// The visible mergeable diamond of the least priority, sought no further than up to `limit`; k_none: there is none.
uint32_t RoamEngine::cheapest_diamond(float limit) {
  for (;;) {
    const uint32_t lowest = merge_queue_.lowest(state_);
    if (lowest != k_none && state_[lowest].key <= diamond_guard_) return lowest;
    if (diamond_guard_ >= limit) return lowest;
    raise_diamond_guard(limit);
  }
}

RoamEngine::Room RoamEngine::room_for(const Chain& chain) {
  const int64_t most = 2 * int64_t(chain.length);
  if (tree_.leaf_count() + most > leaf_limit(options_, tree_.root_count())) return Room::full;
  const int64_t decided_room = int64_t(decision_budget()) - decided_count();
  const int64_t drawn_room = int64_t(options_.max_triangles) - visible_count();
  // A split beside a falling diamond makes it rise again: then its triangles stay.
  int64_t rising = 0;
  for (int i = 0; i < chain.length; ++i)
    for (const uint32_t half : {chain.node[i], tree_.neighbour[chain.node[i]].base})
      if (half != k_none && in_falling(half)) rising += merge_gain(tree_.nodes[half].parent);
  if (most + rising <= decided_room && most <= drawn_room) return Room::enough;
  if (!std::ranges::equal(chain.nodes(), priced_.chain)) {
    priced_.chain.assign(chain.nodes().begin(), chain.nodes().end());
    priced_.cost = split_cost(chain);
  }
  const int cost = priced_.cost;
  if (cost + rising > decided_room) return Room::full;
  return cost > drawn_room ? Room::later : Room::enough;
}

RoamEngine::Room RoamEngine::room_for_stop(uint32_t node) const {
  return decided_count() + merge_gain(node) <= int64_t(decision_budget()) ? Room::enough : Room::full;
}

// One merge towards splitting `node`; false when none is worth it.
bool RoamEngine::make_room(uint32_t node) {
  const uint32_t hidden = hidden_merges_left_ > 0 ? merge_queue_.unprioritised() : k_none;
  uint32_t victim = hidden;
  const bool crowded = tree_.leaf_count() + 2 * (k_max_level + 1) > leaf_limit(options_, tree_.root_count());
  if (!crowded || hidden == k_none) {
    const uint32_t lowest = cheapest_diamond(state_[node].key / (1 + options_.hysteresis));
    const bool pays = lowest != k_none && state_[lowest].key * (1 + options_.hysteresis) < state_[node].key;
    if (pays) victim = lowest;
  }
  if (victim == k_none) return false;
  give_up(victim);
  shrink_to_budget();
  return true;
}

// A merge may bring more into sight than it removes, so this runs after every merge, too.
void RoamEngine::shrink_to_budget() {
  while (decided_count() > int64_t(decision_budget())) {
    uint32_t victim = cheapest_diamond(RoamMesh::k_artificial_max);
    if (victim == k_none) victim = merge_queue_.unprioritised();
    if (victim == k_none) break;
    give_up(victim);
  }
  if (visible_count() > options_.max_triangles) finish_falls_now(options_.max_triangles);
  while (visible_count() > options_.max_triangles) {
    uint32_t victim = cheapest_diamond(RoamMesh::k_artificial_max);
    if (victim == k_none) victim = merge_queue_.unprioritised();
    if (victim == k_none && !motions_.empty()) {
      finish_motions_now();
      continue;
    }
    if (victim == k_none) break;  // the root mesh, which no budget is below
    merge_now(victim);
    ++stats_.merges;
    ++operations_;
  }
  while (tree_.leaf_count() > leaf_limit(options_, tree_.root_count())) {
    const uint32_t victim = merge_queue_.unprioritised();
    if (victim == k_none || int64_t(visible_count()) - merge_gain(victim) > int64_t(options_.max_triangles)) return;
    give_up(victim);
  }
}

// Merges a diamond, or begins to.
void RoamEngine::give_up(uint32_t node) {
  ++operations_;
  const float key = state_[node].key;
  if (key < 0) {
    hidden_merges_left_ -= hidden_merges_left_ > 0;
  } else if (morphs() && key < RoamMesh::k_artificial_max) {
    const size_t moving = motions_.size();
    fall(node);
    stats_.merges += motions_.size() == moving;
    return;
  }
  merge_now(node);
  ++stats_.merges;
}

// With a target in pixels, what is finer than it by more than the hysteresis is given up.
void RoamEngine::trim_below_target() {
  if (options_.target_px <= 0) return;
  const float limit = target_priority() / (1 + options_.hysteresis);
  while (!out_of_time()) {
    uint32_t victim = hidden_merges_left_ > 0 ? merge_queue_.unprioritised() : k_none;
    if (victim == k_none) {
      victim = cheapest_diamond(limit);
      if (victim == k_none || state_[victim].key >= limit) return;
    }
    if (int64_t(visible_count()) - merge_gain(victim) > int64_t(options_.max_triangles)) return;
    give_up(victim);
  }
}

// A square that arrives sets thousands of splits free at once. So many operations a frame does the mesh follow with;
// the number grows from frame to frame, so that it gets there however fast the view changes meanwhile.
void RoamEngine::release_slowly() {
  constexpr uint64_t k_least = 256, k_share = 64;
  if (released_ == k_all_released && !from_nothing_ && !options_.plain) released_ = k_least + visible_count() / k_share;
}

void RoamEngine::release_more() {
  constexpr uint64_t k_growth = 8;
  released_ = operations_ >= released_ ? released_ + released_ / k_growth : k_all_released;
}

bool RoamEngine::out_of_time() {
  if (options_.time_cap_s <= 0 || ++time_checks_ % k_operations_between_clock_reads != 0) return false;
  return std::chrono::steady_clock::now() >= deadline_;
}

// A triangle that may not exist yet.
struct RoamEngine::Ghost {
  TriangleCorners corners;
  glm::dvec3 apex, left, right;  // world
  int level = 0;
  Cover cover = Cover::inside;
  CullFlags cull = k_out;
};

RoamEngine::Ghost RoamEngine::ghost(uint32_t node) const {
  const Corners& c = tree_.corner[node];
  const auto world = [this](uint32_t vertex) { return tree_.vertices.points[vertex].world; };
  return {tree_.corners(node),          world(c.apex),           world(c.left),    world(c.right),
          tree_.nodes[node].id.level(), tree_.nodes[node].cover, state_[node].cull};
}

RoamEngine::Ghost RoamEngine::ghost_child(const Ghost& of, int turn, glm::dvec3 middle) const {
  Ghost child = of;
  child.corners = child_corners(of.corners, turn);
  child.apex = middle;
  child.left = turn == 0 ? of.apex : of.right;
  child.right = turn == 0 ? of.left : of.apex;
  child.level = of.level + 1;
  child.cover = cover_of(tree_.lattice(), child.corners, of.cover);
  return child;
}

// Their flags, which are their parents' so far, as looks will find them.
void RoamEngine::see(std::span<Ghost> children) const {
  std::array<Wedgie, Projection::k_together> wedgies;
  std::array<const Wedgie*, Projection::k_together> asked;
  for (size_t i = 0; i < children.size(); ++i) {
    const Ghost& g = children[i];
    const bool padding = g.cover == Cover::padding;
    const float bound = padding ? -1.0f : tree_.surface().bound(centre_of(g.corners), g.level);
    wedgies[i].place(g.apex, g.left, g.right, bound);
    asked[i] = &wedgies[i];
  }
  if (options_.plain) {
    const auto forms = [&](glm::dvec3 p) { return projection_.project(p); };
    for (size_t i = 0; i < children.size(); ++i) {
      Ghost& g = children[i];
      g.cull = projection_.assess(forms(g.apex), forms(g.left), forms(g.right), wedgies[i].bound, g.cull).cull;
    }
    return;
  }
  const auto out = projection_.out({asked.data(), children.size()});
  for (size_t i = 0; i < children.size(); ++i)
    children[i].cull = children[i].cull & k_out || out[i] ? k_out : CullFlags(0);
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
    const glm::dvec3 middle(tree_.lattice().world_xy(m), tree_.surface().height(m));
    std::array<Ghost, 4> children;
    const size_t count = across ? 4 : 2;
    for (int turn = 0; turn < 2; ++turn) {
      children[size_t(turn)] = ghost_child(own, turn, middle);
      if (across) children[size_t(2 + turn)] = ghost_child(*across, turn, middle);
    }
    see({children.data(), count});
    for (size_t k = 0; k < count; ++k) cost += seen(children[k]);
    cost -= seen(own) + (across ? seen(*across) : 0);
    if (i > 0) across = children[tree_.neighbour[chain.node[i]].left == chain.node[i - 1] ? 0 : 1];
  }
  return cost;
}

}  // namespace sward::roam
