// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace sward::roam {

/// Culling flags of a node: bits 0..5 say "wholly inside this halfspace", k_out says "wholly outside of one of them"
/// or in the padding. Children inherit every bit.
using CullFlags = uint8_t;
inline constexpr CullFlags k_out = 0x80;
inline constexpr CullFlags k_in_near = 1 << 4;

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

  /// `bound` in metres; `parent` the parent's flags (0 for a root).
  Assessment assess(const Lanes& apex, const Lanes& left, const Lanes& right, float bound, CullFlags parent) const {
    if (parent & k_out) return {};
    float high[8], low[8];
    for (int i = 0; i < 8; ++i) {
      high[i] = std::max(apex.lane[i], std::max(left.lane[i], right.lane[i]));
      low[i] = std::min(apex.lane[i], std::min(left.lane[i], right.lane[i]));
    }
    unsigned outside = 0, inside = parent;
    for (int i = 0; i < 6; ++i) {
      const float reach = bound * reach_[i];
      outside |= unsigned(high[i] + reach < 0) << i;
      inside |= unsigned(low[i] - reach >= 0) << i;
    }
    if (outside & ~unsigned(parent)) return {};
    return {CullFlags(inside), priority(high[6], low[7], bound, CullFlags(inside))};
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
