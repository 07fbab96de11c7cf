// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/generated_trails.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>

#include "scene/generated_noise.h"

namespace sward::generated {

namespace {

// Steps to sixteen directions: kings' and knights' moves.
constexpr int k_steps[16][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1},   {-1, 1},  {-1, -1}, {1, -1},
                                {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2},  {2, -1}};

// A steep metre costs many level ones, climbing or not: trails wind.
float effort(float length, float climb) {
  const float slope = climb / length;
  return length * (1 + 90 * slope * slope + 3 * std::abs(slope));
}

int nearest_sample(const Grid& grid, glm::vec2 p) {
  const int column = std::clamp(int((p.x + grid.half()) / grid.spacing + 0.5f), 0, grid.side - 1);
  const int row = std::clamp(int((grid.half() - p.y) / grid.spacing + 0.5f), 0, grid.side - 1);
  return grid.index(column, row);
}

// Dijkstra from `to` back to `from`; predecessors lead forward.
std::vector<int> forward_steps(const Grid& grid, int from, int to) {
  std::vector<float> cost(grid.values.size(), 1.0e30f);
  std::vector<int> next(grid.values.size(), -1);
  std::priority_queue<uint64_t, std::vector<uint64_t>, std::greater<uint64_t>> queue;
  const auto push = [&](int index) {
    queue.push(uint64_t(std::bit_cast<uint32_t>(cost[size_t(index)])) << 32 | uint32_t(index));
  };
  cost[size_t(to)] = 0;
  push(to);
  while (!queue.empty()) {
    const uint64_t top = queue.top();
    queue.pop();
    const int index = int(uint32_t(top));
    if (index == from) break;
    if (std::bit_cast<float>(uint32_t(top >> 32)) > cost[size_t(index)]) continue;
    for (const auto& step : k_steps) {
      const int column = index % grid.side + step[0], row = index / grid.side + step[1];
      if (column < 0 || row < 0 || column >= grid.side || row >= grid.side) continue;
      const int other = grid.index(column, row);
      const float length = grid.spacing * std::sqrt(float(step[0] * step[0] + step[1] * step[1]));
      const float through =
          cost[size_t(index)] + effort(length, grid.values[size_t(other)] - grid.values[size_t(index)]);
      if (through >= cost[size_t(other)]) continue;
      cost[size_t(other)] = through;
      next[size_t(other)] = index;
      push(other);
    }
  }
  return next;
}

void append_leg(Trail& trail, const Grid& grid, glm::vec2 from, glm::vec2 to) {
  const int goal = nearest_sample(grid, to);
  int index = nearest_sample(grid, from);
  const std::vector<int> next = forward_steps(grid, index, goal);
  for (; index >= 0 && index != goal; index = next[size_t(index)])
    trail.push_back(grid.position(index % grid.side, index / grid.side));
}

// Chaikin's corner cutting.
Trail smoothed(const Trail& trail) {
  Trail result{trail.front()};
  for (size_t i = 0; i + 1 < trail.size(); ++i) {
    result.push_back(glm::mix(trail[i], trail[i + 1], 0.25f));
    result.push_back(glm::mix(trail[i], trail[i + 1], 0.75f));
  }
  result.push_back(trail.back());
  return result;
}

Trail find_trail(const Grid& grid, std::span<const glm::vec2> way_points, uint32_t seed) {
  Trail trail;
  for (size_t i = 0; i + 1 < way_points.size(); ++i) append_leg(trail, grid, way_points[i], way_points[i + 1]);
  trail.push_back(way_points.back());
  for (int pass = 0; pass < 4; ++pass) trail = smoothed(trail);
  // Feet stray: a little wandering on top of the least effort.
  for (glm::vec2& p : trail) p += 16.0f * warp(p / 190.0f, 4, seed + 300);
  return trail;
}

}  // namespace

std::vector<Trail> find_trails(const Grid& heights, uint32_t seed) {
  Grid coarse = blurred(heights, 12);
  while (coarse.spacing < 15) coarse = every_second(coarse);
  const glm::vec2 through[] = {{120, -2300}, {20, -140}, {32, 60}, {330, 760}};
  const glm::vec2 west[] = {{-2300, 60}, {-800, 30}, {20, -140}};
  return {find_trail(coarse, through, seed), find_trail(coarse, west, seed)};
}

namespace {

// Half width of the trodden ground and of its frayed edges, metres.
constexpr float k_trodden = 0.5f, k_frayed = 2.1f;

struct WearMap {
  std::vector<uint8_t> values;
  int texels;
  float texel;  // metres

  // Texel range along one axis that a span of metres from the west or north edge touches.
  int first(float metres) const { return std::clamp(int(std::floor(metres / texel - 0.5f)), 0, texels); }
  int last(float metres) const { return std::clamp(int(std::ceil(metres / texel - 0.5f)), -1, texels - 1); }
};

float segment_distance(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 way = b - a;
  const float along = std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1.0e-6f), 0.0f, 1.0f);
  return glm::length(p - a - way * along);
}

// Points in metres from the map's north-western corner, y down.
void wear_segment(WearMap& map, glm::vec2 a, glm::vec2 b) {
  // A texel wider than the trail takes the share that the trail covers.
  const float trodden = k_trodden, frayed = std::max(k_frayed, map.texel);
  const float most = std::min(1.0f, 2.4f / map.texel);
  const glm::vec2 low = glm::min(a, b) - frayed, high = glm::max(a, b) + frayed;
  for (int row = map.first(low.y); row <= map.last(high.y); ++row) {
    for (int column = map.first(low.x); column <= map.last(high.x); ++column) {
      const glm::vec2 p = (glm::vec2(column, row) + 0.5f) * map.texel;
      const float wear = most * (1 - smooth_step(trodden, frayed, segment_distance(p, a, b)));
      uint8_t& value = map.values[size_t(row) * size_t(map.texels) + size_t(column)];
      value = std::max(value, uint8_t(wear * 255));
    }
  }
}

}  // namespace

std::vector<uint8_t> trail_wear(std::span<const Trail> trails, int texels, float width) {
  WearMap map{std::vector<uint8_t>(size_t(texels) * size_t(texels)), texels, width / float(texels)};
  const auto from_corner = [&](glm::vec2 p) { return glm::vec2(p.x + 0.5f * width, 0.5f * width - p.y); };
  for (const Trail& trail : trails)
    for (size_t i = 0; i + 1 < trail.size(); ++i) wear_segment(map, from_corner(trail[i]), from_corner(trail[i + 1]));
  return std::move(map.values);
}

}  // namespace sward::generated
