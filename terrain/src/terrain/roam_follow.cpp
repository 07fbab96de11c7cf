// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Taking a new view in. Deferral (Duchaineau et al. 1997, section 7.3) with clocks instead of frames: a clock's tick is
// so many metres of travel and so many radians of turning, whichever comes first. Findings are entered by the tick up
// to which they surely hold (roam_projection.cpp), so however the camera speeds up, nothing is looked at too late: the
// clock runs faster. The leaves' and the diamonds' clocks also run while their guard falls or rises towards what was
// found out; a guard that moves away costs nothing.
//
// Units follow the camera, so that a tick is about a fifth of a frame's motion. New entries are made with units_; the
// clocks run by safe_units_, the least that any living entry was made with.
#include <algorithm>
#include <cmath>

#include "roam_engine.h"

namespace sward::roam {

namespace {

// The eye may go this far from the origin of the GPU's floats, metres, and the clock so far from that of its times.
constexpr double k_rebase_distance = 1000.0, k_rebase_seconds = 2048.0;
// Share of the visible triangles that have to stay in sight for the mesh to be worth keeping.
constexpr double k_worth_keeping = 0.2;
// The guards' places about the balance, and how far they may be from them without being moved.
constexpr float k_leaf_place = 0.998f, k_leaf_highest = 0.9995f, k_leaf_lowest = 0.990f;
constexpr float k_diamond_place = 0.998f, k_diamond_lowest = 0.992f, k_diamond_highest = 1.008f;
constexpr float k_first_guard_ticks = 2, k_guard_ticks_a_frame = 3;

double angle_between(const glm::dmat3& a, const glm::dmat3& b) {
  double sum = 0;
  for (int column = 0; column < 3; ++column) sum += glm::dot(a[column] - b[column], a[column] - b[column]);
  // The Frobenius norm of the difference of two rotations is 2 sqrt(2) sin(angle / 2).
  return 2.0 * std::asin(std::min(std::sqrt(sum / 8.0), 1.0));
}

}  // namespace

void RoamEngine::follow_eye(glm::dvec3 eye) {
  VertexPool& v = tree_.vertices;
  const bool far = glm::distance(eye, v.origin) > k_rebase_distance || v.now - v.time_origin > k_rebase_seconds;
  if (!view_ || far) v.rebase(glm::round(eye));
}

void RoamEngine::look_anew(const std::optional<View>& last, const Projection& before) {
  follow_balance();
  if (!options_.plain && !fresh_ && last && advance_clocks(*last, before)) return look_at_due();
  const bool jumped = !options_.plain && !fresh_;
  const double seen = visible_count();
  look_at_all();
  if (!jumped || double(visible_count()) >= k_worth_keeping * seen) return;
  start_over();
  look_at_all();
}

// False when the views do not compare and everything has to be looked at.
bool RoamEngine::advance_clocks(const View& from, const Projection& before) {
  const View& to = *view_;
  if (from.clip_from_eye != to.clip_from_eye || from.viewport != to.viewport) return false;
  const double metres = glm::distance(from.eye, to.eye);
  const double radians = angle_between(from.eye_from_world, to.eye_from_world);
  const double ticks = std::max(metres / double(safe_units_.metres), radians / double(safe_units_.radians));
  tune_units(float(metres), float(radians));
  if (!(ticks < Calendar::k_span) || out_calendar_.old() || leaf_calendar_.old() || diamond_calendar_.old())
    return false;
  out_calendar_.advance(ticks);
  leaf_calendar_.advance(ticks);
  diamond_calendar_.advance(ticks);
  projection_.expect(before, ticks);
  lingering_ticks_ += ticks;
  safe_ticks_ -= ticks;
  if (safe_ticks_ <= 0) {
    safe_ticks_ = Calendar::k_span;
    last_least_units_ = least_units_;
    least_units_ = units_;
  }
  return true;
}

// Units are a share of the largest motions of the last seconds: too large ones would make what holds for less than a
// tick hot, unlike shares would let one kind of motion run the clock for all. Lowering a unit is free; raising one
// takes effect when all older entries are gone: an entry lives for up to k_span ticks, so the least units of the
// present and of the last k_span ticks are kept.
void RoamEngine::tune_units(float metres, float radians) {
  constexpr float k_ticks_a_frame = 5, k_forget = 0.997f, k_lowered = 0.6f, k_raised = 3;
  const auto follow = [&](float& peak, float value, float least, float most, float& unit, float& safe) {
    peak = std::max(value, k_forget * peak);
    const float wanted = std::clamp(peak / k_ticks_a_frame, least, most);
    if (wanted > k_lowered * unit && wanted < k_raised * unit) return;
    unit = wanted;
    safe = std::min(safe, unit);
  };
  follow(peak_metres_, metres, 1e-4f, 1e4f, units_.metres, least_units_.metres);
  follow(peak_radians_, radians, 1e-6f, 0.5f, units_.radians, least_units_.radians);
  safe_units_.metres = std::min(last_least_units_.metres, least_units_.metres);
  safe_units_.radians = std::min(last_least_units_.radians, least_units_.radians);
}

// Back to the root mesh: after a jump it is cheaper to refine from there than to give the old mesh up.
void RoamEngine::start_over() {
  draws_.clear();
  split_queue_.clear();
  merge_queue_.clear();
  blocked_queue_.clear();
  tree_.clear();
  tree_.vertices.rebase(tree_.vertices.origin);
  motions_.clear();
  falling_surplus_ = 0;
  state_.clear();
  wedgie_.clear();
  take_roots();
  restart_claims();
  fresh_ = true;
}

// From the roots down, level by level, so that memory can be fetched ahead. What lies below a node that was out and
// still is has not changed and is not visited.
void RoamEngine::look_at_all() {
  for (Calendar* calendar : {&out_calendar_, &leaf_calendar_, &diamond_calendar_}) calendar->clear();
  forget_clearances();
  hot_leaves_.clear();
  hot_diamonds_.clear();
  hot_outs_.clear();
  hot_mark_ ^= 3;
  leaf_guard_ = 0;
  diamond_guard_ = RoamMesh::k_artificial_max;
  safe_units_ = least_units_ = last_least_units_ = units_;
  safe_ticks_ = Calendar::k_span;
  begin_lingering();
  lingered_.clear();
  visits_.clear();
  for (uint32_t root = 0; root < tree_.root_count(); ++root) visits_.push_back({root, 0});
  for (size_t i = 0; i < visits_.size(); ++i) {
    prefetch_nodes(i);
    const Visit visit = visits_[i];
    const bool was_out = !is_visible(visit.node);
    look(visit.node, visit.inherited);
    if ((was_out && !is_visible(visit.node) && !fresh_) || tree_.is_leaf(visit.node)) continue;
    const CullFlags cull = CullFlags(state_[visit.node].cull & ~k_falling);
    visits_.push_back({tree_.child[visit.node], cull});
    visits_.push_back({tree_.child[visit.node] + 1, cull});
  }
  from_nothing_ |= fresh_;
  fresh_ = false;
}

void RoamEngine::prefetch_node(uint32_t node) const {
  __builtin_prefetch(&state_[node]);
  __builtin_prefetch(&tree_.child[node]);
  __builtin_prefetch(options_.plain ? static_cast<const void*>(&tree_.corner[node]) : &wedgie_[node]);
}

// The node's own data must be near by now.
void RoamEngine::prefetch_corners(uint32_t node) const {
  const Corners& c = tree_.corner[node];
  for (const uint32_t vertex : {c.apex, c.left, c.right}) __builtin_prefetch(&seen_[vertex]);
}

void RoamEngine::prefetch_nodes(size_t place) const {
  constexpr size_t k_nodes_ahead = 24, k_vertices_ahead = 12;
  if (place + k_nodes_ahead < visits_.size()) prefetch_node(visits_[place + k_nodes_ahead].node);
  if (options_.plain && place + k_vertices_ahead < visits_.size())
    prefetch_corners(visits_[place + k_vertices_ahead].node);
}

void RoamEngine::look(uint32_t node, CullFlags inherited) {
  if (options_.plain) return look_plainly(node, inherited);
  if (inherited & k_out) {
    ++stats_.looked_at;
    mark_out(node);
  } else {
    take_reading(node, read(node));
  }
  // The other half may still have the last view's flags; its own visit then places the diamond again.
  if (tree_.is_split(node)) refresh_diamond(node);
}

// Of a node of which nothing is known yet for this view.
void RoamEngine::take_reading(uint32_t node, const Reading& reading) {
  ++stats_.looked_at;
  if (reading.out()) {
    mark_out(node);
    watch_out(node, reading);
    return;
  }
  NodeState& s = state_[node];
  s.cull = CullFlags(s.cull & k_falling);
  wedgie_[node].due = 0;
  if (tree_.is_leaf(node)) show(node);
  if (acts_as_leaf(node)) place(node, reading);
}

void RoamEngine::look_plainly(uint32_t node, CullFlags inherited) {
  ++stats_.looked_at;
  const Assessment now = assess(node, inherited);
  NodeState& s = state_[node];
  if (now.cull & k_out) {
    mark_out(node);
  } else {
    s.cull = now.cull;
    s.priority = now.priority;
    if (tree_.is_leaf(node)) {
      show(node);
      place(node, plain_reading(node));
    }
  }
  if (tree_.is_split(node)) refresh_diamond(node);
}

namespace {

// The nodes that were marked hot for this update, in front of those that have come due.
void gather(std::vector<uint32_t>& hot, uint32_t mark, std::vector<Calendar::Entry>& due) {
  due.clear();
  for (const uint32_t node : hot) due.push_back({node, mark});
  hot.clear();
}

}  // namespace

// What came in first, because it may bring leaves; leaves before diamonds, because they may go out.
void RoamEngine::look_at_due() {
  if (lingering_ticks_ > double(k_most_patience)) {
    // Older entries have been looked at since.
    lingered_.swap(lingering_);
    begin_lingering();
  }
  const uint32_t mark = hot_mark_;
  hot_mark_ ^= 3;
  // All lists first: looking at one kind marks nodes of the others.
  gather(hot_outs_, mark, due_outs_);
  gather(hot_leaves_, mark, due_leaves_);
  gather(hot_diamonds_, mark, due_diamonds_);
  look_at_outs();
  look_at_leaves();
  look_at_diamonds();
}

// Entries may name nodes that a mesh which started over does not have.
void RoamEngine::prefetch_due(const std::vector<Calendar::Entry>& due, size_t place) const {
  constexpr size_t k_ahead = 16;
  if (place + k_ahead >= due.size()) return;
  const uint32_t node = due[place + k_ahead].node;
  if (node < wedgie_.size()) __builtin_prefetch(&wedgie_[node]);
}

// The other halves of diamonds.
void RoamEngine::prefetch_bases(size_t place) const {
  constexpr size_t k_far_ahead = 24, k_ahead = 12;
  const auto base_at = [&](size_t ahead) {
    if (place + ahead >= due_diamonds_.size()) return k_none;
    const uint32_t node = due_diamonds_[place + ahead].node;
    return node < tree_.size() ? tree_.neighbour[node].base : k_none;
  };
  if (place + k_far_ahead < due_diamonds_.size()) {
    const uint32_t node = due_diamonds_[place + k_far_ahead].node;
    if (node < tree_.size()) {
      __builtin_prefetch(&tree_.neighbour[node]);
      __builtin_prefetch(&state_[node]);
    }
  }
  if (const uint32_t base = base_at(k_ahead); base != k_none) {
    __builtin_prefetch(&wedgie_[base]);
    __builtin_prefetch(&state_[base]);
  }
}

// The topmost node of what is out.
void RoamEngine::look_at_out(uint32_t node, const Reading& reading) {
  ++stats_.looked_at;
  if (reading.out()) {
    watch_out(node, reading);
  } else {
    come_in(node);
  }
}

// A visible node that acts as a leaf.
void RoamEngine::look_at_leaf(uint32_t node, const Reading& reading) {
  ++stats_.looked_at;
  if (reading.out() && tree_.is_leaf(node)) {
    go_out(node, reading);
  } else {
    place(node, reading);
  }
}

// Those nodes whose entries are current, four at a time. An entry may cease to be so when its neighbours are looked at.
template <typename Current, typename Look>
void RoamEngine::look_together(const std::vector<Calendar::Entry>& due, Projection::Wanted wanted, Current current,
                               Look look) {
  std::array<uint32_t, Projection::k_together> nodes, ticks;
  std::array<Reading, Projection::k_together> readings;
  size_t count = 0;
  for (size_t i = 0; i < due.size(); ++i) {
    prefetch_due(due, i);
    if (current(due[i].node, due[i].tick)) {
      nodes[count] = due[i].node;
      ticks[count++] = due[i].tick;
    }
    if (count == 0 || (count < nodes.size() && i + 1 < due.size())) continue;
    read({nodes.data(), count}, wanted, readings.data());
    for (size_t k = 0; k < count; ++k)
      if (current(nodes[k], ticks[k])) look(nodes[k], readings[k]);
    count = 0;
  }
}

void RoamEngine::look_at_outs() {
  out_calendar_.take_due(due_outs_);
  look_together(
      due_outs_, Projection::k_outside,
      [this](uint32_t node, uint32_t tick) { return node < wedgie_.size() && wedgie_[node].due == (tick | k_watch); },
      [this](uint32_t node, const Reading& reading) { look_at_out(node, reading); });
  due_outs_.clear();
}

void RoamEngine::look_at_leaves() {
  leaf_calendar_.take_due(due_leaves_);
  look_together(
      due_leaves_, Projection::k_below,
      [this](uint32_t node, uint32_t tick) { return node < wedgie_.size() && wedgie_[node].due == tick; },
      [this](uint32_t node, const Reading& reading) { look_at_leaf(node, reading); });
  due_leaves_.clear();
}

// The halves of some diamonds at once. An entry is void as soon as the diamond cannot be merged.
void RoamEngine::look_at_diamonds() {
  diamond_calendar_.take_due(due_diamonds_);
  std::array<uint32_t, Projection::k_together> halves, diamonds, begins;
  std::array<Reading, Projection::k_together> readings;
  size_t half_count = 0, count = 0;
  const auto flush = [&] {
    if (half_count > 0) read({halves.data(), half_count}, Projection::k_above, readings.data());
    for (size_t k = 0; k < count; ++k) {
      const size_t end = k + 1 < count ? begins[k + 1] : half_count;
      const auto key = defer_diamond(diamonds[k], {readings.data() + begins[k], end - begins[k]});
      if (key) queue_diamond(diamonds[k], *key);
    }
    half_count = count = 0;
  };
  for (size_t i = 0; i < due_diamonds_.size(); ++i) {
    prefetch_due(due_diamonds_, i);
    prefetch_bases(i);
    const auto [node, tick] = due_diamonds_[i];
    if (node >= wedgie_.size() || wedgie_[node].diamond_due != tick) continue;
    wedgie_[node].diamond_due = 0;
    stats_.looked_at += 2;
    const Halves in_sight = halves_in_sight(node);
    if (half_count + in_sight.count > halves.size() || count == diamonds.size()) flush();
    diamonds[count] = node;
    begins[count++] = uint32_t(half_count);
    for (size_t k = 0; k < in_sight.count; ++k) halves[half_count++] = in_sight.node[k];
  }
  flush();
  due_diamonds_.clear();
}

// Once the view is still, what lingers at the edges of sight goes. What stays is noted again: it may go later.
void RoamEngine::look_at_lingering() {
  lingered_.insert(lingered_.end(), lingering_.begin(), lingering_.end());
  begin_lingering();
  for (const uint32_t node : lingered_) {
    if (node >= tree_.size() || !tree_.is_alive(node)) continue;
    if (tree_.is_split(node)) {
      refresh_diamond(node);
    } else if (is_visible(node) && !in_falling(node)) {
      const Reading reading = read(node);
      if (!reading.out()) {
        note_lingering(node);
      } else {
        go_out(node, reading);
      }
    }
  }
  lingered_.clear();
}

// Steps double within an update, so that a mesh with room to spare is reached in few of them.
void RoamEngine::lower_leaf_guard() {
  const double ticks = double(k_first_guard_ticks) * std::exp2(double(leaf_guard_steps_++));
  const float lowest = target_priority();
  const bool all = leaf_calendar_.empty() || ticks >= Calendar::k_span;
  leaf_guard_ = all ? lowest : std::max(lowest, leaf_guard_ * float(std::exp(-ticks * double(safe_units_.log_guard))));
  leaf_calendar_.advance(all ? 2.0 * Calendar::k_span : ticks);
  look_at_leaves();
}

void RoamEngine::raise_diamond_guard(float limit) {
  const double ticks = double(k_first_guard_ticks) * std::exp2(double(diamond_guard_steps_++));
  const bool all = diamond_calendar_.empty() || ticks >= Calendar::k_span;
  diamond_guard_ =
      all ? limit : std::min(limit, diamond_guard_ * float(std::exp(ticks * double(safe_units_.log_guard))));
  diamond_calendar_.advance(all ? 2.0 * Calendar::k_span : ticks);
  look_at_diamonds();
}

// Keeps the guards at either side of the balance that the last update found, in steps that let little come due at once.
void RoamEngine::follow_balance() {
  if (options_.plain || !balanced_) return;
  const uint32_t worst = split_queue_.highest(state_);
  const float highest = worst == k_none ? 0 : state_[worst].key;
  const float now = std::max(highest, target_priority());
  if (!(now > 0) || now >= RoamMesh::k_artificial_max) return;
  balance_ = now;
  const float step = k_guard_ticks_a_frame * units_.log_guard;
  float leaf = leaf_guard_;
  if (leaf > k_leaf_highest * now) {
    leaf = 0.5f * (k_leaf_highest + k_leaf_place) * now;
  } else if (leaf > k_leaf_place * now) {
    leaf = std::max(k_leaf_place * now, leaf * (1 - step));
  } else if (leaf < k_leaf_lowest * now) {
    leaf = k_leaf_place * now;
  }
  if (leaf < leaf_guard_)
    leaf_calendar_.advance(std::log(double(leaf_guard_) / double(leaf)) / double(safe_units_.log_guard));
  leaf_guard_ = leaf;
  float diamond = diamond_guard_;
  if (diamond < k_diamond_lowest * now) {
    diamond = 0.5f * (k_diamond_lowest + k_diamond_place) * now;
  } else if (diamond < k_diamond_place * now) {
    diamond = std::min(k_diamond_place * now, diamond * (1 + step));
  } else if (diamond > k_diamond_highest * now) {
    diamond = k_diamond_place * now;
  }
  if (diamond > diamond_guard_)
    diamond_calendar_.advance(std::log(double(diamond) / double(diamond_guard_)) / double(safe_units_.log_guard));
  diamond_guard_ = diamond;
}

}  // namespace sward::roam
