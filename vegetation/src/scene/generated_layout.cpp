// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The plan of the place. A high range closes the north, a spur of it the east, lower hills the west and south-west;
// between them lies a basin of meadows that drains to the south, its stream passing east of the middle.

#include "scene/generated_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/generated_noise.h"

namespace sward::generated {

namespace {

// A stretch of a ridge line between two crest points.
struct Ridge {
  glm::vec2 from, to;
  float from_height, to_height;
  float width;  // metres from the crest to the foot
};

constexpr std::array<Ridge, 12> k_ridges{{
    {{-2700, 850}, {-1750, 1400}, 0.70f, 0.86f, 1400},
    {{-1750, 1400}, {-950, 1480}, 0.86f, 1.00f, 1400},
    {{-950, 1480}, {-150, 1400}, 1.00f, 0.66f, 1400},
    {{-150, 1400}, {650, 1680}, 0.66f, 0.94f, 1400},
    {{650, 1680}, {1600, 1250}, 0.94f, 0.80f, 1400},
    {{1600, 1250}, {2700, 1500}, 0.80f, 0.72f, 1400},
    {{1600, 1250}, {1800, 450}, 0.76f, 0.50f, 1000},
    {{1800, 450}, {1650, -450}, 0.50f, 0.40f, 950},
    {{1650, -450}, {2100, -1700}, 0.40f, 0.30f, 900},
    {{-2700, -300}, {-1850, -850}, 0.50f, 0.42f, 950},
    {{-1850, -850}, {-1400, -1600}, 0.42f, 0.32f, 900},
    {{-1400, -1600}, {-1700, -2700}, 0.32f, 0.26f, 850},
}};

// The bed of the main stream before erosion makes it its own.
constexpr std::array<glm::vec2, 7> k_stream{
    {{820, 1000}, {640, 520}, {430, 120}, {470, -350}, {250, -850}, {330, -1500}, {180, -2700}}};

struct Nearest {
  float distance, along;  // along: 0..1 from the first point to the second
};

Nearest nearest_on_segment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 way = b - a;
  const float along = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0f, 1.0f);
  return {glm::length(p - (a + way * along)), along};
}

float stream_distance(glm::vec2 p, uint32_t seed) {
  const glm::vec2 q = p + 90.0f * warp(p / 520.0f, 2, seed + 40);
  float best = 1.0e9f;
  for (size_t i = 0; i + 1 < k_stream.size(); ++i)
    best = std::min(best, nearest_on_segment(q, k_stream[i], k_stream[i + 1]).distance);
  return best;
}

// How high the mountains stand.
float mountain(glm::vec2 p, uint32_t seed) {
  const glm::vec2 q = p + 330.0f * warp(p / 1100.0f, 4, seed + 10) + 90.0f * warp(p / 350.0f, 2, seed + 12);
  float rest = 1;
  float highest = 0;
  for (const Ridge& ridge : k_ridges) {
    const Nearest n = nearest_on_segment(q, ridge.from, ridge.to);
    const float reach = std::max(0.0f, 1 - n.distance / ridge.width);
    const float height = reach * std::sqrt(reach) * glm::mix(ridge.from_height, ridge.to_height, n.along);
    highest = std::max(highest, height);
    rest *= 1 - 0.35f * height;
  }
  // A little of the union of all, so that ridges join without a crease.
  return 0.8f * highest + 0.45f * (1 - rest);
}

float first_height(glm::vec2 p, float high, uint32_t seed) {
  const float open = 1 - smooth_step(0.08f, 0.4f, high);
  const float bed = std::exp(-stream_distance(p, seed) / 170.0f);
  const float bench = std::exp(-glm::dot(p, p) / (380.0f * 380.0f));
  const glm::vec2 q = p + 120.0f * warp(p / 600.0f, 2, seed + 25);
  const float hills = smooth_step(0.05f, 0.75f, fbm(q / 760.0f, 2, 0.4f, seed + 30)) * (1 - bench);
  return 150 + 0.024f * p.y + 260 * high + 330 * high * ridged(q / 1150.0f, 5, seed + 20) +
         open * (75 * hills + 30 * fbm(q / 420.0f, 3, 0.45f, seed + 32) * (1 - 0.7f * bench) + 10 * bench) -
         30 * bed * (1 - 0.6f * high);
}

}  // namespace

Layout make_layout(int samples, float spacing, uint32_t seed) {
  const auto grid = [&] { return Grid(samples, spacing); };
  Layout layout{grid(), grid(), {grid(), grid(), grid(), grid()}};
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const glm::vec2 p = layout.mountain.position(column, row);
      const size_t i = size_t(layout.mountain.index(column, row));
      const float high = mountain(p, seed);
      const float hill = smooth_step(0.08f, 0.55f, high);
      const float patch = fbm(p / 430.0f, 3, 0.5f, seed + 50);
      layout.mountain.values[i] = high;
      layout.first_ground.values[i] = std::max(1.0f, first_height(p, high, seed));
      layout.forces.uplift.values[i] = 6 + 300 * high * (1 + 0.4f * patch);
      layout.forces.incision.values[i] = glm::mix(2.2f, 4.5f + 2.0f * patch, hill);
      layout.forces.creep.values[i] = 3200 * std::pow(0.05f, std::sqrt(hill));
      layout.forces.steepest.values[i] = glm::mix(0.55f, 1.0f + 0.35f * fbm(p / 160.0f, 2, 0.5f, seed + 60), hill);
    }
  }
  return layout;
}

Grid resampled(Grid grid, int samples) {
  while (grid.side < samples) grid = refined(grid);
  while (grid.side > samples) grid = every_second(grid);
  return grid;
}

Forces resampled(const Forces& forces, int samples) {
  return {resampled(forces.uplift, samples), resampled(forces.incision, samples), resampled(forces.creep, samples),
          resampled(forces.steepest, samples)};
}

}  // namespace sward::generated
