// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/placement.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace sward {

namespace {

constexpr int k_most_map_texels = 16384;
constexpr double k_largest_radius = 1.0e6;
constexpr size_t k_most_corners = 4096;

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

bool finite(glm::dvec2 v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

/// -1, 0, 1: c lies right of, on, left of the line from a to b.
int side_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const double side = cross(b - a, c - a);
  return side > 0 ? 1 : side < 0 ? -1 : 0;
}

bool between(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return c.x >= std::min(a.x, b.x) && c.x <= std::max(a.x, b.x) && c.y >= std::min(a.y, b.y) &&
         c.y <= std::max(a.y, b.y);
}

bool segments_meet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const int abc = side_of(a, b, c), abd = side_of(a, b, d), cda = side_of(c, d, a), cdb = side_of(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// Two edges of a polygon, the second with the larger number.
bool edges_conflict(const std::vector<glm::dvec2>& corners, size_t first, size_t second) {
  const size_t n = corners.size();
  const glm::dvec2 a = corners[first], b = corners[(first + 1) % n], c = corners[second], d = corners[(second + 1) % n];
  // Neighbours share a corner, and may not fold back onto each other.
  if (second == first + 1) return side_of(a, b, d) == 0 && glm::dot(a - b, d - b) > 0;
  if (first == 0 && second == n - 1) return side_of(a, b, c) == 0 && glm::dot(b - a, c - a) > 0;
  return segments_meet(a, b, c, d);
}

std::string edge_name(size_t edge, size_t corners) {
  return std::to_string(edge) + "-" + std::to_string((edge + 1) % corners);
}

/// Edges by their western end: only those that overlap from west to east are compared.
Expected<void> check_simple(const std::vector<glm::dvec2>& corners) {
  const size_t n = corners.size();
  const auto west = [&](size_t i) { return std::min(corners[i].x, corners[(i + 1) % n].x); };
  const auto east = [&](size_t i) { return std::max(corners[i].x, corners[(i + 1) % n].x); };
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t(0));
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return west(a) < west(b); });
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 1; j < n && west(order[j]) <= east(order[i]); ++j) {
      const auto [first, second] = std::minmax(order[i], order[j]);
      if (!edges_conflict(corners, first, second)) continue;
      return fail("the polygon crosses or touches itself: edges " + edge_name(first, n) + " and " +
                  edge_name(second, n) + " meet; cut it into simple ones");
    }
  }
  return {};
}

Expected<void> check_polygon(const std::vector<glm::dvec2>& corners) {
  const size_t n = corners.size();
  if (n < 3 || n > k_most_corners) {
    return fail("the polygon has " + std::to_string(n) + " corners but must have 3 to " +
                std::to_string(k_most_corners));
  }
  double area = 0;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % n];
    if (!finite(a)) return fail("corner " + std::to_string(i) + " is not finite");
    if (a == b) return fail("corners " + edge_name(i, n) + " are the same place");
    area += cross(a - corners[0], b - corners[0]);
  }
  if (area == 0) return fail("the polygon has no area");
  return check_simple(corners);
}

/// A shape that is valid, with its bounds.
void put(ExclusionShape shape, Exclusions::Entry& to) {
  to.low = to.high = shape.corners.empty() ? shape.centre : shape.corners.front();
  for (const glm::dvec2 corner : shape.corners) {
    to.low = glm::min(to.low, corner);
    to.high = glm::max(to.high, corner);
  }
  to.low -= shape.radius_m;
  to.high += shape.radius_m;
  to.shape = std::move(shape);
}

/// Differs between objects and from every number before.
uint64_t next_version() {
  static std::atomic<uint64_t> versions{1};
  return ++versions;
}

}  // namespace

Expected<void> GrayMap::validate() const {
  if (width < 1 || height < 1 || width > k_most_map_texels || height > k_most_map_texels) {
    return fail("is " + std::to_string(width) + " x " + std::to_string(height) + " texels but must have 1 to " +
                std::to_string(k_most_map_texels) + " a side");
  }
  if (values.size() != size_t(width) * size_t(height)) {
    return fail("has " + std::to_string(values.size()) + " values but " + std::to_string(width) + " x " +
                std::to_string(height) + " texels");
  }
  return {};
}

ExclusionShape ExclusionShape::disc(glm::dvec2 centre, double radius_m) {
  ExclusionShape shape;
  shape.centre = centre;
  shape.radius_m = radius_m;
  return shape;
}

ExclusionShape ExclusionShape::polygon(std::vector<glm::dvec2> corners) {
  ExclusionShape shape;
  shape.corners = std::move(corners);
  return shape;
}

Expected<void> ExclusionShape::validate() const {
  if (radius_m == 0) {
    if (corners.empty()) return fail("the shape has neither a radius nor corners");
    return check_polygon(corners);
  }
  if (!corners.empty()) return fail("the shape has a radius and corners, but must be a disc or a polygon");
  if (!(radius_m > 0 && radius_m <= k_largest_radius)) return fail("the disc's radius must lie in (0, 1e6] metres");
  if (!finite(centre)) return fail("the disc's centre is not finite");
  return {};
}

bool ExclusionShape::contains(glm::dvec2 place) const {
  if (corners.empty()) return glm::dot(place - centre, place - centre) <= radius_m * radius_m;
  bool inside = false;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    if ((a.y <= place.y) == (b.y <= place.y)) continue;
    const double side = cross(b - a, place - a);
    if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
  }
  return inside;
}

Expected<ExclusionId> Exclusions::add(ExclusionShape shape) {
  if (auto valid = shape.validate(); !valid) return tl::unexpected(valid.error());
  if (free_.empty()) {
    free_.push_back(uint32_t(entries_.size()));
    entries_.emplace_back();
  }
  const ExclusionId id{free_.back(), entries_[free_.back()].generation};
  free_.pop_back();
  entries_[id.index].used = true;
  ++count_;
  put(std::move(shape), entries_[id.index]);
  changed();
  return id;
}

Expected<void> Exclusions::replace(ExclusionId id, ExclusionShape shape) {
  if (auto valid = shape.validate(); !valid) return valid;
  Entry* const to = entry(id);
  if (to == nullptr) return fail("no excluded shape has this id: it was removed, or belongs to other shapes");
  put(std::move(shape), *to);
  changed();
  return {};
}

Expected<void> Exclusions::move(ExclusionId id, glm::dvec2 by) {
  const Entry* const from = entry(id);
  if (from == nullptr) return fail("no excluded shape has this id: it was removed, or belongs to other shapes");
  ExclusionShape moved = from->shape;
  moved.centre += by;
  for (glm::dvec2& corner : moved.corners) corner += by;
  return replace(id, std::move(moved));
}

bool Exclusions::remove(ExclusionId id) {
  Entry* const gone = entry(id);
  if (gone == nullptr) return false;
  const uint32_t generation = gone->generation + 1;
  *gone = {};
  gone->generation = generation;
  free_.push_back(id.index);
  --count_;
  changed();
  return true;
}

const ExclusionShape* Exclusions::find(ExclusionId id) const {
  if (id.index >= entries_.size()) return nullptr;
  const Entry& found = entries_[id.index];
  return found.used && found.generation == id.generation ? &found.shape : nullptr;
}

Exclusions::Entry* Exclusions::entry(ExclusionId id) {
  return find(id) == nullptr ? nullptr : &entries_[id.index];
}

void Exclusions::changed() {
  version_ = next_version();
}

}  // namespace sward
