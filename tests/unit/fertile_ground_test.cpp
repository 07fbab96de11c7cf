// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/fertile_ground.h"

#include <gtest/gtest.h>
#include <sward/vegetation/plants.h>

#include <random>
#include <tuple>

#include "unit/plant_fixtures.h"

namespace sward {
namespace {

constexpr double k_side = 128.0;
constexpr int k_level = 12;

class Dice {
 public:
  explicit Dice(uint32_t seed) : engine_(seed) {}
  float operator()(float from, float to) { return std::uniform_real_distribution<float>(from, to)(engine_); }
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(engine_); }
  bool chance(float share) { return (*this)(0.0f, 1.0f) < share; }

 private:
  std::mt19937 engine_;
};

/// Fields of one colour each, larger than a tile, grained; some forbid plants.
ColorMap random_fields(Dice& dice) {
  ColorMap map;
  map.width = dice.whole(90, 140);
  map.height = dice.whole(90, 140);
  map.min_corner = {dice(-3.0f, 3.0f), -k_side - double(dice(-3.0f, 3.0f))};
  map.size = {k_side, k_side};
  const int grain = dice.chance(0.5f) ? 0 : dice.whole(1, 12);
  std::vector<glm::ivec4> fields(16);
  for (glm::ivec4& field : fields)
    field = {dice.whole(0, 255), dice.whole(0, 255), dice.whole(0, 255), dice.chance(0.15f) ? 0 : 255};
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      glm::ivec4 texel = fields[size_t(row / 36 * 4 + column / 36)];
      for (int c = 0; c < 3; ++c) texel[c] = std::clamp(texel[c] + dice.whole(-grain, grain), 0, 255);
      map.texels.emplace_back(texel);
    }
  return map;
}

Species random_species(Dice& dice, const ColorMap& map) {
  Species s;
  const glm::vec3 like = glm::vec3(map.texels[size_t(dice.whole(0, int(map.texels.size()) - 1))]) / 255.0f;
  s.reference_hsv =
      dice.chance(0.7f) ? shared::rgb_to_hsv(like) : glm::vec3(dice(0.0f, 1.0f), dice(0.0f, 1.0f), dice(0.0f, 1.0f));
  s.weights = {dice(0.0f, 3.0f), dice(0.1f, 1.0f), dice(0.0f, 1.0f)};
  s.exponent = dice(0.5f, 6.0f);
  if (dice.chance(0.5f)) s.max_distance = dice(0.05f, 0.5f);
  s.kind = dice.chance(0.6f) ? PlantKind::none : PlantKind::blade;
  s.forbids = s.kind == PlantKind::none && dice.chance(0.3f);
  if (dice.chance(0.15f)) s.slope.max = 0.5f;
  if (dice.chance(0.2f))
    s.seasons = {{0.1f, {.reference_hsv = s.reference_hsv}},
                 {0.6f, {.reference_hsv = {dice(0.0f, 1.0f), dice(0.0f, 1.0f), dice(0.0f, 1.0f)}}}};
  return s;
}

struct Grown {
  uint32_t clusters;
  std::vector<std::tuple<uint64_t, uint32_t, uint32_t, float>> plants;
};

Grown grow(const Layer& layer, const ColorMap& map) {
  const View view = test::view_at({50.0, -60.0, 2.0});
  const FixedTriangles triangles = test::level_ground(k_side, k_level, view.eye, double(layer.horizon_m));
  Seeding seeding;
  seed(layer, view, map, triangles, seeding);
  Grown grown{seeding.clusters, {}};
  for (const Plant& plant : grow_plants(layer, view, map, triangles, seeding, 1.0f))
    grown.plants.emplace_back(plant.triangle.bits, plant.rank, plant.species, plant.fade);
  // Without barren triangles others may come into another bin, and so into another place.
  std::sort(grown.plants.begin(), grown.plants.end());
  return grown;
}

TEST(FertileGround, LeavesOutNoPlant) {
  int left_out = 0, with_plants = 0;
  for (uint32_t round = 0; round < 250; ++round) {
    Dice dice(round);
    ColorMap map = random_fields(dice);
    Layer layer;
    layer.density = 6.0f;
    layer.horizon_m = 60.0f;
    layer.season = dice(0.0f, 1.0f);
    layer.species.clear();
    for (int i = dice.whole(1, 5); i > 0; --i) layer.species.push_back(random_species(dice, map));
    const Grown all = grow(layer, map);
    map.bounds = bound_colors(map);
    const Grown fertile = grow(layer, map);
    ASSERT_EQ(all.plants, fertile.plants) << "round " << round;
    left_out += fertile.clusters < all.clusters ? 1 : 0;
    with_plants += all.plants.empty() ? 0 : 1;
  }
  // Else the rounds above say nothing.
  EXPECT_GT(left_out, 80);
  EXPECT_GT(with_plants, 80);
}

TEST(FertileGround, RangesHoldEveryColourBetweenTheirCorners) {
  Dice dice(1);
  int known_hues = 0;
  for (int box = 0; box < 2000; ++box) {
    const float width = dice(0.0f, 0.4f);
    glm::vec3 least, greatest;
    for (int c = 0; c < 3; ++c) {
      least[c] = dice(0.0f, 1.0f - width);
      greatest[c] = least[c] + dice(0.0f, width);
    }
    const HsvRange range = hsv_range(least, greatest);
    known_hues += range.any_hue ? 0 : 1;
    for (int i = 0; i < 40; ++i) {
      glm::vec3 color;
      for (int c = 0; c < 3; ++c) color[c] = dice.chance(0.3f) ? least[c] : dice(least[c], greatest[c]);
      const glm::vec3 hsv = shared::rgb_to_hsv(color);
      for (int c = 1; c < 3; ++c) {
        EXPECT_GE(hsv[c], range.least[c] - 1.0e-5f);
        EXPECT_LE(hsv[c], range.greatest[c] + 1.0e-5f);
      }
      if (range.any_hue) continue;
      const float from_least = hsv.x - range.least.x, turned = from_least - std::floor(from_least + 1.0e-5f);
      EXPECT_LE(turned, range.greatest.x - range.least.x + 1.0e-5f);
    }
  }
  EXPECT_GT(known_hues, 500);
}

TEST(FertileGround, WaterIsNotSubmitted) {
  ColorMap map;
  map.width = map.height = 64;
  map.texels.assign(64 * 64, glm::u8vec4(30, 60, 160, 255));
  map.min_corner = {0.0, -k_side};
  map.size = glm::dvec2(k_side);
  Species grass, water;
  grass.reference_hsv = {0.25f, 0.6f, 0.5f};
  water.reference_hsv = {0.628f, 0.81f, 0.63f};
  water.kind = PlantKind::none;
  water.forbids = true;
  Layer layer;
  layer.species = {grass, water};
  EXPECT_GT(grow(layer, map).clusters, 0u);
  map.bounds = bound_colors(map);
  EXPECT_EQ(grow(layer, map).clusters, 0u);
}

TEST(ColorMap, BoundsOfAnotherMapAreRefused) {
  ColorMap map;
  map.width = map.height = 40;
  map.texels.assign(1600, glm::u8vec4(1));
  map.bounds = bound_colors(map);
  EXPECT_TRUE(map.validate());
  map.width = 20;
  map.height = 80;
  EXPECT_FALSE(map.validate());
}

}  // namespace
}  // namespace sward
