// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "fixed_level_source.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sward::roam {

namespace {

double squared_distance_to_edge(glm::dvec3 a, glm::dvec3 ab) {
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(-glm::dot(a, ab) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 p = a + t * ab;
  return glm::dot(p, p);
}

// From the origin to the nearest point of a triangle: inside, on an edge or at a corner, by the signs of the
// barycentric coordinates of the projection.
double distance_to_triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac);
  const double area2 = glm::dot(normal, normal);
  const double to_b = glm::dot(glm::cross(ac, a), normal), to_c = glm::dot(glm::cross(a, ab), normal);
  if (to_b >= 0 && to_c >= 0 && to_b + to_c <= area2) return std::abs(glm::dot(a, normal)) / std::sqrt(area2);
  return std::sqrt(
      std::min({squared_distance_to_edge(a, ab), squared_distance_to_edge(a, ac), squared_distance_to_edge(b, c - b)}));
}

}  // namespace

ChunkSource::ChunkSource(const Lattice& lattice, const View& view, const FixedLevelOptions& options)
    : lattice_(lattice),
      view_(view),
      options_(options),
      planes_(frustum_planes(view)),
      clip_(view.clip_from_relative()),
      horizon2_(double(options.horizon_m) * options.horizon_m) {}

DrawnCorner ChunkSource::corner(LatticePoint lattice, glm::dvec3 world) const {
  DrawnCorner c;
  c.lattice = lattice;
  c.world = world;
  const glm::dvec3 relative = c.world - view_.eye;
  for (size_t i = 0; i < 6; ++i) c.plane[i] = glm::dot(planes_[i].n, relative) + planes_[i].d;
  return c;
}

DrawnCorner ChunkSource::middle(const DrawnCorner& a, const DrawnCorner& b) const {
  DrawnCorner m;
  m.lattice = a.lattice + (b.lattice - a.lattice) / 2;
  m.world = glm::dvec3(lattice_.world_xy(m.lattice), 0.5 * (a.world.z + b.world.z));
  for (size_t i = 0; i < 6; ++i) m.plane[i] = 0.5 * (a.plane[i] + b.plane[i]);
  return m;
}

DrawnTriangle ChunkSource::child(const DrawnTriangle& t, int turn, const DrawnCorner& m) {
  return {t.id.child(turn), m, turn == 0 ? t.apex : t.right, turn == 0 ? t.left : t.apex, t.cover};
}

bool ChunkSource::culled(const DrawnTriangle& t, double bound, unsigned& active) const {
  if (t.cover == Cover::padding || beyond_horizon(t, bound)) return true;
  for (unsigned rest = active; rest != 0; rest &= rest - 1) {
    const auto i = size_t(std::countr_zero(rest));
    const double a = t.apex.plane[i], b = t.left.plane[i], c = t.right.plane[i];
    const double up = planes_[i].n.z, reach = bound * std::abs(up);
    const double spread = glm::length(glm::dvec2(planes_[i].n)) * options_.spread_m;
    if (std::max({a, b, c}) + reach + std::max(up, 0.0) * options_.canopy_m + spread < 0) return true;
    if (std::min({a, b, c}) - reach + std::min(up, 0.0) * options_.canopy_m - spread >= 0) active &= ~(1u << i);
  }
  return false;
}

bool ChunkSource::beyond_horizon(const DrawnTriangle& t, double bound) const {
  const glm::dvec3 a = t.apex.world, b = t.left.world, c = t.right.world;
  glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  low.z -= bound;
  high.z += bound + options_.canopy_m;
  const glm::dvec3 gap = view_.eye - glm::clamp(view_.eye, low, high);
  return glm::dot(gap, gap) > horizon2_;
}

bool ChunkSource::faces_away(const DrawnTriangle& t) const {
  if (!options_.skip_back_faces) return false;
  const glm::dvec3 normal = glm::cross(t.left.world - t.apex.world, t.right.world - t.apex.world);
  return glm::dot(normal, view_.eye - t.apex.world) < -double(options_.canopy_m) * glm::length(normal);
}

float ChunkSource::screen_area(const DrawnTriangle& t) const {
  const double aspect = double(view_.viewport.x) / view_.viewport.y;
  glm::dvec2 p[3];
  const DrawnCorner* corners[3] = {&t.apex, &t.left, &t.right};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 clip = clip_ * glm::dvec4(corners[i]->world - view_.eye, 1.0);
    if (corners[i]->plane[4] < 0 || clip.w <= 0) return std::numeric_limits<float>::infinity();
    p[i] = glm::dvec2(clip.x * aspect, clip.y) / clip.w;
  }
  const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
  return float(0.5 * std::abs(u.x * v.y - u.y * v.x));
}

ExactTriangle ChunkSource::measure(const DrawnTriangle& t) const {
  const double distance =
      distance_to_triangle(t.apex.world - view_.eye, t.left.world - view_.eye, t.right.world - view_.eye);
  return {distance <= double(options_.horizon_m), distance, screen_area(t)};
}

}  // namespace sward::roam
