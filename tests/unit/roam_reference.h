// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/terrain.h>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <unordered_map>
#include <vector>

// What the tests of the mesh compare it with, written from the definitions and sharing no code with it: a top-down
// greedy mesh, and a check of edges.
namespace roam_reference {

using sward::LatticePoint;

struct Triangle {
  LatticePoint apex{0}, left{0}, right{0};
  int level = 0;
  LatticePoint middle() const { return (left + right) / 2; }
  Triangle child(int turn) const {
    return turn == 0 ? Triangle{middle(), apex, left, level + 1} : Triangle{middle(), right, apex, level + 1};
  }
};

/// How far triangles of a priority (the thickness of their wedgies) may be from the surface, which is at one side of
/// them: the share depends on how far off screen verticals vanish.
inline double error_of(const sward::View& view, double priority) {
  if (priority >= double(sward::RoamMesh::k_artificial_max)) return priority;
  const glm::dvec4 up = view.clip_from_relative() * glm::dvec4(0, 0, 1, 0);
  if (up.w == 0) return priority / 2;
  const glm::dvec2 half = 0.5 * glm::dvec2(view.viewport), vanishing = half * glm::dvec2(up) / up.w;
  const double off = glm::distance(vanishing, glm::clamp(vanishing, -half, half));
  return priority < off ? priority / (2 - priority / off) : priority;
}

/// Starts from the roots and splits the worst visible triangle for as long as the budget allows. Triangles are found by
/// their diamond's centre: the other half of a diamond is its mirror image in the base, and where that does not exist
/// yet, the leaf on that side has the mirror image's apex for a centre.
class GreedyMesh {
 public:
  GreedyMesh(const sward::Bounds& bounds, const sward::View& view)
      : bounds_(bounds), field_(bounds.field()), view_(view), planes_(sward::frustum_planes(view)) {
    const glm::ivec2 squares = field_.root_squares();
    for (int row = 0; row < squares.y; ++row) {
      for (int column = 0; column < squares.x; ++column) {
        const LatticePoint nw = LatticePoint(column, row) * sward::k_root_side, se = nw + sward::k_root_side;
        const LatticePoint ne(se.x, nw.y), sw(nw.x, se.y);
        add({nw, sw, ne, 0}, true);
        add({se, ne, sw, 0}, true);
      }
    }
  }

  /// Refines to the budget or the target. Returns the bound in pixels.
  double refine(uint32_t budget, double target_px) {
    for (;;) {
      while (!queue_.empty() && !is_leaf(queue_.top())) queue_.pop();
      if (queue_.empty()) return 0;
      const Entry worst = queue_.top();
      if (worst.priority <= target_px) return worst.priority;
      visible_before_ = visible_;
      split(worst.triangle.middle());
      if (visible_ > budget) return worst.priority;
    }
  }

  /// Visible triangles before the last split of refine().
  uint32_t visible() const { return visible_before_; }

 private:
  struct Leaf {
    Triangle triangle;
    bool visible = false;
  };
  struct Entry {
    double priority;
    Triangle triangle;
    bool operator<(const Entry& other) const { return priority < other.priority; }
  };

  static uint64_t key(LatticePoint p) { return uint64_t(uint32_t(p.x)) << 32 | uint32_t(p.y); }

  bool is_leaf(const Entry& entry) const {
    const auto found = leaves_.find(key(entry.triangle.middle()));
    if (found == leaves_.end()) return false;
    return std::any_of(found->second.begin(), found->second.end(),
                       [&](const Leaf& leaf) { return leaf.triangle.apex == entry.triangle.apex; });
  }

  // A child of what is out of sight is out of sight.
  void add(const Triangle& triangle, bool parent_visible) {
    Leaf leaf{triangle, false};
    const double bound = bounds_.bound(triangle.middle(), triangle.level);
    leaf.visible = parent_visible && sees(triangle, bound);
    visible_ += leaf.visible;
    if (leaf.visible) queue_.push({priority(triangle, bound), triangle});
    leaves_[key(triangle.middle())].push_back(leaf);
  }

  void split(LatticePoint centre) {
    const std::vector<Leaf> halves = leaves_.at(key(centre));
    if (halves.size() == 1 && !on_border(centre)) {
      const Triangle& t = halves[0].triangle;
      split(t.left + t.right - t.apex);
      return split(centre);
    }
    leaves_.erase(key(centre));
    for (const Leaf& half : halves) {
      visible_ -= half.visible;
      add(half.triangle.child(0), half.visible);
      add(half.triangle.child(1), half.visible);
    }
  }

  bool on_border(LatticePoint p) const {
    const LatticePoint far = field_.root_squares() * sward::k_root_side;
    return p.x == 0 || p.y == 0 || p.x == far.x || p.y == far.y;
  }

  glm::dvec3 relative(LatticePoint p) const { return glm::dvec3(field_.world_xy(p), field_.height(p)) - view_.eye; }

