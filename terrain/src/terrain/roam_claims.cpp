// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Priorities that a host adds (Duchaineau et al., "ROAMing Terrain", 1997, sections 6.3 and 6.4). Departures:
// - A point counts only while the bound of the triangle over it is above its tolerance, and a line counts a wedgie as
//   crossed only where the line is neither wholly above nor wholly below it: then the triangle's plane answers as the
//   finest surface does, and refining it gains nothing.
// - What is demanded does not morph. By the argument in roam_morph.cpp a moving surface stays within the bound of the
//   coarsest triangle whose corners rest; as no centre of a held node moves, that triangle is not held, so its bound is
//   what the point or the line allows.
#include "roam_claims.h"

#include <algorithm>
#include <cmath>

#include "roam_engine.h"

namespace sward::roam {

namespace {

// Weights of corners this far below 0 are still in the triangle: rounding, against gaps between neighbours.
constexpr double k_rim = 1e-9;
// Depth that lines of sight forgive, as in TerrainQueries.
constexpr double k_on_ground = 1e-6;

// Weights of the left and the right corner: lattice triangles have equal legs at a right angle.
glm::dvec2 weights(const TriangleCorners& c, glm::dvec2 p) {
  const glm::dvec2 left(c.left - c.apex), right(c.right - c.apex), at = p - glm::dvec2(c.apex);
  return glm::dvec2(glm::dot(at, left), glm::dot(at, right)) / glm::dot(left, left);
}

bool contains(const TriangleCorners& c, glm::dvec2 p) {
  const glm::dvec2 w = weights(c, p);
  return w.x >= -k_rim && w.y >= -k_rim && w.x + w.y <= 1 + k_rim;
}

// A part of a line, as shares of its length; empty when it ends before it begins.
struct Part {
  double begin = 0, end = 1;

  bool empty() const { return !(begin <= end); }
  // Keeps where a function that is linear along the line is not negative.
  void keep(double at_from, double at_to) {
    if (at_from < 0 && at_to < 0) {
      end = begin - 1;
    } else if (at_from < 0) {
      begin = std::max(begin, at_from / (at_from - at_to));
    } else if (at_to < 0) {
      end = std::min(end, at_from / (at_from - at_to));
    }
  }
};

// Least and largest height of a line over a triangle's plane.
struct Clearance {
  bool over = false;
  double least = 0, most = 0;

