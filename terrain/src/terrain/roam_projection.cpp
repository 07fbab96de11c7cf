// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include "roam_projection.h"

#include <cmath>

namespace sward::roam {

Projection::Projection(const View& view) : eye_(view.eye), planes_(frustum_planes(view)) {
  for (int i = 0; i < 6; ++i) reach_[i] = float(std::abs(planes_[i].n.z));
  const glm::dmat4 rows = glm::transpose(view.clip_from_relative());
  to_x_ = rows[0] * (0.5 * view.viewport.x);
  to_y_ = rows[1] * (0.5 * view.viewport.y);
  to_w_ = rows[3];
  depth_per_metre_ = float(std::abs(to_w_.z));
}

Lanes Projection::project(glm::dvec3 world) const {
  const glm::dvec3 p = world - eye_;
  Lanes out;
  for (int i = 0; i < 6; ++i) out.lane[i] = float(glm::dot(planes_[i].n, p) + planes_[i].d);
  const glm::dvec4 q{p, 1.0};
  const double w = glm::dot(to_w_, q);
  const double x = to_x_.z * w - to_w_.z * glm::dot(to_x_, q);
  const double y = to_y_.z * w - to_w_.z * glm::dot(to_y_, q);
  out.lane[6] = float(std::sqrt(x * x + y * y));
  out.lane[7] = float(w);
  return out;
}

}  // namespace sward::roam