  bool sees(const Triangle& t, double bound) const {
    for (const sward::Plane& plane : planes_) {
      double most = -std::numeric_limits<double>::infinity();
      for (const LatticePoint p : {t.apex, t.left, t.right}) {
        for (const double up : {-bound, bound})
          most = std::max(most, glm::dot(plane.n, relative(p) + glm::dvec3(0, 0, up)) + plane.d);
      }
      if (most < 0) return false;
    }
    return true;
  }

  // In camera coordinates (p, q, r), r ahead, with thickness vector (a, b, c).
  double priority(const Triangle& t, double bound) const {
    if (bound == 0) return 0;
    const glm::dvec2 focal = view_.focal_px();
    const glm::dvec3 flip(1, 1, -1);
    const glm::dvec3 thick = flip * (view_.eye_from_world * glm::dvec3(0, 0, bound));
    double numerator = 0, nearest = std::numeric_limits<double>::infinity();
    for (const LatticePoint point : {t.apex, t.left, t.right}) {
      const glm::dvec3 c = flip * (view_.eye_from_world * relative(point));
      nearest = std::min(nearest, c.z);
      const glm::dvec2 n = view_.perspective()
                               ? glm::dvec2(thick.x * c.z - thick.z * c.x, thick.y * c.z - thick.z * c.y)
                               : glm::dvec2(thick);
      numerator = std::max(numerator, glm::length(focal * n));
    }
    if (nearest - std::abs(thick.z) < view_.near_distance()) return sward::RoamMesh::k_artificial_max;
    const double denominator = view_.perspective() ? nearest * nearest - thick.z * thick.z : 1.0;
    return std::min(2 * numerator / denominator, double(sward::RoamMesh::k_artificial_max));
  }

  const sward::Bounds& bounds_;
  const sward::HeightField& field_;
  const sward::View& view_;
  std::array<sward::Plane, 6> planes_;
  std::unordered_map<uint64_t, std::vector<Leaf>> leaves_;  // by the centre of their diamond
  std::priority_queue<Entry> queue_;
  uint32_t visible_ = 0, visible_before_ = 0;
};

/// Every inner edge must be run through once in each direction. Reused from mesh to mesh.
class EdgeCheck {
 public:
  /// Number of edges that lie inside the data and do not occur exactly once each way.
  int faults(const sward::RoamMesh& mesh, const sward::HeightField& field) {
    const std::vector<uint32_t> indices = mesh.all_indices();
    begin(indices.size());
    int count = 0;
    for_edges(indices, [&](uint32_t from, uint32_t to) { count += !insert(from, to); });
    for_edges(indices, [&](uint32_t from, uint32_t to) {
      if (!contains(to, from)) count += crosses_data(mesh.vertex_world(from), mesh.vertex_world(to), field);
    });
    return count;
  }

 private:
  template <class Visit>
  static void for_edges(const std::vector<uint32_t>& indices, Visit&& visit) {
    for (size_t i = 0; i < indices.size(); i += 3) {
      visit(indices[i], indices[i + 1]);
      visit(indices[i + 1], indices[i + 2]);
      visit(indices[i + 2], indices[i]);
    }
  }

  static bool crosses_data(glm::dvec2 a, glm::dvec2 b, const sward::HeightField& field) {
    const glm::dvec2 low = field.min_corner(), high = field.max_corner();
    for (int i = 0; i <= 8; ++i) {
      const glm::dvec2 p = a + (b - a) * (i / 8.0);
      const double e = 1e-6;
      if (p.x > low.x + e && p.y > low.y + e && p.x < high.x - e && p.y < high.y - e) return true;
    }
    return false;
  }

  void begin(size_t edges) {
    size_t size = 64;
    while (size < 2 * edges) size *= 2;
    if (slots_.size() < size) {
      slots_.assign(size, 0);
      stamps_.assign(size, 0);
    }
    ++stamp_;
  }

  size_t find(uint64_t key) const {
    const size_t mask = slots_.size() - 1;
    size_t i = size_t((key * 0x9E3779B97F4A7C15u) >> 20) & mask;
    while (stamps_[i] == stamp_ && slots_[i] != key) i = (i + 1) & mask;
    return i;
  }

  bool insert(uint32_t from, uint32_t to) {
    const uint64_t key = uint64_t(from) << 32 | to;
    const size_t i = find(key);
    if (stamps_[i] == stamp_) return false;
    stamps_[i] = stamp_;
    slots_[i] = key;
    return true;
  }

  bool contains(uint32_t from, uint32_t to) const { return stamps_[find(uint64_t(from) << 32 | to)] == stamp_; }

  std::vector<uint64_t> slots_;
  std::vector<uint32_t> stamps_;
  uint32_t stamp_ = 0;
};

}  // namespace roam_reference
