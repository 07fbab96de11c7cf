// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rules of placement on the CPU: shapes, ranges, masks, what of them reaches a triangle.
#include <gtest/gtest.h>
#include <sward/vegetation/plants.h>

#include <algorithm>
#include <limits>
#include <random>

#include "unit/plant_fixtures.h"
#include "vegetation/exclusion_index.h"
#include "vegetation/shared_glsl.h"

namespace sward {
namespace {

using namespace test;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

std::string error_of(const Expected<void>& result) {
  return result ? "" : result.error().message;
}

TEST(Shapes, WhatIsNoShapeIsRefused) {
  const auto polygon = [](std::vector<glm::dvec2> corners) {
    return error_of(ExclusionShape::polygon(std::move(corners)).validate());
  };
  EXPECT_NE(polygon({{0, 0}, {4, 4}, {4, 0}, {0, 3}}).find("edges 0-1 and 2-3 meet"), std::string::npos);
  EXPECT_NE(polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}}).find("crosses or touches"), std::string::npos);
  EXPECT_NE(polygon({{0, 0}, {4, 0}, {2, 0}, {2, 3}}).find("crosses or touches"), std::string::npos);  // folds back
  EXPECT_NE(polygon({{0, 0}, {1, 0}}).find("2 corners"), std::string::npos);
  EXPECT_NE(polygon({{0, 0}, {1, 1}, {2, 2}}).find("no area"), std::string::npos);
  EXPECT_NE(polygon({{0, 0}, {0, 0}, {2, 2}}).find("the same place"), std::string::npos);
  EXPECT_NE(polygon({{0, 0}, {k_nan, 0}, {2, 2}}).find("corner 1 is not finite"), std::string::npos);
  EXPECT_EQ(polygon({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}), "");
  EXPECT_NE(error_of(ExclusionShape::disc({0, 0}, -1).validate()).find("radius"), std::string::npos);
  EXPECT_NE(error_of(ExclusionShape::disc({k_nan, 0}, 1).validate()).find("finite"), std::string::npos);
  EXPECT_NE(error_of(ExclusionShape{}.validate()).find("neither"), std::string::npos);
  ExclusionShape both = ExclusionShape::disc({0, 0}, 1);
  both.corners = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_NE(error_of(both.validate()).find("a disc or a polygon"), std::string::npos);
}

/// Whether any two edges of a closed chain meet, by trying all pairs in integers.
bool meets_itself(const std::vector<glm::ivec2>& c) {
  const auto side = [](glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) {
    const int s = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return (s > 0) - (s < 0);
  };
  const auto on = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) {
    return side(a, b, p) == 0 && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
           p.y <= std::max(a.y, b.y);
  };
  const size_t n = c.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::ivec2 a = c[i], b = c[(i + 1) % n];
    for (size_t k = 0; k < n; ++k)
      if (k != i && k != (i + 1) % n && on(a, b, c[k])) return true;
    for (size_t j = 0; j < n; ++j) {
      const glm::ivec2 p = c[j], q = c[(j + 1) % n];
      if (side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0) return true;
    }
  }
  return false;
}

TEST(Shapes, RandomPolygonsAreRefusedExactlyWhereTheyMeetThemselves) {
  std::mt19937 random(3);
  int simple = 0, crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<glm::ivec2> corners(3 + random() % 5);
    for (glm::ivec2& corner : corners) corner = {int(random() % 7), int(random() % 7)};
    bool repeated = false;
    for (size_t a = 0; a < corners.size(); ++a)
      for (size_t b = 0; b < a; ++b) repeated = repeated || corners[a] == corners[b];
    if (repeated) continue;
    const std::vector<glm::dvec2> real(corners.begin(), corners.end());
    const bool refused = !ExclusionShape::polygon(real).validate();
    ASSERT_EQ(refused, meets_itself(corners)) << i;
    ++(refused ? crossing : simple);
  }
  EXPECT_GT(simple, 1000);
  EXPECT_GT(crossing, 1000);
}

