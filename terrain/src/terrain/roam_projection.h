// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include "roam_queue.h"

namespace sward::roam {

inline constexpr CullFlags k_in_near = 1 << 4;
inline constexpr unsigned k_all_halfspaces = 0x3f;

/// What a view makes of one vertex, rounded from double only at the end.
///   lane 0..5  distance to the halfspaces of frustum_planes()
///   lane 6     pixels of thickness that 1 m of bound gives, times w squared, halved
///   lane 7     w: the depth ahead of the eye; 1 without perspective
struct alignas(32) Lanes {
  float lane[8];
};

/// Culling flags and priority of a wedgie.
struct Assessment {
  CullFlags cull = k_out;
  float priority = -1;  ///< Pixels; -1 when out.
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
    unsigned inside = parent;
    for (unsigned rest = k_all_halfspaces & ~inside; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const float reach = bound * reach_[i];
      const float a = apex.lane[i], b = left.lane[i], c = right.lane[i];
      if (std::max(a, std::max(b, c)) + reach < 0) return {};
      inside |= unsigned(std::min(a, std::min(b, c)) - reach >= 0) << i;
    }
    const float thickness = std::max(apex.lane[6], std::max(left.lane[6], right.lane[6]));
    const float nearest = std::min(apex.lane[7], std::min(left.lane[7], right.lane[7]));
    return {CullFlags(inside), priority(thickness, nearest, bound, CullFlags(inside))};
  }

 private:
  float priority(float thickness, float w, float bound, CullFlags inside) const {
    if (bound <= 0) return 0;
    const float depth_reach = bound * depth_per_metre_;
    const float denominator = (w - depth_reach) * (w + depth_reach);
    if (!(inside & k_in_near) || w <= depth_reach || denominator <= 0) return RoamMesh::k_artificial_max;
    return std::min(2 * bound * thickness / denominator, RoamMesh::k_artificial_max);
  }

  glm::dvec3 eye_{0};
  std::array<Plane, 6> planes_{};
  std::array<float, 8> reach_{};  // |n.z| of the halfspaces
  glm::dvec4 to_x_{0}, to_y_{0}, to_w_{0, 0, 0, 1};
  float depth_per_metre_ = 0;  // |C|
};

}  // namespace sward::roam
