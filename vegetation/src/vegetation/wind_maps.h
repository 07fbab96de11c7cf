// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace sward {

/// What the wind carries along, generated once: square maps whose borders match.
struct WindMaps {
  static constexpr int k_side = 256;
  /// Gusts over a side of the first and the second grey map.
  static constexpr std::array<int, 2> k_gusts{8, 10};
  /// Layer 0: gusts in red and green, every grey equally frequent. Layer 1: a normal map's x and y in red and green,
  /// 128 being 0. Row 0 at v = 0.
  std::array<std::vector<glm::u8vec4>, 2> layers;
};
const WindMaps& wind_maps();

/// Bilinear, repeating; red and green in units of 255.
glm::vec2 sample_wind_map(int layer, glm::vec2 uv);

}  // namespace sward