TEST(Shapes, IdsOutliveNoShape) {
  Exclusions shapes;
  const uint64_t empty = shapes.version();
  const auto first = shapes.add(ExclusionShape::disc({1, 2}, 3));
  ASSERT_TRUE(first);
  const uint64_t one = shapes.version();
  EXPECT_NE(one, empty);
  EXPECT_TRUE(shapes.move(*first, {10, 0}));
  EXPECT_EQ(shapes.find(*first)->centre, glm::dvec2(11, 2));
  EXPECT_NE(shapes.version(), one);
  EXPECT_TRUE(shapes.remove(*first));
  EXPECT_FALSE(shapes.remove(*first));
  const auto second = shapes.add(ExclusionShape::disc({0, 0}, 1));
  ASSERT_TRUE(second);
  EXPECT_FALSE(*first == *second);
  EXPECT_EQ(shapes.find(*first), nullptr);
  EXPECT_FALSE(shapes.move(*first, {1, 1}));
  EXPECT_FALSE(shapes.move(*second, {k_nan, 0}));
  EXPECT_EQ(shapes.find(*second)->centre, glm::dvec2(0, 0));
  EXPECT_FALSE(shapes.add(ExclusionShape{}));
  EXPECT_EQ(shapes.size(), 1u);
}

/// A star around a centre: simple whatever its radii.
ExclusionShape random_star(std::mt19937& random, glm::dvec2 centre, double radius) {
  std::uniform_real_distribution<double> share(0.2, 1.0);
  const size_t n = 3 + random() % 20;
  std::vector<glm::dvec2> corners;
  for (size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(n);
    corners.push_back(centre + radius * share(random) * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  if (random() % 2) std::reverse(corners.begin(), corners.end());
  return ExclusionShape::polygon(corners);
}

bool run_covers(const std::vector<glm::vec4>& run, glm::vec2 place) {
  for (size_t at = 0; at < run.size(); ++at) {
    if (run[at].w == shared::k_shape_disc) {
      if (shared::disc_covers(run[at], place)) return true;
      continue;
    }
    bool inside = run[at].x != 0;
    for (int edges = int(run[at].y); edges > 0; --edges)
      if (shared::edge_crossed(run[++at], place)) inside = !inside;
    if (inside) return true;
  }
  return false;
}

TEST(Exclusions, WhatReachesATriangleDecidesAsTheShapesDo) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-60, 60), unit(0, 1);
  size_t inside = 0, outside = 0, covered = 0, clear = 0, longest = 0;
  for (int world = 0; world < 20; ++world) {
    const glm::dvec2 origin = world % 2 ? glm::dvec2(1.0e6, -2.0e6) : glm::dvec2(0);
    Exclusions shapes;
    for (int i = 0; i < 12; ++i) {
      const glm::dvec2 centre = origin + glm::dvec2(place(random), place(random));
      const double radius = 1 + 20 * unit(random);
      ASSERT_TRUE(shapes.add(i % 3 ? random_star(random, centre, radius) : ExclusionShape::disc(centre, radius)));
    }
    ExclusionIndex index;
    index.follow(&shapes, "grass", 3.0);
    for (int i = 0; i < 3000; ++i) {
      const glm::dvec2 apex = origin + glm::dvec2(place(random), place(random));
      const glm::vec2 left(float(3 * unit(random)), float(3 * unit(random))), right(-left.y, left.x);
      std::vector<glm::vec4> run;
      const Reach reach = index.shapes_near(apex, left, right, run);
      longest = std::max(longest, run.size());
      covered += reach == Reach::all;
      clear += reach == Reach::none;
      for (int seed = 0; seed < 4; ++seed) {
        double a = unit(random), b = unit(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const glm::vec2 offset = float(a) * left + float(b) * right;
        const glm::dvec2 at = apex + glm::dvec2(offset);
        bool expected = false;
        for (const Exclusions::Entry& entry : shapes.entries()) expected = expected || entry.shape.contains(at);
        const bool found = reach == Reach::all || (reach == Reach::some && run_covers(run, offset));
        if (found != expected) {  // only a hair from an edge
          bool near = false;
          for (int k = 0; k < 8; ++k) {
            const glm::dvec2 beside = at + 1e-5 * glm::dvec2(std::cos(k * 0.785), std::sin(k * 0.785));
            bool other = false;
            for (const Exclusions::Entry& entry : shapes.entries()) other = other || entry.shape.contains(beside);
            near = near || other == found;
          }
          ASSERT_TRUE(near) << world << ' ' << i;
        }
        ++(expected ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 10000u);
  EXPECT_GT(outside, 10000u);
  EXPECT_GT(covered, 1000u);
  EXPECT_GT(clear, 1000u);
  EXPECT_LT(longest, 60u);
}

TEST(Exclusions, ALayersShapesAreForThatLayer) {
  Exclusions shapes;
  ExclusionShape disc = ExclusionShape::disc({0, 0}, 5);
  disc.layer = "trees";
  ASSERT_TRUE(shapes.add(disc));
  std::vector<glm::vec4> run;
  ExclusionIndex index;
  index.follow(&shapes, "grass", 1.0);
  EXPECT_EQ(index.shapes_near({0, 0}, {1, 0}, {0, 1}, run), Reach::none);
  index.follow(&shapes, "trees", 1.0);
  EXPECT_EQ(index.shapes_near({0, 0}, {1, 0}, {0, 1}, run), Reach::all);
}

/// Level ground around the eye, fully dense.
struct Meadow {
  Layer layer;
  ColorMap map = plain_map(16, 32, {90, 130, 50, 255});
  View view = view_at({8, -8, 1.7});
  FixedTriangles triangles = level_ground(16, 8, view.eye, 14);
  Exclusions exclusions;
  Seeding seeding;

  Meadow() {
    layer.species.resize(1);
    layer.species[0].name = "grass";
    layer.species[0].reference_hsv = {0.25f, 0.6f, 0.5f};
    layer.density = 60;
    layer.full_distance_m = 20;
    layer.horizon_m = 40;
  }
  std::vector<Plant> grow() {
    EXPECT_TRUE(validate(layer)) << validate(layer).error().message;
    seed(layer, view, map, triangles, seeding, &exclusions);
    return grow_plants(layer, view, map, triangles, seeding);
  }
};

TEST(Exclusions, NothingStandsInsideAndEverythingElseStays) {
  Meadow meadow;
  const std::vector<Plant> all = meadow.grow();
  const auto disc = meadow.exclusions.add(ExclusionShape::disc({5, -5}, 2.2));
  const auto road = meadow.exclusions.add(ExclusionShape::polygon({{-5, -9}, {30, -10}, {30, -11.5}, {-5, -10.5}}));
  ASSERT_TRUE(disc && road);
  const size_t before = meadow.seeding.records.size();
  const std::vector<Plant> rest = meadow.grow();
  EXPECT_LT(meadow.seeding.records.size(), before);  // covered triangles are not submitted
  size_t expected = 0;
  for (const Plant& plant : all) {
    const glm::dvec2 at(plant.position);
    expected += !meadow.exclusions.find(*disc)->contains(at) && !meadow.exclusions.find(*road)->contains(at);
  }
  EXPECT_NEAR(double(rest.size()), double(expected), 2);
  EXPECT_LT(rest.size(), all.size() - 500);
  for (const Plant& plant : rest) {
    EXPECT_GT(glm::length(glm::dvec2(plant.position) - glm::dvec2(5, -5)), 2.2 - 1e-4);
  }
  ASSERT_TRUE(meadow.exclusions.remove(*disc) && meadow.exclusions.remove(*road));
  EXPECT_EQ(meadow.grow().size(), all.size());
}

TEST(Rules, AltitudeAndWaterCutWhereTheySay) {
  Meadow meadow;
  // Ground that rises by 2 m from west to east, 100 m up.
  for (size_t i = 0; i < meadow.triangles.size(); ++i) {
    FixedTriangle t = meadow.triangles[i];
    const auto z = [](double x) { return float(100 + x / 8); };
    t.altitude = {z(t.apex.x), z(t.apex.x + double(t.to_left.x)), z(t.apex.x + double(t.to_right.x))};
    meadow.triangles.set(i, t);
  }
  const size_t all = meadow.grow().size();
  meadow.layer.species[0].altitude_m = {100.5f, 101.25f};
  const std::vector<Plant> cut = meadow.grow();
  EXPECT_NEAR(double(cut.size()) / double(all), 6.0 / 16, 0.02);
  for (const Plant& plant : cut) {
    EXPECT_GE(plant.position.x, 4 - 1e-3);
    EXPECT_LE(plant.position.x, 10 + 1e-3);
  }
  meadow.layer.species[0].altitude_soft_m = 0.25f;  // two metres of ground on either side
  const std::vector<Plant> soft = meadow.grow();
  EXPECT_NEAR(double(soft.size()) / double(all), 8.0 / 16, 0.02);
  for (const Plant& plant : soft) EXPECT_TRUE(plant.position.x > 2 - 1e-3 && plant.position.x < 12 + 1e-3);

  meadow.layer.species[0].altitude_m = {-k_unbounded, k_unbounded};
  meadow.layer.water_level_m = 100.75f;
  meadow.layer.species[0].above_water_m = 0.25f;
  for (const Plant& plant : meadow.grow()) EXPECT_GE(plant.position.x, 8 - 1e-3);
}

TEST(Rules, WithoutAltitudeNothingOfARuleStands) {
  Meadow meadow;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < meadow.triangles.size(); ++i) {
    FixedTriangle t = meadow.triangles[i];
    t.altitude = {0, nan, 0};
    meadow.triangles.set(i, t);
  }
  EXPECT_GT(meadow.grow().size(), 1000u);
  meadow.layer.species[0].altitude_m = {-k_unbounded, 1000};
  EXPECT_EQ(meadow.grow().size(), 0u);
}

TEST(Rules, SlopeComesFromTheStaticArea) {
  Meadow meadow;
  for (size_t i = 0; i < meadow.triangles.size(); ++i) {
    FixedTriangle t = meadow.triangles[i];
    if (t.apex.x > 8) t.area *= 1.1547005f;  // 30 degrees
    meadow.triangles.set(i, t);
  }
  constexpr float k_degree = 0.017453293f;
  meadow.layer.species[0].slope = {0, 20 * k_degree};
  double easternmost = 0;
  for (const Plant& plant : meadow.grow()) easternmost = std::max(easternmost, plant.position.x);
  EXPECT_LT(easternmost, 9.1);  // triangles have legs of 1 m
  EXPECT_GT(easternmost, 7.0);
  const auto east = [&] {
    const std::vector<Plant> plants = meadow.grow();
    return double(std::count_if(plants.begin(), plants.end(), [](const Plant& p) { return p.position.x > 9; }));
  };
  meadow.layer.species[0].slope_soft = 20 * k_degree;
  const double half = east();
  meadow.layer.species[0].slope = {0, 40 * k_degree};
  EXPECT_NEAR(half / east(), 0.5, 0.05);
}

std::shared_ptr<const GrayMap> striped_mask(int width, int height, uint8_t west, uint8_t east) {
  auto mask = std::make_shared<GrayMap>();
  mask->width = width;
  mask->height = height;
  for (int i = 0; i < width * height; ++i) mask->values.push_back(i % width < width / 2 ? west : east);
  return mask;
}

TEST(Rules, MasksForbidToTheTexelAndThinOut) {
  Meadow meadow;
  const double all = double(meadow.grow().size());
  const auto share = [&] { return double(meadow.grow().size()) / all; };
  // Another size than the base map's.
  meadow.layer.species[0].mask = striped_mask(6, 3, 0, 255);
  for (const Plant& plant : meadow.grow()) EXPECT_GE(plant.position.x, 8 - 1e-3);
  meadow.layer.species[0].mask = striped_mask(6, 3, 128, 128);
  EXPECT_NEAR(share(), 128.0 / 255, 0.02);
  meadow.layer.mask = meadow.layer.species[0].mask;
  EXPECT_NEAR(share(), 128.0 / 255 * 128 / 255, 0.02);
  meadow.layer.species[0].mask = nullptr;
  EXPECT_NEAR(share(), 128.0 / 255, 0.02);
  meadow.layer.mask = striped_mask(1, 1, 0, 0);
  EXPECT_EQ(share(), 0.0);
}

TEST(Rules, ADistributionMapTakesTheBaseMapsPlace) {
  Meadow meadow;
  auto distribution = std::make_shared<ColorMap>(plain_map(1, 4, {200, 40, 40, 255}));
  for (int i = 0; i < 16; ++i)
    if (i % 4 < 2) distribution->texels[size_t(i)] = {200, 40, 40, 0};  // forbidden
  meadow.layer.distribution = distribution;
  meadow.layer.species[0].reference_hsv = {0.0f, 0.8f, 0.78f};
  meadow.layer.species[0].max_distance = 0.05f;
  const std::vector<Plant> plants = meadow.grow();
  EXPECT_GT(plants.size(), 1000u);
  for (const Plant& plant : plants) EXPECT_GE(plant.position.x, 8 - 1e-3);
}

// ---- Validation ----

std::string complaint(const std::function<void(Layer&)>& change) {
  Layer layer;
  layer.name = "cover";
  layer.species.resize(1);
  layer.species[0].name = "grass";
  change(layer);
  return error_of(validate(layer));
}

TEST(PlacementRules, WhatContradictsItselfIsRefusedByName) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto expect = [](const std::string& found, const std::string& part) {
    EXPECT_NE(found.find(part), std::string::npos) << found;
  };
  expect(complaint([](Layer& l) { l.species[0].slope = {1, 0.5f}; }), "'cover': species 0 'grass': slope.max is less");
  expect(complaint([=](Layer& l) { l.species[0].altitude_m.min = nan; }), "altitude_m.min is nan");
  expect(complaint([](Layer& l) { l.species[0].altitude_m = {5, 1}; }), "altitude_m.max is less");
  expect(complaint([](Layer& l) { l.species[0].slope_soft = -1; }), "slope_soft is -1");
  expect(complaint([=](Layer& l) { l.species[0].altitude_soft_m = nan; }), "altitude_soft_m is nan");
  expect(complaint([](Layer& l) { l.species[0].above_water_m = 1; }), "needs the layer's water_level_m");
  expect(complaint([=](Layer& l) { l.water_level_m = nan; }), "water_level_m is nan");
  expect(complaint([=](Layer& l) { l.season = nan; }), "season is not finite");
  const auto mask = std::make_shared<GrayMap>();
  expect(complaint([&](Layer& l) { l.species[0].mask = mask; }), "mask is 0 x 0 texels");
  mask->width = mask->height = 3;
  mask->values.resize(8);
  expect(complaint([&](Layer& l) { l.mask = mask; }), "mask has 8 values but 3 x 3 texels");
  expect(complaint([&](Layer& l) { l.distribution = std::make_shared<ColorMap>(); }), "distribution: ");
  expect(complaint([](Layer& l) { l.species[0].seasons = {{1.0f, {}}}; }), "seasons[0].at is 1");
  expect(complaint([](Layer& l) { l.species[0].seasons = {{0.5f, {}}, {0.5f, {}}}; }), "seasons[1].at is not above");
  expect(complaint([](Layer& l) {
           SeasonFrame frame;
           frame.values.height = 1.5f;
           l.species[0].seasons = {frame};
         }),
         "seasons[0].height is 1.5");
  Layer named;
  named.species.resize(1);
  named.species[0].mask_file = "mask.png";
  EXPECT_TRUE(validate(named));
  EXPECT_NE(error_of(require_maps(named)).find("\"mask.png\" is named but not loaded"), std::string::npos);
}

}  // namespace
}  // namespace sward
