// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "roam_calendar.h"
#include "roam_queue.h"

namespace sward::roam {

inline constexpr CullFlags k_in_near = 1 << 4;
inline constexpr unsigned k_all_halfspaces = 0x3f;

/// What a view makes of one vertex.
struct Lanes {
  float side[6];  ///< Distances to the halfspaces of frustum_planes(), metres.
  /// Pixels of thickness that 1 m of bound gives, times w squared, halved: the length of this.
  float x, y;
  float w;  ///< The depth ahead of the eye; 1 without perspective.
};

/// Culling flags and priority of a wedgie.
struct Assessment {
  CullFlags cull = k_out;
  float priority = -1;  ///< Pixels; -1 when out.
};

/// What a view makes of a wedgie.
struct Reading {
  float bound = 0;        ///< Metres.
  float outside = -1;     ///< Least over the halfspaces of the largest distance; out when negative. Metres.
  float near_inside = 0;  ///< Least distance to the near plane; negative when the wedgie may cross it.
  float priority = -1;    ///< Pixels; -1 when out.

  bool out() const { return outside < 0; }
};

/// Corners of a triangle for one view, and where they are.
struct Seen {
  const Lanes* lanes[3];
  const glm::dvec3* world[3];
};

/// Projection of vertices and wedgies.
///
/// With clip coordinates (p, q, r) scaled to pixels and the thickness vector e (A, B, C), the image of a metre-thick
/// vertical segment of half length e, the projected thickness at a vertex is (Duchaineau et al. 1997, section 6.2)
///   2 e |(A r - C p, B r - C q)| / (r^2 - (C e)^2).
/// The numerator is convex and the denominator grows with r, so over a triangle the largest numerator and the smallest
/// r of its corners bound it. Moving a vertex along z leaves the numerator as it is; with nested bounds that makes a
/// child's priority never larger than its parent's.
class Projection {
 public:
  Projection() = default;
  explicit Projection(const View& view);

  Lanes project(glm::dvec3 world) const;

  /// `bound` in metres, negative for what is never visible; `parent` the parent's flags (0 for a root).
  Assessment assess(const Lanes& apex, const Lanes& left, const Lanes& right, float bound, CullFlags parent) const {
    if (parent & k_out || bound < 0) return {};
    // What the parent is wholly inside of needs no test.
    unsigned inside = parent & k_all_halfspaces;
    for (unsigned rest = k_all_halfspaces & ~inside; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const float reach = bound * reach_[i];
      const float a = apex.side[i], b = left.side[i], c = right.side[i];
      if (std::max(a, std::max(b, c)) + reach < 0) return {};
      inside |= unsigned(std::min(a, std::min(b, c)) - reach >= 0) << i;
    }
    const float nearest = std::min(apex.w, std::min(left.w, right.w));
    return {CullFlags(inside), priority(thickness(apex, left, right), nearest, bound, inside & k_in_near)};
  }

  /// The same without a parent, with what the ticks below need.
  Reading read(const Lanes& apex, const Lanes& left, const Lanes& right, float bound) const {
    Reading r;
    if (bound < 0) return r;
    r.bound = bound;
    float farthest[6];
    for (int i = 0; i < 6; ++i)
      farthest[i] = std::max(apex.side[i], std::max(left.side[i], right.side[i])) + bound * reach_[i];
    r.outside = std::min(std::min(std::min(farthest[0], farthest[1]), std::min(farthest[2], farthest[3])),
                         std::min(farthest[4], farthest[5]));
    r.near_inside = std::min(apex.side[4], std::min(left.side[4], right.side[4])) - bound * reach_[4];
    if (r.out()) return r;
    const float nearest = std::min(apex.w, std::min(left.w, right.w));
    r.priority = priority(thickness(apex, left, right), nearest, bound, r.near_inside >= 0);
    return r;
  }

  // How many ticks a finding surely lasts. See roam_projection.cpp.

  /// That a wedgie is out, or that it is not.
  float side_ticks(const Seen& seen, const Reading& r, const TickUnits& units) const;
  /// That the priority is at most `guard`, while the guard may fall; 0 when it is not.
  float below_ticks(const Seen& seen, const Reading& r, float guard, const TickUnits& units) const;
  /// That the priority is at least `guard`, while the guard may rise; 0 when it is not.
  float above_ticks(const Seen& seen, const Reading& r, float guard, const TickUnits& units) const;

 private:
  struct Change;
  Change change_of(const Seen& seen, const Reading& r, const TickUnits& units) const;

  static float thickness(const Lanes& a, const Lanes& b, const Lanes& c) {
    return std::sqrt(std::max(a.x * a.x + a.y * a.y, std::max(b.x * b.x + b.y * b.y, c.x * c.x + c.y * c.y)));
  }
  float priority(float thickness, float w, float bound, bool inside_near) const {
    if (bound <= 0) return 0;
    const float depth_reach = bound * depth_per_metre_;
    const float denominator = (w - depth_reach) * (w + depth_reach);
    if (!inside_near || w <= depth_reach || denominator <= 0) return RoamMesh::k_artificial_max;
    return std::min(2 * bound * thickness / denominator, RoamMesh::k_artificial_max);
  }

  static constexpr int k_forms = 12;  // 6 halfspaces, x and y of the numerator, w; the rest pads

  glm::dvec3 eye_{0};
  float form_x_[k_forms] = {}, form_y_[k_forms] = {}, form_z_[k_forms] = {}, form_1_[k_forms] = {};
  std::array<float, 8> reach_{};  // |n.z| of the halfspaces
  float depth_per_metre_ = 0;     // |C|
  // Gradients of x, y and w in the eye's travel, and the axes by which they change when the view turns.
  glm::vec3 x_axis_{0}, y_axis_{0}, w_axis_{0}, x_turn_{0}, y_turn_{0};
  // Limits of change: of (x, y) per metre; per radian in any case; of w per metre.
  float thickness_per_metre_ = 0, thickness_per_radian_ = 0, depth_rate_ = 0;
};

}  // namespace sward::roam
