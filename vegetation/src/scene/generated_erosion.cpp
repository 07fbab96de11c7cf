// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/generated_erosion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <queue>

#include "scene/generated_noise.h"

namespace sward::generated {

namespace {

constexpr int k_neighbours = 8;
constexpr int k_dx[k_neighbours] = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr int k_dy[k_neighbours] = {0, 1, 1, 1, 0, -1, -1, -1};
constexpr float k_length[k_neighbours] = {1, 1.41421356f, 1, 1.41421356f, 1, 1.41421356f, 1, 1.41421356f};

// Heights above 0 sort like the bits of their floats; the index breaks ties.
uint64_t queue_key(float height, int index) {
  return uint64_t(std::bit_cast<uint32_t>(height)) << 32 | uint32_t(index);
}

using FloodQueue = std::priority_queue<uint64_t, std::vector<uint64_t>, std::greater<uint64_t>>;

bool on_edge(const Grid& grid, int column, int row) {
  return column == 0 || row == 0 || column == grid.side - 1 || row == grid.side - 1;
}

enum Visit : uint8_t { k_unseen, k_queued, k_done };

FloodQueue queue_edge(const Grid& heights, std::vector<uint8_t>& visit) {
  std::vector<uint64_t> keys;
  keys.reserve(size_t(heights.side) * 8);
  for (int row = 0; row < heights.side; ++row) {
    const int stride = row == 0 || row == heights.side - 1 ? 1 : heights.side - 1;
    for (int column = 0; column < heights.side; column += stride) {
      keys.push_back(queue_key(heights.at(column, row), heights.index(column, row)));
      visit[size_t(heights.index(column, row))] = k_queued;
    }
  }
  return FloodQueue(std::greater<uint64_t>(), std::move(keys));
}

// Where the sample stands for the comparison of neighbours, in cells.
glm::vec2 jitter(int index, uint32_t seed) {
  const uint32_t h = hash(index, 7, seed);
  return {(float(h & 0xFFFF) * 0x1p-16f - 0.5f) * 0.7f, (float(h >> 16) * 0x1p-16f - 0.5f) * 0.7f};
}

// The neighbour already drained that lies most steeply below; it is lower, or the flood came from it.
int steepest_neighbour(const Grid& heights, const std::vector<uint8_t>& visit, const std::vector<glm::vec2>& offset,
                       int index) {
  const float z = heights.values[size_t(index)];
  int best = -1;
  float best_slope = -1;
  for (int k = 0; k < k_neighbours; ++k) {
    const int other = index + k_dy[k] * heights.side + k_dx[k];
    if (visit[size_t(other)] != k_done) continue;
    const glm::vec2 way = glm::vec2(k_dx[k], k_dy[k]) + offset[size_t(other)] - offset[size_t(index)];
    const float slope = (z - heights.values[size_t(other)]) / std::sqrt(way.x * way.x + way.y * way.y);
    if (slope <= best_slope) continue;
    best_slope = slope;
    best = k;
  }
  return best;
}

void prepare(Flow& flow, size_t count) {
  flow.order.clear();
  flow.order.reserve(count);
  flow.receiver.resize(count);
  flow.distance.resize(count);
}

void accumulate_area(const Grid& heights, Flow& flow) {
  flow.area.assign(heights.values.size(), heights.spacing * heights.spacing);
  for (size_t i = flow.order.size(); i-- > 0;) {
    const int index = flow.order[i];
    const int receiver = flow.receiver[size_t(index)];
    if (receiver != index) flow.area[size_t(receiver)] += flow.area[size_t(index)];
  }
}

}  // namespace

void route_flow(Grid& heights, uint32_t seed, Flow& flow) {
  const size_t count = heights.values.size();
  prepare(flow, count);
  std::vector<uint8_t> visit(count, k_unseen);
  std::vector<glm::vec2> offset(count);
  for (size_t i = 0; i < count; ++i) offset[i] = jitter(int(i), seed);
  FloodQueue queue = queue_edge(heights, visit);
  while (!queue.empty()) {
    const int index = int(uint32_t(queue.top()));
    queue.pop();
    const int column = index % heights.side, row = index / heights.side;
    const bool edge = on_edge(heights, column, row);
    const int way = edge ? -1 : steepest_neighbour(heights, visit, offset, index);
    flow.receiver[size_t(index)] = way < 0 ? index : index + k_dy[way] * heights.side + k_dx[way];
    flow.distance[size_t(index)] = way < 0 ? 0.0f : k_length[way] * heights.spacing;
    flow.order.push_back(index);
    visit[size_t(index)] = k_done;
    const float spill = std::nextafter(heights.values[size_t(index)], 1.0e9f);
    for (int k = 0; k < k_neighbours; ++k) {
      if (edge && (column + k_dx[k] < 0 || column + k_dx[k] >= heights.side || row + k_dy[k] < 0 ||
                   row + k_dy[k] >= heights.side))
        continue;
      const int other = index + k_dy[k] * heights.side + k_dx[k];
      if (visit[size_t(other)] != k_unseen) continue;
      visit[size_t(other)] = k_queued;
      float& z = heights.values[size_t(other)];
      z = std::max(z, spill);
      queue.push(queue_key(z, other));
    }
  }
  accumulate_area(heights, flow);
}

namespace {

// Below this area water does not gather into channels, square metres.
constexpr float k_sheet_area = 1500;
// Creep is at most so many times faster near the steepest slope than on flat ground.
constexpr float k_fastest_slide = 12;
// An explicit step stays stable up to dt D / spacing^2 = 3 / 8.
constexpr float k_stable = 0.3f;

// Upstream from the edge, so that each receiver's new height is known: z' = (z + U dt + F z'_r) / (1 + F).
void incise(Grid& heights, const Forces& forces, const Flow& flow, float dt) {
  for (const int32_t index : flow.order) {
    const size_t i = size_t(index);
    if (flow.receiver[i] == index) continue;
    const float lifted = heights.values[i] + forces.uplift.values[i] * dt;
    const float below = heights.values[size_t(flow.receiver[i])];
    const float f = forces.incision.values[i] * dt * std::sqrt(flow.area[i] + k_sheet_area) / flow.distance[i];
    heights.values[i] = below < lifted ? (lifted + f * below) / (1 + f) : lifted;
  }
}

// Diffusion with a nine-point Laplacian, which has no preferred direction to second order, and with a coefficient that
// grows as the slope nears the steepest that stands (Roering, Kirchner, Dietrich 1999).
void creep(Grid& heights, const Forces& forces, float dt, Grid& scratch) {
  const float scale = dt / (6 * heights.spacing * heights.spacing);
  const float run = 4 * heights.spacing * heights.spacing;
  const int side = heights.side;
  scratch.values = heights.values;
  for (int row = 1; row + 1 < side; ++row) {
    for (int column = 1; column + 1 < side; ++column) {
      const size_t i = size_t(heights.index(column, row));
      const float* z = &scratch.values[i];
      const float cross = z[-1] + z[1] + z[-side] + z[side];
      const float corners = z[-side - 1] + z[-side + 1] + z[side - 1] + z[side + 1];
      const float east = z[1] - z[-1], south = z[side] - z[-side];
      const float most = forces.steepest.values[i];
      const float reserve = 1 - (east * east + south * south) / (run * most * most);
      const float slide = 1 / std::max(reserve, 1 / k_fastest_slide);
      const float share = std::min(scale * forces.creep.values[i] * slide, k_stable / 6);
      heights.values[i] = z[0] + share * (4 * cross + corners - 20 * z[0]);
    }
  }
}

// Explicit parts of a step, enough for creep on flat ground.
int creep_parts(const Forces& forces, float spacing, float dt) {
  float fastest = 0;
  for (size_t i = 0; i < forces.creep.values.size(); ++i) fastest = std::max(fastest, forces.creep.values[i]);
  return std::max(1, int(std::ceil(fastest * dt / (k_stable * spacing * spacing))));
}

}  // namespace

void erode(Grid& heights, const Forces& forces, const History& history, uint32_t seed) {
  const int parts = creep_parts(forces, heights.spacing, history.dt);
  Flow flow;
  Grid scratch(heights.side, heights.spacing);
  for (int step = 0; step < history.steps; ++step) {
    if (step % history.steps_per_routing == 0) route_flow(heights, seed + uint32_t(step), flow);
    incise(heights, forces, flow, history.dt);
    for (int part = 0; part < parts; ++part) creep(heights, forces, history.dt / float(parts), scratch);
  }
}

Grid spread_area(const Grid& heights, const Flow& flow) {
  Grid area(heights.side, heights.spacing, heights.spacing * heights.spacing);
  for (size_t i = flow.order.size(); i-- > 0;) {
    const int index = flow.order[i];
    if (on_edge(heights, index % heights.side, index / heights.side)) continue;
    float share[k_neighbours];
    float total = 0;
    for (int k = 0; k < k_neighbours; ++k) {
      const int other = index + k_dy[k] * heights.side + k_dx[k];
      const float drop = heights.values[size_t(index)] - heights.values[size_t(other)];
      const float slope = std::max(drop, 0.0f) / k_length[k];
      share[k] = slope * std::sqrt(slope);
      total += share[k];
    }
    if (total <= 0) continue;
    for (int k = 0; k < k_neighbours; ++k)
      area.values[size_t(index + k_dy[k] * heights.side + k_dx[k])] += area.values[size_t(index)] * share[k] / total;
  }
  return area;
}

}  // namespace sward::generated
