// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Rough ground for tests of clipmaps, with relief below its samples.
#include <gtest/gtest.h>

#include <sward/terrain/clipmap_rings.h>
#include <cmath>
#include <memory>
#include <numbers>

namespace sward::test {

struct ClipmapField {
  glm::ivec2 samples{129, 129};
  glm::dvec2 spacing{4, 4};
  glm::dvec3 origin{0};
  bool relief = true;
  double height = 1;   ///< Factor on all heights.
  bool holes = false;  ///< A rectangle of samples without data.
};

/// A field with its bounds and surface; stays where it is.
struct ClipmapGround {
  std::unique_ptr<HeightField> field;
  std::unique_ptr<Bounds> bounds;
  std::unique_ptr<FieldSurface> surface;

  explicit ClipmapGround(const ClipmapField& from = {}) {
    HeightFieldDesc desc;
    desc.columns = from.samples.x;
    desc.rows = from.samples.y;
    desc.spacing = from.spacing;
    desc.origin = from.origin;
    desc.relief.enabled = from.relief;
    std::vector<float> heights;
    std::vector<uint8_t> holes;
    for (int row = 0; row < desc.rows; ++row)
      for (int column = 0; column < desc.columns; ++column) {
        heights.push_back(float(14 * std::sin(column * 0.11) * std::cos(row * 0.09) +
                                3 * std::sin(column * 0.7 + 1) * std::sin(row * 0.53)));
        holes.push_back(column > 30 && column < 37 && row > 40 && row < 50);
      }
    if (!from.holes) holes.clear();
    auto made = HeightField::create(desc, std::move(heights), holes);
    EXPECT_TRUE(made) << made.error().message;
    field = std::make_unique<HeightField>(std::move(*made));
    bounds = std::make_unique<Bounds>(Bounds::create(*field, 1));
    surface = std::make_unique<FieldSurface>(*bounds);
  }
};

/// A camera over the ground: x, y from the field's middle, metres above the ground.
inline View view_over(const ClipmapGround& ground, glm::dvec2 xy, double above, double yaw_degrees,
                      double pitch_degrees, glm::ivec2 viewport = {320, 180}) {
  constexpr double k_radians = std::numbers::pi / 180;
  const glm::dvec2 at = glm::dvec2(ground.field->desc().origin) + xy;
  const glm::dvec3 eye(at, ground.field->height(at) + above);
  return View::look(eye, yaw_degrees * k_radians, pitch_degrees * k_radians, 50 * k_radians, viewport, 0.1, 5000);
}

}  // namespace sward::test
