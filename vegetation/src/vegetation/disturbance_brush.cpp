// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Brushes: which tiles they reach, and what they do to a cell.

#include "vegetation/disturbance_brush.h"

#include <algorithm>
#include <cmath>

#include "vegetation/shared_glsl.h"

namespace sward {

namespace {

/// A brush thinner than a cell is widened to this, cells, and weakened in proportion: it must not fall between centres.
constexpr double k_least_radius_cells = 0.75;

bool finite(glm::dvec2 v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool is_share(float value) {
  return value >= 0.0f && value <= 1.0f;
}

tl::unexpected<Error> refuse(const char* what, const char* range) {
  return fail(std::string("disturbance: ") + what + " must be " + range + "; nothing was touched");
}

/// A brush as a level has it.
struct LevelBrush {
  glm::dvec2 from, along;  // metres; along: unit, or 0 for a disc
  double length, radius, soft;
  float strength;

  LevelBrush(const DisturbanceBrush& brush, int level) : from(brush.from), along(brush.to - brush.from) {
    length = glm::length(along);
    along = length > 0 ? along / length : glm::dvec2(0);
    radius = std::max(brush.radius_m, k_least_radius_cells * k_cell_m[level]);
    strength = float(brush.radius_m / radius);
    soft = std::max(double(brush.soft), 0.0);
  }
  /// From the nearest point of the line.
  glm::dvec2 offset(glm::dvec2 place) const {
    const glm::dvec2 away = place - from;
    return away - along * std::clamp(glm::dot(away, along), 0.0, length);
  }
  float weight(double distance) const {
    if (distance >= radius) return 0.0f;
    const double inner = radius * (1.0 - soft);
    if (distance <= inner) return strength;
    const double t = (radius - distance) / (radius - inner);
    return strength * float(t * t * (3.0 - 2.0 * t));
  }
};

/// The way of the brush and out from its line, so that a track parts the grass. At a disc's very centre, east.
glm::vec2 press_way(const LevelBrush& brush, const DisturbanceTouch& touch, glm::dvec2 offset) {
  if (touch.way != glm::vec2(0)) return glm::normalize(touch.way);
  const glm::dvec2 out = (touch.inwards ? -offset : offset) / brush.radius;
  const glm::dvec2 way = brush.length > 0 ? brush.along + 0.7 * out : out;
  const double length = glm::length(way);
  return length > 1e-9 ? glm::vec2(way / length) : glm::vec2(1, 0);
}

/// Columns of tiles that a row of them (south .. north, metres) shares with the brush.
void add_row(const LevelBrush& brush, const glm::dvec2& to, int level, int row, std::vector<TileKey>& out) {
  const double size = tile_m(level);
  const double south = row * size - brush.radius, north = (row + 1) * size + brush.radius;
  double first = 0, last = 1;
  const double rise = to.y - brush.from.y;
  if (std::abs(rise) > 1e-12) {
    const double a = (south - brush.from.y) / rise, b = (north - brush.from.y) / rise;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return;
  const double x0 = brush.from.x + (to.x - brush.from.x) * first, x1 = brush.from.x + (to.x - brush.from.x) * last;
  const int west = int(std::floor((std::min(x0, x1) - brush.radius) / size));
  const int east = int(std::floor((std::max(x0, x1) + brush.radius) / size));
  for (int column = west; column <= east; ++column) {
    const glm::dvec2 centre = (glm::dvec2(column, row) + 0.5) * size;
    if (glm::length(brush.offset(centre)) <= brush.radius + 0.7072 * size) out.push_back({level, {column, row}});
  }
}

}  // namespace

Expected<void> validate(const DisturbanceBrush& brush, const DisturbanceTouch& touch) {
  for (const glm::dvec2& end : {brush.from, brush.to}) {
    if (!finite(end) || std::max(std::abs(end.x), std::abs(end.y)) > Disturbance::k_most_place)
      return refuse("the place of a brush", "finite and within 1e9 m of the origin");
  }
  if (!(brush.radius_m > 0 && brush.radius_m <= Disturbance::k_most_radius))
    return refuse("the radius of a brush", "above 0 and at most 1000 m");
  if (!is_share(brush.soft)) return refuse("the soft share of a brush", "within 0 and 1");
  if (!is_share(touch.press) || !is_share(touch.burn) || !is_share(touch.wet))
    return refuse("press, burn and wet", "within 0 and 1");
  if (!(touch.cut_m >= 0)) return refuse("the height that a cut leaves", "0 or more metres");
  if (!std::isfinite(touch.way.x) || !std::isfinite(touch.way.y) || glm::length(touch.way) > 1e18f)
    return refuse("the way of a press", "finite");
  if (touch.way != glm::vec2(0) && glm::length(touch.way) < 1e-18f)
    return refuse("the way of a press", "0 or not tiny");
  for (int i = 0; i < 4; ++i)
    if (!is_share(touch.paint[i])) return refuse("paint", "within 0 and 1");
  return {};
}

std::vector<TileKey> brushed_tiles(const DisturbanceBrush& brush, int level, size_t most) {
  const LevelBrush b(brush, level);
  const double size = tile_m(level);
  const glm::dvec2 box = glm::abs(brush.to - brush.from) + 2.0 * b.radius;
  // At least so many tiles lie along it.
  if (std::max(box.x, box.y) / size > double(most)) return {};
  const int south = int(std::floor((std::min(brush.from.y, brush.to.y) - b.radius) / size));
  const int north = int(std::floor((std::max(brush.from.y, brush.to.y) + b.radius) / size));
  std::vector<TileKey> out;
  for (int row = south; row <= north; ++row) {
    add_row(b, brush.to, level, row, out);
    if (out.size() > most) return {};
  }
  return out;
}

bool brush_tile(const DisturbanceBrush& brush, const DisturbanceTouch& touch, TileKey key, DisturbanceTile& tile,
                const CellClock& clock) {
  const LevelBrush b(brush, key.level);
  const double cell = k_cell_m[key.level];
  const glm::dvec2 corner = glm::dvec2(key.place) * tile_m(key.level);
  const float cut = std::isinf(touch.cut_m) ? 0.0f : shared::k_cut_scale / (shared::k_cut_scale + touch.cut_m);
  bool changed = false;
  for (int i = 0; i < k_tile_cells; ++i) {
    const glm::dvec2 place = corner + (glm::dvec2(i % k_tile_side, i / k_tile_side) + 0.5) * cell;
    const glm::dvec2 offset = b.offset(place);
    const float weight = b.weight(glm::length(offset));
    if (weight <= 0) continue;
    if (touch.press > 0) changed |= touch_press(tile, i, press_way(b, touch, offset) * (weight * touch.press), clock);
    if (touch.wet > 0) changed |= touch_wet(tile, i, weight * touch.wet, clock);
    if (cut > 0 || touch.burn > 0) changed |= touch_lasting(tile, i, weight * cut, weight * touch.burn, clock);
    if (touch.paint.a > 0)
      changed |= touch_paint(tile, i, glm::vec4(glm::vec3(touch.paint), weight * touch.paint.a), clock);
  }
  return changed;
}

PlaneSet planes_of(const DisturbanceTouch& touch) {
  return {touch.press > 0, touch.wet > 0, touch.burn > 0 || !std::isinf(touch.cut_m), touch.paint.a > 0};
}

}  // namespace sward
