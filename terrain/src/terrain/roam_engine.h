// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <chrono>
#include <optional>
#include <vector>

#include "roam_calendar.h"
#include "roam_claims.h"
#include "roam_draws.h"
#include "roam_projection.h"
#include "roam_queue.h"
#include "roam_tree.h"

namespace sward::roam {

/// The most leaves a mesh may have, visible or not.
uint32_t leaf_limit(const RoamOptions& options, uint32_t roots);

/// Fails when an option is out of range or the budget is below the number of drawable roots.
Expected<void> check_options(const RoamOptions& options, uint32_t drawable_roots);

/// The mesh behind RoamMesh: a tree, what the current view makes of its nodes, the two queues, the drawn leaves.
///
/// A node is *out* when a halfspace of the frustum excludes its wedgie; its whole sub-tree is then marked out, and only
/// the topmost such node is looked at again. Everything else has a time, too, until which it need not be looked at:
///   - a visible leaf that is not in the split queue has a priority of at most leaf_guard_;
///   - a visible mergeable diamond that is not in the merge queue has one of at least diamond_guard_.
/// The guards enclose the priority at which splitting and merging balance, so the queues hold the few nodes around it.
/// With RoamOptions::plain all nodes are looked at in every new view and all are queued.
class RoamEngine {
 public:
  RoamEngine(const Surface& surface, const RoamOptions& options);

  /// `time_s` as RoamMesh::update(); nothing: no morph.
  Expected<RoamStats> update(const View& view, std::optional<double> time_s = {});
  Expected<void> set_options(const RoamOptions& options);
  const RoamOptions& options() const { return options_; }
  void surface_changed(const LatticeBox& box) { changes_.push_back({box, true}); }
  void residency_changed(const LatticeBox& box) { changes_.push_back({box, false}); }

  /// Must outlive its use; null: none. Takes effect at the next update.
  void set_priorities(const HostPriorities* priorities) { claims_.attach(priorities); }

  /// Splits a leaf after the leaves that it forces; the number of diamonds split. Does not look at the budget.
  uint32_t split(uint32_t leaf);
  /// Merges the diamond of a mergeable node.
  void merge(uint32_t node);
  /// Change of the number of visible leaves that split() would make.
  int split_cost(const Chain& chain) const;
  /// Visible leaves that merge() would take away; negative when it brings more into sight than it removes.
  int merge_gain(uint32_t node) const;

  /// As RoamMesh::bound_px(): what visible leaves are off at most, moving corners included.
  float bound_px() const;
  /// At least the priorities of the visible leaves, which are thicknesses: about twice what resting ones are off.
  float greatest_priority() const;
  Expected<void> validate() const;

  const RoamTree& tree() const { return tree_; }
  const DrawList& draws() const { return draws_; }
  /// The view of the last update; nothing before the first.
  const std::optional<View>& view() const { return view_; }
  bool is_visible(uint32_t node) const { return !(state_[node].cull & k_out); }
  uint32_t visible_count() const { return draws_.count(); }

 private:
  friend class Validator;
  struct Ghost;

  // Reading nodes.
  Forms forms(uint32_t vertex) const {
    SeenVertex& seen = seen_[vertex];
    if (seen.view == view_number_) return Forms::loaded(seen.form);
    const Forms forms = projection_.project(seen.world);
    forms.store(seen.form);
    seen.view = view_number_;
    return forms;
  }
  /// Up to four nodes side by side, as if nothing claimed them.
  void measure(std::span<const uint32_t> nodes, Projection::Wanted wanted, Reading* readings) const {
    const Wedgie* wedgies[Projection::k_together] = {};
    for (size_t i = 0; i < nodes.size(); ++i) wedgies[i] = &wedgie_[nodes[i]];
    projection_.read({wedgies, nodes.size()}, {units_, leaf_guard_, diamond_guard_}, wanted, readings);
  }
  /// The same, but what is claimed has the artificial priority and is looked at in every update.
  void read(std::span<const uint32_t> nodes, Projection::Wanted wanted, Reading* readings) const {
    measure(nodes, wanted, readings);
    for (size_t i = 0; i < nodes.size(); ++i) {
      if (!wedgie_[nodes[i]].claimed || readings[i].out()) continue;
      readings[i].priority = RoamMesh::k_artificial_max;
      readings[i].below = readings[i].above = 0;
    }
  }
  Reading measure(uint32_t node) const {
    Reading reading;
    measure({&node, 1}, Projection::k_all, &reading);
    return reading;
  }
  Reading read(uint32_t node) const {
    Reading reading;
    read({&node, 1}, Projection::k_all, &reading);
    return reading;
  }
  Assessment assess(uint32_t node, CullFlags inherited) const;
  CullFlags inherited_flags(uint32_t node) const;

