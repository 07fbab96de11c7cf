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
#include <limits>
#include <span>

#include "roam_calendar.h"
#include "roam_lanes.h"
#include "roam_queue.h"

namespace sward::roam {

inline constexpr CullFlags k_in_near = 1 << 4;
inline constexpr unsigned k_all_halfspaces = 0x3f;

/// Culling flags and priority of a wedgie.
struct Assessment {
  CullFlags cull = k_out;
  float priority = -1;  ///< Pixels; -1 when out.
};

/// What a view makes of a wedgie.
struct Reading {
  float bound = 0;      ///< Metres.
  float outside = -1;   ///< Least over the halfspaces of the largest distance; out when negative. Metres.
  float priority = -1;  ///< Pixels; -1 when out.
  // How many ticks this surely lasts:
  float below = 0;   ///< that the priority is at most the leaves' guard, while that may fall; 0 when it is not;
  float above = 0;   ///< that the priority is at least the diamonds' guard, while that may rise; 0 when it is not;
  float side = 0;    ///< that the wedgie is out, or that it is not.
  float leaves = 0;  ///< In how many ticks it is going to be out if the view moves as expected.

  bool out() const { return outside < 0; }
};

/// Set in the tick at which a node that is out is looked at.
inline constexpr uint32_t k_watch = 0x80000000u;

/// All that a deferred look at a node reads, in one cache line: where its wedgie is, and until when what was found out
/// about it holds.
struct alignas(64) Wedgie {
  glm::dvec3 apex{0};                 ///< World.
  glm::vec3 to_left{0}, to_right{0};  ///< From the apex, metres.
  float bound = -1;                   ///< Metres; negative in the padding.
  uint32_t due = 0;                   ///< Tick or mark at which the node is looked at again; 0: no such time.
  uint32_t diamond_due = 0;           ///< The same for the diamond that the node stands for.
  uint32_t lingers : 31 = 0;          ///< The list of what lingers that the node was noted in last.
  uint32_t claimed : 1 = 0;           ///< A named thing wants it split: in sight its priority is the artificial one.

  void place(glm::dvec3 a, glm::dvec3 left, glm::dvec3 right, float its_bound) {
    apex = a;
    to_left = glm::vec3(left - a);
    to_right = glm::vec3(right - a);
    bound = its_bound;
  }
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

  Forms project(glm::dvec3 world) const { return project(glm::vec3(world - eye_)); }

  /// `bound` in metres, negative for what is never visible; `parent` the parent's flags (0 for a root).
  Assessment assess(const Forms& apex, const Forms& left, const Forms& right, float bound, CullFlags parent) const {
    if (parent & k_out || bound < 0) return {};
    // What the parent is wholly inside of needs no test.
    unsigned inside = parent & k_all_halfspaces;
    for (unsigned rest = k_all_halfspaces & ~inside; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const float reach = bound * reach_[i];
      const float a = apex.side(i), b = left.side(i), c = right.side(i);
      if (std::max(a, std::max(b, c)) + reach < 0) return {};
      inside |= unsigned(std::min(a, std::min(b, c)) - reach >= 0) << i;
    }
    const float nearest = std::min(apex.w(), std::min(left.w(), right.w()));
    return {CullFlags(inside), priority(thickness(apex, left, right), nearest, bound, inside & k_in_near)};
  }

  /// What the ticks of a reading depend on beside the view.
  struct Deferral {
    TickUnits units;
    float leaf_guard = 0, diamond_guard = 0;
  };
  static constexpr size_t k_together = 4;
  /// What of a reading is asked for; the rest is left 0. Nothing of it: `outside` and `side` alone.
  enum Wanted : unsigned { k_outside = 0, k_below = 1, k_above = 2, k_all = 3 };
  /// Up to four wedgies side by side, without parents.
  void read(std::span<const Wedgie* const> wedgies, const Deferral& deferral, Wanted wanted, Reading* readings) const;
  /// Whether up to four wedgies are out: as read() finds it.
  std::array<bool, k_together> out(std::span<const Wedgie* const> wedgies) const;

