// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/terrain.h>
#include <cmath>
#include <limits>
#include <vector>

// What a mesh draws above a point of the ground, and how far on screen that is from the finest surface.
namespace drawn_surface {

// The drawn surface above a point, found by trying every visible leaf; NaN where there is none.
inline double drawn_height(const sward::RoamMesh& mesh, glm::dvec2 p) {
  const auto indices = mesh.visible_indices();
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertex_world(indices[i]);
    const glm::dvec3 l = mesh.vertex_world(indices[i + 1]) - a, r = mesh.vertex_world(indices[i + 2]) - a;
    const glm::dvec2 q = p - glm::dvec2(a);
    const double area = l.x * r.y - l.y * r.x;
    const double u = (q.x * r.y - q.y * r.x) / area, v = (l.x * q.y - l.y * q.x) / area;
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9) return a.z + u * l.z + v * r.z;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

struct Errors {
  double largest = 0;
  int seen = 0;
  int undrawn = 0;
};

// The finest surface at `xy` against the drawn one, where the former is in the frustum.
inline void measure(const sward::RoamMesh& mesh, const sward::View& view, glm::dvec2 xy, double true_z,
                    Errors& errors) {
  const glm::dmat4 clip = view.clip_from_relative();
  const glm::dvec4 is = clip * glm::dvec4(glm::dvec3(xy, true_z) - view.eye, 1);
  if (!(std::abs(is.x) <= is.w && std::abs(is.y) <= is.w && std::abs(is.z) <= is.w)) return;
  ++errors.seen;
  const double z = drawn_height(mesh, xy);
  if (std::isnan(z)) {
    ++errors.undrawn;
    return;
  }
  const glm::dvec4 drawn = clip * glm::dvec4(glm::dvec3(xy, z) - view.eye, 1);
  const glm::dvec2 half = 0.5 * glm::dvec2(view.viewport);
  const glm::dvec2 off = half * (glm::dvec2(is) / is.w - glm::dvec2(drawn) / drawn.w);
  errors.largest = std::max(errors.largest, drawn.w > 0 ? glm::length(off) : std::numeric_limits<double>::infinity());
}

}  // namespace drawn_surface