  // Following the view: roam_follow.cpp.
  void follow_eye(glm::dvec3 eye);
  void look_anew(const std::optional<View>& last, const Projection& before);
  bool advance_clocks(const View& from, const Projection& before);
  void tune_units(float metres, float radians);
  void start_over();
  void look_at_all();
  void look(uint32_t node, CullFlags inherited);
  void take_reading(uint32_t node, const Reading& reading);
  void look_plainly(uint32_t node, CullFlags inherited);
  void look_at_due();
  void look_at_out(uint32_t node, const Reading& reading);
  void look_at_leaf(uint32_t node, const Reading& reading);
  template <typename Current, typename Look>
  void look_together(const std::vector<Calendar::Entry>& due, Projection::Wanted wanted, Current current, Look look);
  void look_at_outs();
  void look_at_leaves();
  void look_at_diamonds();
  void look_at_lingering();
  void prefetch_node(uint32_t node) const;
  void prefetch_corners(uint32_t node) const;
  void prefetch_nodes(size_t place) const;
  void prefetch_bases(size_t place) const;
  void prefetch_due(const std::vector<Calendar::Entry>& due, size_t place) const;
  void lower_leaf_guard();
  void raise_diamond_guard(float limit);
  void follow_balance();

  // What is found out about single nodes: roam_place.cpp.
  bool acts_as_leaf(uint32_t node) const {
    return tree_.is_leaf(node) ? !in_falling(node) : (state_[node].cull & k_falling) != 0;
  }
  bool in_falling(uint32_t leaf) const { return state_[leaf].held; }
  void show(uint32_t leaf);
  float until_side_changes(uint32_t node, const Reading& reading, float ticks);
  void begin_lingering();
  void note_lingering(uint32_t node);
  void place(uint32_t node, const Reading& reading);
  void unplace(uint32_t node);
  void mark_out(uint32_t node);
  void watch_out(uint32_t node, const Reading& reading);
  void go_out(uint32_t node, const Reading& reading);
  void come_in(uint32_t node);
  void refresh_diamond(uint32_t node);
  void place_diamond(uint32_t diamond);
  float plain_key(uint32_t diamond) const;
  struct Halves {
    std::array<uint32_t, 2> node;
    size_t count = 0;
  };
  Halves halves_in_sight(uint32_t diamond) const;
  std::optional<float> defer_diamond(uint32_t diamond);
  std::optional<float> defer_diamond(uint32_t diamond, std::span<const Reading> halves);
  void queue_diamond(uint32_t diamond, float key);
  void unqueue_diamond(uint32_t diamond);
  void forget_diamond(uint32_t node);
  void mark_halves(uint32_t node, bool queued);
  void grow_arrays();
  void take_vertex(uint32_t vertex);
  void take_node(uint32_t node);
  void take_roots();

  // Adapting: roam_refine.cpp.
  enum class Room { enough, full, later };
  void prefetch_splits() const;
  void split_one(uint32_t node);
  void take_children(std::span<const uint32_t, 2> halves);
  uint32_t split_chain(const Chain& chain);
  void merge_now(uint32_t node);
  bool converge();
  uint32_t worst_leaf();
  uint32_t cheapest_diamond(float below);
  bool make_room(uint32_t node);
  Room room_for(const Chain& chain);
  Room room_for_stop(uint32_t node) const;
  Reading plain_reading(uint32_t node) const;
  void shrink_to_budget();
  void give_up(uint32_t node);
  void trim_below_target();
  void release_slowly();
  void release_more();
  bool out_of_time();
  uint32_t decision_budget() const;
  int64_t decided_count() const { return int64_t(visible_count()) - falling_surplus_; }
  Ghost ghost(uint32_t node) const;
  void see(std::span<Ghost> children) const;
  Ghost ghost_child(const Ghost& of, int turn, glm::dvec3 middle) const;

  // Morph: roam_morph.cpp.
  void set_time(double time_s);
  bool morphs() const { return now_.has_value() && options_.morph_s > 0 && !options_.plain && !from_nothing_; }
  double seconds_left() const;
  float clear_ticks(uint32_t node, double from_z, double to_z) const;
  float modest() const;
  float modest_ticks(uint32_t node) const;
  void move_centre(uint32_t node, double from_z, double to_z, float seconds, float clear_ticks);
  void stand_still(uint32_t node);
  void forget_clearances();
  void rise(uint32_t node, double from_z);
  void fall(uint32_t node);
  void stop_fall(uint32_t node);
  void finish_motions();
  void finish_falls_now(uint32_t most_visible);
  void finish_motions_now();
  void count_falling_surplus();
  float moved_error(float rest) const;
  float moved_error(uint32_t node, uint32_t vertex, float rest, float worst) const;
  bool centre_moves(uint32_t node) const { return !options_.plain && tree_.vertices.moves(tree_.centre_vertex(node)); }

