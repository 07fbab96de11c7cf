// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Ground that blades cover, by distance: fewer plants far away are as much wider, as long as the cap on widths allows.
#include <gtest/gtest.h>
#include <sward/vegetation/plants.h>

#include <cstdio>

#include "unit/plant_fixtures.h"
#include "vegetation/layer_params.h"

namespace sward {
namespace {

constexpr double k_side = 256.0;  // level 14 of it has triangles of 2 square metres
constexpr int k_level = 14;
constexpr glm::dvec3 k_eye(128.0, -128.0, 1.7);

Layer thin_grass() {
  Species grass;
  grass.reference_hsv = {(2.0f + (40.0f - 70.0f) / 100.0f) / 6.0f, 100.0f / 140.0f, 140.0f / 255.0f};
  // All alike: what is measured is the law, not the dice of sizes.
  grass.height_m = {0.3f, 0.3f};
  grass.width_m = {0.006f, 0.006f};
  Layer layer;
  layer.species = {grass};
  layer.density = 60.0f;
  layer.full_distance_m = 5.0f;
  layer.horizon_m = 120.0f;
  return layer;
}

struct Band {
  double from, to;
  double covered = 0;  // square metres of leaf a square metre of ground
  double spread = 0;   // two standard deviations of that, seeds taken for independent
  size_t plants = 0;
};

/// Shown height times shown width, against the ground between two distances from the eye (level ground at 0).
void measure(const Layer& layer, std::vector<Band>& bands) {
  const View view = test::view_at(k_eye);
  const ColorMap map = test::plain_map(k_side, 4, {70, 140, 40, 255});
  const FixedTriangles triangles = test::level_ground(k_side, k_level, k_eye, double(layer.horizon_m));
  Seeding seeding;
  seed(layer, view, map, triangles, seeding);
  const shared::LayerParams params = make_layer_params(layer, view, geometry_of(map), 0.0f);
  const float limit = 2.0f * layer.density;
  std::vector<double> squares(bands.size());
  for (const Plant& p : grow_plants(layer, view, map, triangles, seeding)) {
    const double d = glm::length(p.position - k_eye);
    const shared::uvec2 id(uint32_t(p.triangle.bits), uint32_t(p.triangle.bits >> 32));
    const shared::Presence presence = shared::seed_presence(params, limit, id, p.rank, float(d));
    const double shown = double(p.height * presence.fade) * double(p.width * presence.grow * presence.widen);
    for (size_t i = 0; i < bands.size(); ++i) {
      if (d < bands[i].from || d >= bands[i].to) continue;
      bands[i].covered += shown;
      squares[i] += shown * shown;
      ++bands[i].plants;
    }
  }
  for (size_t i = 0; i < bands.size(); ++i) {
    const double area = std::numbers::pi * (bands[i].to * bands[i].to -
                                            std::max(bands[i].from, k_eye.z) * std::max(bands[i].from, k_eye.z));
    bands[i].covered /= area;
    bands[i].spread = 2.0 * std::sqrt(squares[i]) / area;
  }
}

TEST(CoveredGround, IsConstantUntilTheCapOnWidths) {
  const Layer layer = thin_grass();
  // Widths reach eight times at 8 full distances, 40 m; sinking begins at 96 m.
  std::vector<Band> bands{{0, 5},   {5, 8},   {8, 12},  {12, 18}, {18, 26}, {26, 33},
                          {33, 40}, {40, 60}, {60, 80}, {80, 96}, {96, 120}};
  measure(layer, bands);
  double near = 0, weights = 0;
  for (size_t i = 0; i < 3; ++i) {
    near += bands[i].covered * double(bands[i].plants);
    weights += double(bands[i].plants);
  }
  near /= weights;
  for (const Band& band : bands) {
    std::printf("%3.0f to %3.0f m: %6zu plants, covered %.3f (+- %.3f) of the near\n", band.from, band.to, band.plants,
                band.covered / near, band.spread / near);
    if (band.to <= 40) {
      EXPECT_NEAR(band.covered / near, 1.0, 0.05) << band.from << " m";
      EXPECT_LT(band.spread / near, 0.05) << "too few plants to tell";
    }
  }
  // Beyond the cap it falls as density does, 1 / d.
  for (size_t i = 7; i < 10; ++i) {
    const double mean_inverse = 2.0 / (bands[i].from + bands[i].to);  // of 1/d over a ring, by area
    EXPECT_NEAR(bands[i].covered / near, 40.0 * mean_inverse, 0.05) << bands[i].from << " m";
  }
}

}  // namespace
}  // namespace sward
