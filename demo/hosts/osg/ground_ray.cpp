// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "ground_ray.h"

#include <sward/terrain/queries.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::osg_host {

namespace {

// A ray that starts on the surface hits it there: the next one starts this far behind a hit.
constexpr double k_past_hit_m = 1e-3;
constexpr int k_most_steps = 1 << 16;
constexpr int k_halvings = 40;

std::vector<GroundHit> query(const TerrainQueries& queries, glm::dvec3 from, glm::dvec3 to, bool first_only) {
  std::vector<GroundHit> hits;
  const double length = glm::length(to - from);
  for (double begin = 0; begin <= length;) {
    const glm::dvec3 origin = from + (to - from) * (begin / length);
    const auto hit = queries.ray({origin, to - from, length - begin});
    if (!hit) break;
    const double along = begin + hit->distance;
    hits.push_back({std::min(along / length, 1.0), hit->point, hit->normal});
    if (first_only) break;
    begin = along + k_past_hit_m;
  }
  return hits;
}

// The part of the segment inside the box, as ratios; empty when second < first.
std::pair<double, double> clip(glm::dvec3 from, glm::dvec3 to, glm::dvec3 low, glm::dvec3 high) {
  std::pair<double, double> part(0, 1);
  for (int axis = 0; axis < 3; ++axis) {
    const double step = to[axis] - from[axis];
    if (step == 0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return {1, 0};
      continue;
    }
    const double a = (low[axis] - from[axis]) / step, b = (high[axis] - from[axis]) / step;
    part.first = std::max(part.first, std::min(a, b));
    part.second = std::min(part.second, std::max(a, b));
  }
  return part;
}

class March {
 public:
  March(const Surface& surface, glm::dvec3 from, glm::dvec3 to) : surface_(surface), from_(from), to_(to) {}

  std::vector<GroundHit> hits(bool first_only) const {
    const Lattice& lattice = surface_.lattice();
    const glm::dvec2 low = lattice.min_corner(), high = lattice.max_corner(), heights = surface_.height_range();
    // A little more than the ground's heights: ends of the part must lie on its two sides.
    const auto [begin, end] = clip(from_, to_, {low, heights.x - 1}, {high, heights.y + 1});
    std::vector<GroundHit> found;
    if (end < begin) return found;
    const double across = glm::length(glm::dvec2(to_ - from_)) * (end - begin);
    const double spacing = std::min(lattice.spacing.x, lattice.spacing.y);
    const int steps = int(std::clamp(std::ceil(across / spacing), 1.0, double(k_most_steps)));
    double last = begin, last_above = above(begin);
    for (int i = 1; i <= steps; ++i) {
      const double next = begin + (end - begin) * i / steps, next_above = above(next);
      // NaN, beyond the data, is on no side.
      if (last_above * next_above <= 0 && last_above != 0) found.push_back(between(last, next, last_above));
      if (first_only && !found.empty()) break;
      last = next;
      last_above = next_above;
    }
    return found;
  }

 private:
  glm::dvec3 at(double ratio) const { return glm::mix(from_, to_, ratio); }
  double above(double ratio) const {
    const glm::dvec3 p = at(ratio);
    return p.z - surface_.height(glm::dvec2(p));
  }

  GroundHit between(double low, double high, double low_above) const {
    for (int i = 0; i < k_halvings; ++i) {
      const double middle = (low + high) / 2;
      (above(middle) * low_above > 0 ? low : high) = middle;
    }
    const glm::dvec2 slope = surface_.data_gradient(glm::dvec2(at(high)));
    return {high, at(high), glm::normalize(glm::dvec3(-slope, 1))};
  }

  const Surface& surface_;
  glm::dvec3 from_, to_;
};

}  // namespace

std::vector<GroundHit> march_over(const Surface& surface, glm::dvec3 from, glm::dvec3 to, bool first_only) {
  return March(surface, from, to).hits(first_only);
}

std::vector<GroundHit> meet_ground(const host::SceneTerrain& terrain, glm::dvec3 from, glm::dvec3 to, bool first_only) {
  if (from == to) return {};
  if (terrain.bounds() == nullptr) return march_over(terrain.surface(), from, to, first_only);
  return query(TerrainQueries(*terrain.bounds()), from, to, first_only);
}

}  // namespace sward::osg_host
