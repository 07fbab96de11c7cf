// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Triangles, views and maps made by hand, and the statistics that the tests of seeds and plants share.
#include <sward/terrain/color_map.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/view.h>
#include <sward/vegetation/species.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace sward::test {

/// A camera that looks down -z of the world's axes. `zoom` is against 50 degrees.
inline View view_at(glm::dvec3 eye, double zoom = 1.0) {
  const double focal = zoom / std::tan(25.0 * std::numbers::pi / 180.0);
  View view;
  view.eye = eye;
  view.viewport = {1000, 1000};
  view.clip_from_eye = glm::dmat4(0.0);
  view.clip_from_eye[0][0] = focal;
  view.clip_from_eye[1][1] = focal;
  view.clip_from_eye[2][2] = -1.0;
  view.clip_from_eye[2][3] = -1.0;
  view.clip_from_eye[3][2] = -0.2;
  return view;
}

/// A bintree triangle of root square (0, 0), which spans x in [0, side], y in [-side, 0].
struct PlaneTriangle {
  uint64_t id;
  glm::dvec2 apex, left, right;
};

inline void split_to(int level, int at, const PlaneTriangle& t, std::vector<PlaneTriangle>& out) {
  if (at == level) {
    out.push_back(t);
    out.back().id |= uint64_t(level) << 58;
    return;
  }
  const glm::dvec2 middle = 0.5 * (t.left + t.right);
  split_to(level, at + 1, {t.id, middle, t.apex, t.left}, out);
  split_to(level, at + 1, {t.id | (uint64_t(1) << (34 - at)), middle, t.right, t.apex}, out);
}

/// All triangles of a level of that root square.
inline std::vector<PlaneTriangle> plane_triangles(double side, int level) {
  const glm::dvec2 nw(0.0, 0.0), ne(side, 0.0), sw(0.0, -side), se(side, -side);
  const uint64_t square = (uint64_t(1024) << 46) | (uint64_t(1024) << 35);
  std::vector<PlaneTriangle> out;
  split_to(level, 0, {square, nw, sw, ne}, out);
  split_to(level, 0, {square | (uint64_t(1) << 57), se, ne, sw}, out);
  return out;
}

inline double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

inline double distance_to_edge(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - a - t * (b - a));
}

/// Distance in the plane from p to the nearest point of a triangle.
inline double distance_to(const PlaneTriangle& t, glm::dvec2 p) {
  const bool inside = cross(t.left - t.apex, p - t.apex) >= 0.0 && cross(t.right - t.left, p - t.left) >= 0.0 &&
                      cross(t.apex - t.right, p - t.right) >= 0.0;
  if (inside) return 0.0;
  return std::min({distance_to_edge(p, t.apex, t.left), distance_to_edge(p, t.left, t.right),
                   distance_to_edge(p, t.right, t.apex)});
}

/// The triangle on level ground at height z, ready for seeding from `eye`.
inline FixedTriangle level_triangle(const PlaneTriangle& t, double z, glm::dvec3 eye) {
  FixedTriangle fixed;
  fixed.apex = glm::dvec3(t.apex, z);
  fixed.to_left = glm::vec3(glm::dvec3(t.left - t.apex, 0.0));
  fixed.to_right = glm::vec3(glm::dvec3(t.right - t.apex, 0.0));
  fixed.id.bits = t.id;
  fixed.area = float(0.5 * cross(t.left - t.apex, t.right - t.apex));
  fixed.distance = float(std::hypot(distance_to(t, glm::dvec2(eye)), eye.z - z) * (1.0 - 1.0e-6));
  return fixed;
}

/// Level ground of a whole root square, as far as `reach` metres from the eye.
inline FixedTriangles level_ground(double side, int level, glm::dvec3 eye, double reach) {
  FixedTriangles ground;
  for (const PlaneTriangle& t : plane_triangles(side, level)) {
    FixedTriangle fixed = level_triangle(t, 0.0, eye);
    if (double(fixed.distance) <= reach) ground.push_back(fixed);
  }
  return ground;
}

/// A map of one colour over the root square of `side` metres.
inline ColorMap plain_map(double side, int texels, glm::u8vec4 color) {
  ColorMap map;
  map.width = texels;
  map.height = texels;
  map.texels.assign(size_t(texels) * size_t(texels), color);
  map.min_corner = {0.0, -side};
  map.size = {side, side};
  return map;
}

/// Upper point of the chi-square distribution, `z` standard deviations out (Wilson and Hilferty 1931).
inline double chi_square_limit(int freedom, double z) {
  const double a = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - a + z * std::sqrt(a), 3.0);
}

/// Chi-square of counts against equal expectation.
inline double chi_square(std::span<const int> counts) {
  double total = 0.0, sum = 0.0;
  for (const int count : counts) total += count;
  const double expected = total / double(counts.size());
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

}  // namespace sward::test
