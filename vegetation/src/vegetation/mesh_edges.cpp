// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/mesh_edges.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace sward {

namespace {

/// A number for each corner, equal for those at the same place.
std::vector<uint32_t> weld(std::span<const glm::dvec3> corners) {
  std::vector<uint32_t> order(corners.size()), number(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](uint32_t i) { return std::tuple(corners[i].x, corners[i].y, corners[i].z); };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
  uint32_t next = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && place(order[i]) != place(order[i - 1])) ++next;
    number[order[i]] = next;
  }
  return number;
}

}  // namespace

EdgeCount count_edges(std::span<const glm::dvec3> corners) {
  const std::vector<uint32_t> number = weld(corners);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  edges.reserve(corners.size());
  for (size_t face = 0; face + 2 < number.size(); face += 3) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = number[face + i], b = number[face + (i + 1) % 3];
      if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  EdgeCount count;
  for (size_t i = 0; i < edges.size();) {
    size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1) ++count.open;
    if (end - i > 2) ++count.non_manifold;
    i = end;
  }
  return count;
}

}  // namespace sward
