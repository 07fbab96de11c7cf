// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <chrono>
#include <optional>
#include <vector>

#include "roam_projection.h"
#include "roam_queue.h"
#include "roam_tree.h"

namespace sward::roam {

/// The most leaves a mesh may have, visible or not.
uint32_t leaf_limit(const RoamOptions& options, uint32_t roots);

/// Fails when an option is out of range or the budget is below the number of drawable roots.
Expected<void> check_options(const RoamOptions& options, uint32_t drawable_roots);

/// The mesh behind RoamMesh: a tree, what the current view makes of its nodes, the two queues, the list of drawn
/// leaves. split() and merge() keep all of it consistent; update() adapts to a view.
class RoamEngine {
 public:
  RoamEngine(const Surface& surface, const RoamOptions& options);

  Expected<RoamStats> update(const View& view);
  Expected<void> set_options(const RoamOptions& options);
  const RoamOptions& options() const { return options_; }

  /// Splits a leaf after the leaves that it forces; the number of diamonds split. Does not look at the budget.
  uint32_t split(uint32_t leaf);
  /// Merges the diamond of a mergeable node.
  void merge(uint32_t node);
  /// Change of the number of visible leaves that split() would make.
  int split_cost(const Chain& chain) const;
  /// Visible leaves that merge() would take away; negative when it brings more into sight than it removes.
  int merge_gain(uint32_t node) const;

  /// Largest priority of a visible leaf.
  float bound_px() const;
  Expected<void> validate() const;

  const RoamTree& tree() const { return tree_; }
  /// The view of the last update; nothing before the first.
  const std::optional<View>& view() const { return view_; }
  bool is_visible(uint32_t node) const { return !(state_[node].cull & k_out); }
  float priority(uint32_t node) const { return state_[node].priority; }
  uint32_t visible_count() const { return uint32_t(drawn_.size()); }
  std::span<const uint32_t> indices() const { return indices_; }

 private:
  friend class Validator;
  struct Ghost;

  // View and culling.
  void follow_eye(glm::dvec3 eye);
  void reassess_all();
  void reassess(uint32_t node, CullFlags inherited);
  void prefetch_nodes(size_t place) const;
  const Lanes& lanes(uint32_t vertex) const {
    SeenVertex& seen = seen_[vertex];
    if (seen.view != view_number_) {
      seen.lanes = projection_.project(seen.world);
      seen.view = view_number_;
    }
    return seen.lanes;
  }
  Assessment assess(uint32_t node, CullFlags inherited) const;
  CullFlags inherited_flags(uint32_t node) const;
  void adopt(uint32_t node, CullFlags inherited);
  void grow_arrays();
  void take_vertex(uint32_t vertex);

  // Membership in queues and in the list of drawn leaves.
  void refresh_leaf(uint32_t node);
  void forget_leaf(uint32_t node);
  float diamond_key(uint32_t node) const;
  void refresh_diamond(uint32_t node);
  void forget_diamond(uint32_t node);
  void mark_halves(uint32_t node, bool queued);
  void draw(uint32_t node);
  void undraw(uint32_t node);

  // Adapting.
  void split_one(uint32_t node);
  bool converge();
  bool make_room(uint32_t node);
  bool fits(const Chain& chain) const;
  void shrink_to_budget();
  void count_merge(uint32_t node);
  void trim_below_target();
  bool out_of_time();
  Ghost ghost(uint32_t node) const;
  Ghost ghost_child(const Ghost& of, int turn, const Lanes& middle) const;

  RoamTree tree_;
  RoamOptions options_;
  std::optional<View> view_;
  Projection projection_;
  bool settled_ = false;  // the mesh is what view_ and options_ ask for
  RoamStats stats_;

  NodeStates state_;
  BucketQueue split_queue_;      // visible leaves
  BucketQueue merge_queue_;      // mergeable diamonds, by their lower node
  std::vector<uint32_t> drawn_;  // visible leaves, unordered
  std::vector<uint32_t> indices_;
  std::vector<uint32_t> draw_slot_;  // by node: place in drawn_

  // Nodes that reassess_all() visits, in order, with their parents' flags.
  struct Visit {
    uint32_t node;
    CullFlags inherited;
  };
  std::vector<Visit> visits_;

  // What a view makes of a vertex, computed when first needed, beside what it is computed from: one cache line.
  struct alignas(64) SeenVertex {
    Lanes lanes;
    glm::dvec3 world{0};
    uint32_t view = 0;
  };
  mutable std::vector<SeenVertex> seen_;  // by vertex
  uint32_t view_number_ = 0;

  std::chrono::steady_clock::time_point deadline_;
  uint32_t time_checks_ = 0;
  uint64_t operations_ = 0;
  uint64_t operation_limit_ = 0;
};

}  // namespace sward::roam