  /// Motion so far, from the view of `before` within so many ticks: it is expected to go on.
  void expect(const Projection& before, double ticks);

  /// For how many ticks nothing in sight up to `reach` metres above or below the wedgie's triangle crosses the near
  /// plane; negative when something may now.
  float clear_ticks(const Wedgie& wedgie, float reach, const TickUnits& units) const;

  /// The largest distance in pixels between triangles and the surface in their wedgies over all in sight whose priority
  /// is at most `priority`: between a half and all of it, because the triangle lies in the wedgie's middle. The
  /// artificial maximum for that.
  float largest_error(float priority) const;
  /// The largest priority of which largest_error() is at most so many pixels.
  float priority_of(float error) const;
  /// The same distance for a drawn triangle whose corners are up to `offset` metres from where the wedgie has them. The
  /// artificial maximum when it or the surface may cross the near plane; 0 when the wedgie is out.
  float moved_error(const Wedgie& wedgie, float offset) const;

 private:
  struct Four;
  struct Change;
  Four place(std::span<const Wedgie* const> wedgies) const;
  void measure_sides(Four& four) const;
  void measure_thickness(Four& four) const;
  Lanes range(const Four& four) const;
  Lanes priority(const Four& four) const;
  Change change_of(const Four& four, const TickUnits& units) const;
  Lanes below_ticks(const Four& four, const Change& change, Lanes priority, const Deferral& deferral) const;
  Lanes above_ticks(const Change& change, Lanes priority, const Deferral& deferral) const;
  Lanes ticks_to_leave(const Four& four) const;

  Forms project(glm::vec3 p) const {
    Forms out;
    for (int i = 0; i < Forms::k_lanes; ++i)
      out.lane[i] = form_x_.lane[i] * p.x + form_y_.lane[i] * p.y + form_z_.lane[i] * p.z + form_1_.lane[i];
    return out;
  }
  // What single precision does not hold (matrices of 1e30 and the like) counts as the largest.
  static float cap(float pixels) { return pixels < RoamMesh::k_artificial_max ? pixels : RoamMesh::k_artificial_max; }
  static float thickness(const Forms& a, const Forms& b, const Forms& c) {
    return std::sqrt(std::max(a.square(), std::max(b.square(), c.square())));
  }
  float priority(float thickness, float w, float bound, bool inside_near) const {
    if (bound <= 0) return 0;
    const float depth_reach = bound * depth_per_metre_;
    const float denominator = (w - depth_reach) * (w + depth_reach);
    if (!inside_near || w <= depth_reach || denominator <= 0) return RoamMesh::k_artificial_max;
    return cap(2 * bound * thickness / denominator);
  }

  glm::dvec3 eye_{0};
  Forms form_x_{}, form_y_{}, form_z_{}, form_1_{};
  Forms reach_{};              // |n.z| of the halfspaces
  float depth_per_metre_ = 0;  // |C|
  // From the viewport to the point at which verticals vanish.
  double vanishing_px_ = std::numeric_limits<double>::infinity();
  // The same forms, each in all lanes, and the changes of those of the halfspaces a tick, as expected.
  struct Form {
    Lanes x{}, y{}, z{}, one{};
    SWARD_INLINE Lanes at(Lanes px, Lanes py, Lanes pz) const { return x * px + y * py + z * pz + one; }
  };
  std::array<Form, Forms::k_forms> form_{};
  std::array<Form, Forms::k_sides> rate_{};
  // Gradients of x, y and w in the eye's travel, and the axes by which they change when the view turns.
  glm::vec3 x_axis_{0}, y_axis_{0}, w_axis_{0}, x_turn_{0}, y_turn_{0};
  // Limits of change: of (x, y) per metre; per radian in any case; of w per metre.
  float thickness_per_metre_ = 0, thickness_per_radian_ = 0, depth_rate_ = 0;
};

}  // namespace sward::roam