  // Neither wholly above nor wholly below plane +- bound.
  bool crosses(double bound, double margin = 0) const {
    return over && least < bound - k_on_ground - margin && most >= -bound - k_on_ground + margin;
  }
};

template <class Line>
Clearance clearance(const RoamTree& tree, const Line& line, uint32_t node) {
  const TriangleCorners corners = tree.corners(node);
  const glm::dvec2 from = weights(corners, line.from), to = weights(corners, line.to);
  Part part;
  part.keep(from.x + k_rim, to.x + k_rim);
  part.keep(from.y + k_rim, to.y + k_rim);
  part.keep(1 + k_rim - from.x - from.y, 1 + k_rim - to.x - to.y);
  if (part.empty()) return {};
  const Corners& c = tree.corner[node];
  const double apex = tree.vertices.points[c.apex].world.z, to_left = tree.vertices.points[c.left].world.z - apex,
               to_right = tree.vertices.points[c.right].world.z - apex;
  const auto above = [&](double share) {
    const glm::dvec2 w = weights(corners, glm::mix(line.from, line.to, share));
    return line.from_z + share * (line.to_z - line.from_z) - (apex + w.x * to_left + w.y * to_right);
  };
  const double begin = above(part.begin), end = above(part.end);
  return {true, std::min(begin, end), std::max(begin, end)};
}

uint32_t other_unless_drawable(const RoamTree& tree, uint32_t node) {
  return tree.nodes[node].cover == Cover::padding ? node ^ 1 : node;
}

// Where the point lies on an edge either will do, unless that one is padding.
uint32_t root_over(const RoamTree& tree, glm::dvec2 p) {
  const glm::ivec2 squares = tree.lattice().root_squares;
  const glm::ivec2 square = glm::min(glm::ivec2(p / double(k_root_side)), squares - 1);
  const glm::dvec2 place = p - glm::dvec2(square * k_root_side);
  const uint32_t first = 2 * uint32_t(square.y * squares.x + square.x);
  return other_unless_drawable(tree, first + (place.x + place.y <= double(k_root_side) ? 0 : 1));
}

uint32_t child_over(const RoamTree& tree, uint32_t node, glm::dvec2 p) {
  const glm::dvec2 w = weights(tree.corners(node), p);
  return other_unless_drawable(tree, tree.child[node] + (w.x >= w.y ? 0 : 1));
}

}  // namespace

void Claims::attach(const HostPriorities* priorities) {
  priorities_ = priorities;
  attached_anew_ = true;
}

bool Claims::follow(const RoamTree& tree) {
  const bool anew = attached_anew_;
  if (anew) {
    for (uint32_t claim = 0; claim < claims_.size(); ++claim) unlink_all(claim);
    claims_.clear();
    seen_revision_ = 0;
    attached_anew_ = false;
  }
  if (!priorities_ || priorities_->revision_ == seen_revision_) return anew;
  const auto& slots = priorities_->slots_;
  claims_.resize(slots.size());
  for (uint32_t slot = priorities_->newest_; slot != k_none; slot = slots[slot].older) {
    if (slots[slot].revision <= seen_revision_) break;
    take(tree, slot, slots[slot].place);
  }
  seen_revision_ = priorities_->revision_;
  return true;
}

void Claims::take(const RoamTree& tree, uint32_t claim, const HostPriorities::Place& place) {
  Claim& c = claims_[claim];
  if (c.place.kind != Kind::point || place.kind != Kind::point) unlink_all(claim);
  c.place = place;
  if (place.kind == Kind::line) {
    Part part;
    const glm::dvec2 last(tree.lattice().last());
    for (int i = 0; i < 2; ++i) {
      part.keep(place.from[i], place.to[i]);
      part.keep(last[i] - place.from[i], last[i] - place.to[i]);
    }
    if (part.empty()) {
      c.place.kind = Kind::none;
      return;
    }
    c.place.from = glm::mix(place.from, place.to, part.begin);
    c.place.to = glm::mix(place.from, place.to, part.end);
    c.place.from_z = glm::mix(place.from_z, place.to_z, part.begin);
    c.place.to_z = glm::mix(place.from_z, place.to_z, part.end);
  }
  find(tree, claim);
}

void Claims::renew(const RoamTree& tree) {
  for (uint32_t claim = 0; claim < claims_.size(); ++claim) {
    if (claims_[claim].place.kind == Kind::line) unlink_all(claim);
    find(tree, claim);
  }
}

void Claims::restart(const RoamTree& tree) {
  links_.clear();
  free_.clear();
  first_.clear();
  touched_.clear();
  for (uint32_t claim = 0; claim < claims_.size(); ++claim) {
    claims_[claim].first = k_none;
    find(tree, claim);
  }
}

void Claims::find(const RoamTree& tree, uint32_t claim) {
  if (claims_[claim].place.kind == Kind::point) find_point(tree, claim);
  if (claims_[claim].place.kind == Kind::line) find_line(tree, claim);
}

// Up the old chain to where it holds, and down from there.
void Claims::find_point(const RoamTree& tree, uint32_t claim) {
  const Claim& c = claims_[claim];
  while (c.first != k_none && !wants(tree, c, links_[c.first].node)) unlink(c.first);
  uint32_t node;
  if (c.first == k_none) {
    node = root_over(tree, c.place.from);
    if (!wants(tree, c, node)) return;
    link(claim, node);
  } else {
    node = links_[c.first].node;
  }
  while (tree.is_split(node)) {
    node = child_over(tree, node, c.place.from);
    if (!wants(tree, c, node)) return;
    link(claim, node);
  }
}

// Through the root squares that the line may touch, row by row.
void Claims::find_line(const RoamTree& tree, uint32_t claim) {
  const HostPriorities::Place line = claims_[claim].place;
  const glm::ivec2 squares = tree.lattice().root_squares;
  const auto square_at = [](double place, int count) {
    return std::clamp(int(std::floor(place / double(k_root_side))), 0, count - 1);
  };
  const int first_row = square_at(std::min(line.from.y, line.to.y) - 1, squares.y);
  const int last_row = square_at(std::max(line.from.y, line.to.y) + 1, squares.y);
  for (int row = first_row; row <= last_row; ++row) {
    Part part;
    const double top = double(row) * k_root_side - 1, low = double(row + 1) * k_root_side + 1;
    part.keep(line.from.y - top, line.to.y - top);
    part.keep(low - line.from.y, low - line.to.y);
    if (part.empty()) continue;
    const double a = glm::mix(line.from.x, line.to.x, part.begin), b = glm::mix(line.from.x, line.to.x, part.end);
    const int last_column = square_at(std::max(a, b) + 1, squares.x);
    for (int column = square_at(std::min(a, b) - 1, squares.x); column <= last_column; ++column) {
      const auto first = uint32_t(2 * (row * squares.x + column));
      descend(tree, claim, first);
      descend(tree, claim, first + 1);
    }
  }
}

void Claims::descend(const RoamTree& tree, uint32_t claim, uint32_t node) {
  if (!wants(tree, claims_[claim], node)) return;
  link(claim, node);
  if (!tree.is_split(node)) return;
  descend(tree, claim, tree.child[node]);
  descend(tree, claim, tree.child[node] + 1);
}

bool Claims::wants(const RoamTree& tree, const Claim& claim, uint32_t node) const {
  const double bound = double(tree.corner[node].bound);
  if (!(bound > 0)) return false;
  if (claim.place.kind == Kind::line) return clearance(tree, claim.place, node).crosses(bound);
  return bound > claim.place.tolerance && contains(tree.corners(node), claim.place.from);
}

void Claims::ask(const RoamTree& tree, uint32_t child) {
  const uint32_t parent = tree.nodes[child].parent;
  for (uint32_t i = first_[parent]; i != k_none; i = links_[i].node_next) {
    const uint32_t claim = links_[i].claim;
    const Claim& c = claims_[claim];
    if (c.place.kind == Kind::point && child_over(tree, parent, c.place.from) != child) continue;
    if (wants(tree, c, child)) link(claim, child);
  }
}

void Claims::forget(uint32_t node) {
  while (holds(node)) unlink(first_[node]);
}

void Claims::link(uint32_t claim, uint32_t node) {
  if (node >= first_.size()) first_.resize(std::max<size_t>(node + 1, first_.size() + first_.size() / 2), k_none);
  uint32_t place = uint32_t(links_.size());
  if (free_.empty()) {
    links_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  if (first_[node] == k_none) touched_.push_back(node);
  uint32_t& of_node = first_[node];
  uint32_t& of_claim = claims_[claim].first;
  links_[place] = {node, claim, k_none, of_node, k_none, of_claim};
  if (of_node != k_none) links_[of_node].node_previous = place;
  if (of_claim != k_none) links_[of_claim].claim_previous = place;
  of_node = of_claim = place;
}

void Claims::unlink(uint32_t place) {
  const Link l = links_[place];
  (l.node_previous == k_none ? first_[l.node] : links_[l.node_previous].node_next) = l.node_next;
  if (l.node_next != k_none) links_[l.node_next].node_previous = l.node_previous;
  (l.claim_previous == k_none ? claims_[l.claim].first : links_[l.claim_previous].claim_next) = l.claim_next;
  if (l.claim_next != k_none) links_[l.claim_next].claim_previous = l.claim_previous;
  free_.push_back(place);
  if (first_[l.node] == k_none) touched_.push_back(l.node);
}

void Claims::unlink_all(uint32_t claim) {
  while (claims_[claim].first != k_none) unlink(claims_[claim].first);
}

bool Claims::linked(uint32_t claim, uint32_t node) const {
  if (!holds(node)) return false;
  for (uint32_t i = first_[node]; i != k_none; i = links_[i].node_next)
    if (links_[i].claim == claim) return true;
  return false;
}

std::string Claims::fault(const RoamTree& tree) const {
  constexpr double k_margin = 1e-5;  // metres; nearer than that to the wedgie either answer will do
  size_t links = 0;
  for (uint32_t claim = 0; claim < claims_.size(); ++claim) {
    const Claim& c = claims_[claim];
    const std::string name = "the named thing " + std::to_string(claim);
    for (uint32_t node = 0; node < tree.size(); ++node) {
      const bool held = linked(claim, node);
      links += held;
      if (!tree.is_alive(node)) {
        if (held) return name + " holds a dead node";
        continue;
      }
      const double bound = double(tree.corner[node].bound);
      const uint32_t parent = tree.nodes[node].parent;
      if (held && parent != k_none && !linked(claim, parent)) return name + " holds a node and not its parent";
      if (c.place.kind == Kind::line) {
        const Clearance clear = clearance(tree, c.place, node);
        if (held && !(bound > 0 && clear.crosses(bound, -k_margin))) return name + " holds what it does not cross";
        if (!held && bound > 0 && clear.crosses(bound, k_margin)) return name + " does not hold what it crosses";
      } else if (held && !(c.place.kind == Kind::point && wants(tree, c, node))) {
        return name + " holds a node without reason";
      }
    }
    if (c.place.kind != Kind::point) continue;
    const bool none = c.first == k_none;
    const uint32_t deepest = none ? k_none : links_[c.first].node;
    if (!none && tree.is_leaf(deepest)) continue;
    const uint32_t next = none ? root_over(tree, c.place.from) : child_over(tree, deepest, c.place.from);
    if (wants(tree, c, next)) return name + " does not hold the triangle over it";
  }
  return links == links_.size() - free_.size() ? "" : "links are kept of what is not there";
}

// Engine.

void RoamEngine::follow_claims(bool surface_changed) {
  const bool followed = claims_.follow(tree_);
  if (surface_changed) claims_.renew(tree_);
  if (!followed && !surface_changed) return;
  if (look_at_claimed()) {
    settled_ = false;
    still_since_ = tree_.vertices.now;
  }
}

// The marks first: reading a node may read others.
bool RoamEngine::look_at_claimed() {
  visits_.clear();
  for (const uint32_t node : claims_.touched()) {
    if (!tree_.is_alive(node) || wedgie_[node].claimed == claims_.holds(node)) continue;
    wedgie_[node].claimed = claims_.holds(node);
    visits_.push_back({node, 0});
  }
  claims_.touched().clear();
  for (const Visit& visit : visits_)
    if (wedgie_[visit.node].claimed && tree_.is_split(visit.node)) stand(visit.node);
  for (const Visit& visit : visits_) {
    ++stats_.looked_at;
    if (is_visible(visit.node)) look_again(visit.node);
  }
  return !visits_.empty();
}

void RoamEngine::restart_claims() {
  if (claims_.empty()) return;
  claims_.restart(tree_);
  for (const uint32_t node : claims_.touched()) wedgie_[node].claimed = true;
  claims_.touched().clear();
}

void RoamEngine::claim_child(uint32_t child) {
  claims_.ask(tree_, child);
  claims_.touched().clear();
  wedgie_[child].claimed = claims_.holds(child);
}

bool RoamEngine::diamond_claimed(uint32_t node) const {
  const uint32_t base = tree_.neighbour[node].base;
  return wedgie_[node].claimed || (base != k_none && wedgie_[base].claimed);
}

// The centre of the node's diamond stops moving and stands at its height.
void RoamEngine::stand(uint32_t node) {
  if (!centre_moves(node)) return;
  if (state_[node].cull & k_falling) stop_fall(node);
  stand_still(node);
}

// Triangles on their way out make room at once for what is claimed; false when they do not.
bool RoamEngine::end_falls_for(uint32_t leaf) {
  const uint32_t before = visible_count();
  if (!wedgie_[leaf].claimed || before == 0) return false;
  const auto wanted = uint32_t(2 * tree_.forced_chain(leaf).length);
  finish_falls_now(options_.max_triangles - std::min(wanted, options_.max_triangles));
  return visible_count() < before;
}

// What rises cannot be merged before it stands: where nothing else can be given up for what is claimed, it stands now.
bool RoamEngine::end_rises_for(uint32_t leaf) {
  if (!wedgie_[leaf].claimed) return false;
  const size_t before = motions_.size();
  finish_motions_now();
  return motions_.size() < before;
}

uint32_t RoamEngine::unmet_claims() const {
  if (claims_.empty()) return 0;
  uint32_t count = 0;
  for (const BucketQueue* queue : {&split_queue_, &blocked_queue_})
    queue->for_each(state_, BucketQueue::bucket_of(RoamMesh::k_artificial_max),
                    [&](uint32_t node) { count += wedgie_[node].claimed; });
  return count;
}

// The largest key, that of what is claimed taken for what its wedgie measures on screen.
float RoamEngine::bound_of(const BucketQueue& queue) const {
  const uint32_t highest = queue.highest(state_);
  if (highest == k_none) return 0;
  const float key = state_[highest].key;
  if (key < RoamMesh::k_artificial_max || claims_.empty()) return key;
  const uint32_t bucket = BucketQueue::bucket_of(RoamMesh::k_artificial_max);
  float worst = 0;
  queue.for_each(state_, bucket, [&](uint32_t node) {
    worst = std::max(worst, wedgie_[node].claimed ? measure(node).priority : state_[node].key);
  });
  const uint32_t next = queue.highest_below(state_, bucket);
  return next == k_none ? worst : std::max(worst, state_[next].key);
}

}  // namespace sward::roam