  // What the host has named: roam_claims.cpp.
  void follow_claims(bool surface_changed);
  bool look_at_claimed();
  void restart_claims();
  void claim_child(uint32_t child);
  bool diamond_claimed(uint32_t node) const;
  void stand(uint32_t node);
  bool end_falls_for(uint32_t leaf);
  bool end_rises_for(uint32_t leaf);
  uint32_t unmet_claims() const;
  float bound_of(const BucketQueue& queue) const;
  float target_priority() const { return options_.target_px > 0 ? projection_.priority_of(options_.target_px) : 0; }

  // The surface: roam_surface.cpp.
  void read_surface_again();
  void ask_again_what_splits();
  void collapse_forbidden(uint32_t node, const LatticeBox& box);
  void reread(uint32_t node, const LatticeBox& box);
  void look_again(uint32_t node);
  void collapse(uint32_t node);

  RoamTree tree_;
  RoamOptions options_;
  std::optional<View> view_;
  std::optional<double> now_;  // seconds
  double still_since_ = 0;     // the time of the last change of what is asked for
  Projection projection_;
  bool settled_ = false;       // the mesh is what view_ and options_ ask for
  bool balanced_ = true;       // the largest priority left is where splitting and merging meet
  bool fresh_ = true;          // nothing is known of the nodes
  bool from_nothing_ = false;  // the mesh of this update has no past to move from
  RoamStats stats_;

  NodeStates state_;
  LargeVector<Wedgie> wedgie_;                  // by node
  std::vector<uint32_t> lingering_, lingered_;  // visible leaves that may have gone out of sight, the older ones second
  uint32_t lingering_list_ = 1;                 // the number of the first
  double lingering_ticks_ = 0;                  // since it was begun
  // Least and most ticks after which a visible leaf that may have left the view is looked at.
  static constexpr float k_least_patience = 10, k_most_patience = 320;
  bool new_to_rest_ = false;   // the view of the last update was new
  BucketQueue split_queue_;    // visible leaves near the balance
  BucketQueue merge_queue_;    // mergeable diamonds near the balance, by their lower node, and all that are out
  BucketQueue blocked_queue_;  // visible leaves near the balance that the surface does not allow to split
  DrawList draws_;
  Claims claims_;

  // Deferral.
  float leaf_guard_ = 0, diamond_guard_ = RoamMesh::k_artificial_max;
  float balance_ = RoamMesh::k_artificial_max;  // that the guards followed last
  Calendar out_calendar_, leaf_calendar_, diamond_calendar_;
  TickUnits units_, safe_units_;
  float peak_metres_ = 0, peak_radians_ = 0;  // of the last seconds, per update
  TickUnits least_units_, last_least_units_;  // of the present k_span ticks and of those before
  double safe_ticks_ = 0;                     // that the present ones still take
  uint32_t leaf_guard_steps_ = 0, diamond_guard_steps_ = 0;
  uint32_t hidden_merges_left_ = 0;
  uint32_t hot_mark_ = 1;  // of nodes that are looked at in the next update: 1 or 2
  std::vector<uint32_t> hot_leaves_, hot_diamonds_, hot_outs_;
  std::vector<Calendar::Entry> due_leaves_, due_diamonds_, due_outs_;

  // Nodes that look_at_all() visits, in order, with their parents' flags.
  struct Visit {
    uint32_t node;
    CullFlags inherited;
  };
  std::vector<Visit> visits_;

  // What the last chain costs of which that was asked in this update: asked again after each merge that makes room.
  struct Priced {
    std::vector<uint32_t> chain;
    int cost = 0;
  } priced_;

  // Motion.
  struct Motion {
    uint32_t node;  // half of the diamond whose centre moves
    uint32_t vertex;
    double arrives;        // not before this time
    uint32_t clear_until;  // the tick of out_calendar_ up to which it need not be looked at
    bool falls;            // or did once
  };
  bool lasts(const Motion& motion) const;
  bool is_current(const Motion& motion) const;
  bool stays_clear(Motion& motion) const;
  std::vector<Motion> motions_;
  int64_t falling_surplus_ = 0;  // drawn triangles that are gone once all falls have ended

  struct Change {
    LatticeBox box;
    bool heights;  // or only what may be split
  };
  std::vector<Change> changes_;

  // What a view makes of a vertex, computed when first needed, beside what it is computed from: one cache line. Kept
  // with RoamOptions::plain only.
  struct alignas(64) SeenVertex {
    glm::dvec3 world{0};
    float form[Forms::k_forms] = {};
    uint32_t view = 0;
  };
  mutable LargeVector<SeenVertex> seen_;  // by vertex
  uint32_t view_number_ = 0;

  std::chrono::steady_clock::time_point deadline_;
  uint32_t time_checks_ = 0;
  uint64_t operations_ = 0;
  uint64_t operation_limit_ = 0;
  static constexpr uint64_t k_all_released = ~uint64_t(0);
  uint64_t released_ = k_all_released;  // operations an update may take after parts of the surface were loaded
};

}  // namespace sward::roam
