// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Blades in the wind on the CPU: their drawn lines, by the shaders' own files.
#include <sward/vegetation/species.h>
#include <sward/vegetation/wind.h>
#include <vector>

#include "vegetation/curve_twin.h"
#include "vegetation/layer_params.h"

namespace sward::test {

inline constexpr float k_turn = 6.2831853f;

inline const WindShapes& wind_shapes() {
  static const WindShapes shapes = make_wind_shapes().value();
  return shapes;
}

/// A blade's own posture.
struct Blade {
  float stiffness = 0.6f;
  float azimuth = 0;
  float lean = 0.1f;
  glm::vec3 normal{0, 0, 1};  ///< Of the ground.
  float segments = 16;        ///< Whole.
};

struct DrawnBlade {
  std::vector<glm::vec3> points;  ///< Root first, blade lengths; z up.
  float length() const {
    float sum = 0;
    for (size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
    return sum;
  }
  glm::vec3 tip() const { return points.back(); }
  /// Of the way from root to tip, from the vertical.
  float angle() const { return std::atan2(glm::length(glm::vec2(tip())), tip().z); }
};

/// As growth draws it in a wind that it feels (m/s).
inline DrawnBlade draw_blade(const Blade& blade, glm::vec2 wind) {
  shared::CurveTwin twin(wind_shapes());
  const glm::vec2 own_way(std::cos(blade.azimuth), std::sin(blade.azimuth));
  const auto bend = twin.bend_in_wind(own_way, blade.stiffness, blade.lean, wind);
  const auto curve = twin.laid_curve(twin.bent_curve(bend, blade.stiffness, blade.normal), own_way, blade.lean,
                                     blade.stiffness, blade.normal, blade.segments);
  DrawnBlade drawn;
  for (int i = 0; i <= int(blade.segments); ++i) {
    const auto p = twin.curve_point(curve, float(i) / blade.segments);
    drawn.points.emplace_back(bend.way * p.along, p.up);
  }
  return drawn;
}

}  // namespace sward::test
