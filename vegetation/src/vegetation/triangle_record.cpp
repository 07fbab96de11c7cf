// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/triangle_record.h"

#include <algorithm>
#include <cmath>

namespace sward {

namespace {

/// Altitudes that do not exist lie below every rule's range, and within that of a species without a rule.
constexpr float k_no_altitude = -1.0e30f;

bool asks_for_slope(const Species& species) {
  return species.slope.min > 0.0f || species.slope.max < k_unbounded;
}

/// Of the data, out of the static area, which is the horizontal one over its cosine.
float slope_of(float area, glm::vec2 to_left, glm::vec2 to_right) {
  const double horizontal = 0.5 * std::abs(double(to_left.x) * to_right.y - double(to_left.y) * to_right.x);
  return float(std::acos(std::clamp(horizontal / double(area), 0.0, 1.0)));
}

/// Layout: shaders/common_surface.glsl. 24 bits are exact in a float.
void carry_colors(const std::array<glm::u8vec3, 3>& colors, TriangleRecord& record) {
  const auto packed = [](glm::u8vec3 c) { return int(c.r) << 16 | int(c.g) << 8 | int(c.b); };
  record.texel = {packed(colors[0]), packed(colors[1])};
  record.texel_fraction = {float(packed(colors[2])), 0.0f};
}

}  // namespace

RecordMaker::RecordMaker(const Layer& layer, const ColorMap& map)
    : min_corner_(map.min_corner),
      size_(map.size),
      texels_(classification_map(layer, geometry_of(map)).texels),
      slopes_(std::any_of(layer.species.begin(), layer.species.end(), asks_for_slope)) {}

RecordMaker::RecordMaker(const Layer& layer, const MeshSurface& surface)
    : surface_(&surface), slopes_(std::any_of(layer.species.begin(), layer.species.end(), asks_for_slope)) {}

/// Whole texel and fraction of an apex; far outside the map the whole texel saturates, where everything is outside.
void RecordMaker::locate_apex(glm::dvec3 apex, TriangleRecord& record) const {
  constexpr double k_far = 1.0e9;
  const double u = (apex.x - min_corner_.x) / size_.x * texels_.x;
  const double v = (min_corner_.y + size_.y - apex.y) / size_.y * texels_.y;
  const glm::dvec2 place = glm::clamp(glm::dvec2(u, v), -k_far, k_far);
  const glm::dvec2 whole = glm::floor(place);
  record.texel = glm::ivec2(whole);
  record.texel_fraction = glm::vec2(place - whole);
}

TriangleRecord RecordMaker::make(const FixedTriangles& triangles, size_t i) const {
  const TriangleId id = triangles.id()[i];
  TriangleRecord record;
  record.id_low = id.low();
  record.to_left = triangles.to_left()[i];
  record.id_high = id.high();
  record.to_right = triangles.to_right()[i];
  record.surface = triangles.surface()[i];
  if (surface_ != nullptr)
    carry_colors(surface_->piece_colors(id), record);
  else
    locate_apex(triangles.apex()[i], record);
  if (slopes_) record.slope = slope_of(triangles.area()[i], glm::vec2(record.to_left), glm::vec2(record.to_right));
  record.altitude = triangles.altitude()[i];
  for (int corner = 0; corner < 3; ++corner)
    if (!std::isfinite(record.altitude[corner])) record.altitude = glm::vec3(k_no_altitude);
  return record;
}

}  // namespace sward
