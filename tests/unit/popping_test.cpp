// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants do not pop: what level of detail does to a plant's height between two frames stays below a pixel.
#include "popping.h"

#include <gtest/gtest.h>

namespace sward {
namespace {

constexpr float k_horizon_m = 35;

struct Walk {
  DensityLaw law;
  int path;
};

class Popping : public testing::TestWithParam<Walk> {};

TEST_P(Popping, NoHeightChangesByMoreThanAPixel) {
  const auto terrain = popping::hills();
  const ColorMap map = popping::green(*terrain.field);
  Layer layer = popping::meadow(GetParam().law, k_horizon_m);
  const auto jumps = popping::follow_walk(terrain, map, layer, GetParam().path, 24);
  EXPECT_GT(jumps.compared, 20000u);
  EXPECT_LE(jumps.worst_px, 1.0) << jumps.beyond_a_pixel << " of " << jumps.compared;
  layer.plain = true;
  const auto plain = popping::follow_walk(terrain, map, layer, GetParam().path, 24);
  EXPECT_GT(plain.worst_px, 3.0) << "the paper's way pops, or this test sees nothing";
}

// Every plant that both views have in sight, and nothing that only one of them has there.
void expect_same_plants(const Layer& layer, const popping::Frame& a, const popping::Frame& b) {
  size_t common = 0;
  for (const auto& [name, plant] : a.plants) {
    if (!popping::in_sight(a.view, plant.position) || !popping::in_sight(b.view, plant.position)) continue;
    const auto other = b.plants.find(name);
    ASSERT_NE(other, b.plants.end()) << layer.name;
    ASSERT_EQ(plant.position, other->second.position);
    ASSERT_EQ(plant.fade, other->second.fade);
    ASSERT_EQ(plant.height, other->second.height);
    ++common;
  }
  EXPECT_GT(common, 300u);
}

TEST(Turning, TheHeadOnTheSpotChangesNoPlant) {
  const auto terrain = popping::hills();
  const ColorMap map = popping::green(*terrain.field);
  for (const DensityLaw law : {DensityLaw::distance, DensityLaw::screen_area, DensityLaw::world_area}) {
    const Layer layer = popping::meadow(law, k_horizon_m);
    popping::Stage stage(terrain, layer);
    const View ahead = popping::walk(terrain, 0, 0);
    const glm::dvec3 eye = ahead.eye;
    const auto look = [&](double yaw, double pitch) {
      return stage.show(View::look(eye, yaw, pitch, 0.87, popping::k_viewport, 0.1, 2000), map, 0.0);
    };
    const auto first = look(0.4, -0.1), turned = look(0.8, -0.25), back = look(0.4, -0.1);
    expect_same_plants(layer, first, turned);
    expect_same_plants(layer, turned, first);
    expect_same_plants(layer, first, back);
    EXPECT_EQ(first.plants.size(), back.plants.size());
  }
}

// A walk away and back: the same plants in the same places.
TEST(Returning, BringsBackTheSamePlants) {
  const auto terrain = popping::hills();
  const ColorMap map = popping::green(*terrain.field);
  const Layer layer = popping::meadow(DensityLaw::distance, k_horizon_m);
  popping::Stage stage(terrain, layer);
  const auto first = stage.show(popping::walk(terrain, 0, 0), map, 0.0);
  for (const int frame : {200, 700, 1500, 700, 200})
    stage.show(popping::walk(terrain, 0, frame), map, 10.0 * frame + 10);
  popping::Frame back;
  // Morph has ended, the mesh is at rest.
  for (int i = 0; i < 120; ++i) back = stage.show(popping::walk(terrain, 0, 0), map, 20000.0 + i * popping::k_frame_s);
  ASSERT_GT(first.plants.size(), 3000u);
  EXPECT_EQ(first.plants.size(), back.plants.size());
  for (const auto& [name, plant] : first.plants) {
    const auto other = back.plants.find(name);
    ASSERT_NE(other, back.plants.end());
    ASSERT_EQ(plant.position.x, other->second.position.x);
    ASSERT_EQ(plant.position.y, other->second.position.y);
    ASSERT_EQ(plant.fade, other->second.fade);
  }
}

INSTANTIATE_TEST_SUITE_P(Walks, Popping,
                         testing::Values(Walk{DensityLaw::distance, 0}, Walk{DensityLaw::distance, 1},
                                         Walk{DensityLaw::distance, 2}, Walk{DensityLaw::screen_area, 0},
                                         Walk{DensityLaw::screen_area, 1}, Walk{DensityLaw::screen_area, 2},
                                         Walk{DensityLaw::world_area, 0}, Walk{DensityLaw::world_area, 1},
                                         Walk{DensityLaw::world_area, 2}));

}  // namespace
}  // namespace sward
