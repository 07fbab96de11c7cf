// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/plants.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "unit/plant_fixtures.h"

namespace sward {
namespace {

constexpr double k_side = 128.0;  ///< Root square; level 12 of it has triangles of 2 square metres.
constexpr int k_level = 12;
constexpr glm::u8vec4 k_green{70, 140, 40, 255}, k_blue{30, 60, 160, 255}, k_yellow{190, 170, 60, 255};

Species species_like(glm::u8vec4 color, PlantKind kind = PlantKind::blade) {
  // Hue of the three colours above by hand: max green, max blue, max red.
  Species s;
  s.kind = kind;
  if (color == k_green) s.reference_hsv = {(2.0f + (40.0f - 70.0f) / 100.0f) / 6.0f, 100.0f / 140.0f, 140.0f / 255.0f};
  if (color == k_blue) s.reference_hsv = {(4.0f + (30.0f - 60.0f) / 130.0f) / 6.0f, 130.0f / 160.0f, 160.0f / 255.0f};
  if (color == k_yellow) s.reference_hsv = {(170.0f - 60.0f) / 130.0f / 6.0f, 130.0f / 190.0f, 190.0f / 255.0f};
  return s;
}

Layer meadow_layer(float density) {
  Layer layer;
  layer.species = {species_like(k_green), species_like(k_yellow), species_like(k_blue, PlantKind::none)};
  layer.density = density;
  layer.full_distance_m = 5.0f;
  layer.horizon_m = 60.0f;
  return layer;
}

/// Everything that grows around an eye, with what it grows on.
struct Field {
  FixedTriangles triangles;
  Seeding seeding;
  std::vector<Plant> plants;
};

Field grow(const Layer& layer, const ColorMap& map, const View& view) {
  Field field;
  field.triangles = test::level_ground(k_side, k_level, view.eye, double(layer.horizon_m) * view.zoom());
  seed(layer, view, map, field.triangles, field.seeding);
  field.plants = grow_plants(layer, view, map, field.triangles, field.seeding, 1.0f);
  return field;
}

/// Where maps begin: their texels' borders do not run along the triangles' edges, which are multiples of 2 m.
constexpr glm::dvec2 k_map_corner(0.9, -0.7 - k_side);

/// Patches of the three colours, 4 m wide.
ColorMap patchwork() {
  ColorMap map = test::plain_map(k_side, 256, k_green);
  map.min_corner = k_map_corner;
  for (int row = 0; row < 256; ++row) {
    for (int column = 0; column < 256; ++column) {
      const int patch = (column / 8 + 2 * (row / 8)) % 3;
      map.texels[row * 256 + column] = patch == 0 ? k_green : patch == 1 ? k_yellow : k_blue;
    }
  }
  return map;
}

TEST(Plants, AreTheSameFromEveryEye) {
  Layer layer = meadow_layer(40.0f);
  layer.species[0].phototropism = 0.5f;
  const ColorMap map = patchwork();
  const Field first = grow(layer, map, test::view_at({64.0, -64.0, 1.7}));
  const Field second = grow(layer, map, test::view_at({75.3, -58.9, 6.1}));
  std::map<std::pair<uint64_t, uint32_t>, const Plant*> by_name;
  for (const Plant& p : first.plants) EXPECT_TRUE(by_name.insert({{p.triangle.bits, p.rank}, &p}).second);
  size_t common = 0;
  for (const Plant& q : second.plants) {
    const auto found = by_name.find({q.triangle.bits, q.rank});
    if (found == by_name.end()) continue;
    ++common;
    const Plant& p = *found->second;
    ASSERT_EQ(p.position.x, q.position.x);
    ASSERT_EQ(p.position.y, q.position.y);
    ASSERT_EQ(p.species, q.species);
    ASSERT_EQ(p.height, q.height);
    ASSERT_EQ(p.width, q.width);
    ASSERT_EQ(p.stiffness, q.stiffness);
    ASSERT_EQ(p.azimuth, q.azimuth);
    ASSERT_EQ(p.score, q.score);
  }
  EXPECT_GT(common, first.plants.size() / 3);
}

TEST(Plants, KeepTheirPlacesFarFromTheOrigin) {
  const Layer layer = meadow_layer(40.0f);
  const ColorMap map = patchwork();
  const View near = test::view_at({64.0, -64.0, 1.7});
  const Field here = grow(layer, map, near);
  // The same ground 10 000 km away.
  const glm::dvec2 shift(16777216.0, -8388608.0);
  Field there;
  there.triangles = here.triangles;
  for (size_t i = 0; i < there.triangles.size(); ++i) {
    FixedTriangle t = there.triangles[i];
    t.apex += glm::dvec3(shift, 0.0);
    there.triangles.set(i, t);
  }
  ColorMap moved = map;
  moved.min_corner += shift;
  View view = near;
  view.eye += glm::dvec3(shift, 0.0);
  seed(layer, view, moved, there.triangles, there.seeding);
  there.plants = grow_plants(layer, view, moved, there.triangles, there.seeding, 1.0f);
  ASSERT_EQ(here.plants.size(), there.plants.size());
  for (size_t i = 0; i < here.plants.size(); ++i) {
    ASSERT_EQ(here.plants[i].species, there.plants[i].species);
    ASSERT_NEAR(here.plants[i].position.x + shift.x, there.plants[i].position.x, 1e-6);
    ASSERT_NEAR(here.plants[i].position.y + shift.y, there.plants[i].position.y, 1e-6);
    ASSERT_EQ(here.plants[i].fade, there.plants[i].fade);
  }
}

/// Expected plants between 3-D distances a and b from an eye at height h above level ground, by the distance law.
double expected_plants(const Layer& layer, double h, double a, double b) {
  const double r0 = std::sqrt(std::max(a * a - h * h, 0.0)), r1 = std::sqrt(b * b - h * h);
  constexpr int k_steps = 2000;
  double sum = 0.0;
  for (int i = 0; i < k_steps; ++i) {
    const double r = r0 + (r1 - r0) * (i + 0.5) / k_steps;
    const double d = std::hypot(r, h);
    sum += layer.density * std::pow(std::max(d / layer.full_distance_m, 1.0), -double(layer.falloff)) * r;
  }
  return sum * (r1 - r0) / k_steps * 2.0 * std::numbers::pi;
}

TEST(Plants, DensityFollowsTheDistanceLaw) {
  // Thin enough that rounding up would show: at 40 m two and a half plants are due on a triangle.
  for (const float falloff : {1.0f, 1.5f}) {
    Layer layer = meadow_layer(10.0f);
    layer.species.resize(1);
    layer.falloff = falloff;
    const double height = 1.7;
    const Field field = grow(layer, test::plain_map(k_side, 4, k_green), test::view_at({64.0, -64.0, height}));
    const double rings[] = {1.7, 5.0, 10.0, 20.0, 30.0, 40.0, 48.0};
    for (int i = 0; i + 1 < int(std::size(rings)); ++i) {
      int counted = 0;
      for (const Plant& p : field.plants) {
        const double d = glm::length(p.position - glm::dvec3(64.0, -64.0, height));
        counted += d >= rings[i] && d < rings[i + 1] ? 1 : 0;
      }
      // Seeds are more even than independent ones, so Poisson's deviation is an upper limit; four of them.
      const double expected = expected_plants(layer, height, rings[i], rings[i + 1]);
      EXPECT_NEAR(counted, expected, 4.0 * std::sqrt(expected)) << rings[i] << " m, falloff " << falloff;
    }
  }
}

TEST(Plants, ScreenLawGivesEveryTriangleItsCount) {
  Layer layer = meadow_layer(2000.0f);
  layer.species.resize(1);
  layer.law = DensityLaw::screen_area;
  layer.ceiling = 200;
  layer.plain = true;
  const View view = test::view_at({64.0, -64.0, 1.7});
  const ColorMap map = test::plain_map(k_side, 4, k_green);
  FixedTriangles triangles = test::level_ground(k_side, k_level, view.eye, 20.0);
  for (size_t i = 0; i < triangles.size(); ++i) {
    FixedTriangle t = triangles[i];
    t.screen_area = 0.001f * float(i % 150);
    triangles.set(i, t);
  }
  Seeding seeding;
  seed(layer, view, map, triangles, seeding);
  std::map<uint64_t, uint32_t> counted;
  for (const Plant& p : grow_plants(layer, view, map, triangles, seeding)) ++counted[p.triangle.bits];
  for (size_t i = 0; i < triangles.size(); ++i) {
    const uint32_t expected = std::min(uint32_t(i % 150) * 2u, 200u);
    EXPECT_NEAR(counted[triangles.id()[i].bits], expected, i % 150 == 0 ? 0 : 1) << i;
  }
}

/// Encoded colour at a place as CONTRACT defines the lookup, in double.
glm::dvec4 color_at(const ColorMap& map, glm::dvec2 p) {
  const double u = (p.x - map.min_corner.x) / map.size.x * map.width - 0.5;
  const double v = (map.min_corner.y + map.size.y - p.y) / map.size.y * map.height - 0.5;
  const auto texel = [&](int i, int j) {
    const int column = std::clamp(i, 0, map.width - 1), row = std::clamp(j, 0, map.height - 1);
    return glm::dvec4(map.texels[row * map.width + column]) / 255.0;
  };
  const int i = int(std::floor(u)), j = int(std::floor(v));
  const glm::dvec4 north = glm::mix(texel(i, j), texel(i + 1, j), u - i);
  const glm::dvec4 south = glm::mix(texel(i, j + 1), texel(i + 1, j + 1), u - i);
  return glm::mix(north, south, v - j);
}

/// West is green, east of x = 64.9 blue.
ColorMap shore() {
  ColorMap map = test::plain_map(k_side, 64, k_green);
  map.min_corner = k_map_corner;
  for (int i = 0; i < 64 * 64; ++i) {
    if (i % 64 >= 32) map.texels[i] = k_blue;
  }
  return map;
}

/// Plants more than a texel west of the shore, within one texel west of it, and on the water, which is the nearer
/// colour from half-way between the texels' centres on.
std::array<int, 3> by_side(const std::vector<Plant>& plants) {
  std::array<int, 3> counts{};
  for (const Plant& p : plants) ++counts[p.position.x < 62.9 ? 0 : p.position.x < 64.9 ? 1 : 2];
  return counts;
}

TEST(Plants, NoneStandWhereABareSpeciesForbids) {
  Layer layer = meadow_layer(60.0f);
  // Broad transitions: on open water the grasses still score a third of what water does.
  layer.species.erase(layer.species.begin() + 1);
  layer.species[1].weights = layer.species[0].weights = {1.0f, 0.0f, 0.0f};
  layer.species[0].exponent = layer.species[1].exponent = 0.5f;
  layer.species[1].reference_hsv.x -= 0.05f;
  const View view = test::view_at({64.0, -64.0, 1.7});
  const auto by_chance = by_side(grow(layer, shore(), view).plants);
  layer.species[1].forbids = true;
  const auto forbidden = by_side(grow(layer, shore(), view).plants);
  EXPECT_GT(by_chance[2], 500);
  EXPECT_EQ(forbidden[2], 0);
  EXPECT_GT(forbidden[0], 1000);
  EXPECT_GT(forbidden[1], 0);
}

TEST(Plants, NoneStandOnMaskedGroundNorOffTheMap) {
  Layer layer = meadow_layer(60.0f);
  ColorMap map = test::plain_map(96.0, 48, k_green);
  map.min_corner = {16.7, -111.4};
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 48; ++column) {
      if ((column / 3 + row / 3) % 2 == 0) map.texels[row * 48 + column].a = 0;
    }
  }
  const Field field = grow(layer, map, test::view_at({64.0, -64.0, 1.7}));
  ASSERT_GT(field.plants.size(), 1000u);
  double most = 0.0;
  for (const Plant& p : field.plants) {
    ASSERT_GE(p.position.x, 16.7 - 1e-4);
    ASSERT_LE(p.position.x, 112.7 + 1e-4);
    ASSERT_GE(p.position.y, -111.4 - 1e-4);
    ASSERT_LE(p.position.y, -15.4 + 1e-4);
    ASSERT_GE(color_at(map, glm::dvec2(p.position)).w, 0.5 - 1e-4);
    most = std::max(most, std::abs(p.position.x - 64.0));
  }
  // Up to the edge of what is open, not only its middle.
  EXPECT_GT(most, 46.0);
}

TEST(Plants, SpeciesFollowTheGround) {
  Layer layer = meadow_layer(60.0f);
  for (Species& s : layer.species) s.max_distance = 0.05f;
  const ColorMap map = patchwork();
  const Field field = grow(layer, map, test::view_at({64.0, -64.0, 1.7}));
  std::array<int, 2> counted{};
  for (const Plant& p : field.plants) {
    // A threshold of 0.05 accepts only the colour itself and the seed must stand on ground that grows something, so
    // that it stands on green or yellow; a cluster is within a triangle, at most 2 m from its seeds.
    ASSERT_LT(p.species, 2u);
    ++counted[p.species];
    const glm::dvec4 color = color_at(map, glm::dvec2(p.position));
    ASSERT_GT(color.g, color.b) << p.position.x << ' ' << p.position.y;
  }
  EXPECT_GT(counted[0], 1000);
  EXPECT_GT(counted[1], 1000);
}

TEST(Plants, OfAClusterAreOneSpecies) {
  const Layer layer = meadow_layer(60.0f);
  const Field field = grow(layer, patchwork(), test::view_at({64.0, -64.0, 1.7}));
  std::map<std::pair<uint64_t, uint32_t>, std::pair<uint32_t, float>> clusters;
  for (const Plant& p : field.plants) {
    const auto [at, first] = clusters.insert({{p.triangle.bits, p.rank / 8}, {p.species, p.score}});
    ASSERT_EQ(at->second.first, p.species);
    ASSERT_EQ(at->second.second, p.score);
  }
}

TEST(Plants, ComeInOrderAndWithinTheirRanges) {
  Layer layer = meadow_layer(60.0f);
  layer.species[0].height_m = {0.5f, 0.8f};
  layer.species[0].width_m = {0.01f, 0.02f};
  layer.species[0].stiffness = {0.2f, 0.3f};
  const Field field = grow(layer, patchwork(), test::view_at({64.0, -64.0, 1.7}));
  size_t record = 0;
  int faded = 0;
  const Plant* before = nullptr;
  for (const Plant& p : field.plants) {
    if (before != nullptr && before->triangle == p.triangle) {
      ASSERT_GT(p.rank, before->rank);
    }
    while (record < field.seeding.records.size() && (field.seeding.records[record].id_low != p.triangle.low() ||
                                                     field.seeding.records[record].id_high != p.triangle.high())) {
      ++record;
    }
    ASSERT_LT(record, field.seeding.records.size()) << "out of the records' order";
    ASSERT_LT(p.rank, field.seeding.records[record].submitted);
    ASSERT_GT(p.fade, 0.0f);
    ASSERT_LE(p.fade, 1.0f);
    faded += p.fade < 1.0f ? 1 : 0;
    ASSERT_GT(p.score, 0.0f);
    ASSERT_LE(p.score, 1.0f);
    if (p.species == 0) {
      // Down to three fifths where species are balanced.
      ASSERT_GE(p.height, 0.6f * 0.5f);
      ASSERT_LE(p.height, 0.8f);
      ASSERT_GE(p.width, 0.01f);
      ASSERT_LE(p.width, 0.02f);
      ASSERT_GE(p.stiffness, 0.2f);
      ASSERT_LE(p.stiffness, 0.3f);
    }
    before = &p;
  }
  EXPECT_GT(faded, 100);
  EXPECT_GT(int(field.plants.size()) - faded, 100);
}

TEST(Plants, DoNotDependOnTheClustersThatABinSubmits) {
  const Layer layer = meadow_layer(60.0f);
  const ColorMap map = patchwork();
  const View view = test::view_at({64.0, -64.0, 1.7});
  Field field = grow(layer, map, view);
  for (DensityBin& bin : field.seeding.bins) bin.clusters += 5;
  const auto more = grow_plants(layer, view, map, field.triangles, field.seeding, 1.0f);
  EXPECT_EQ(more.size(), field.plants.size());
}

/// Philox-2x32 of seven rounds once more, from the paper, with 64-bit products.
std::pair<double, double> philox_uniforms(uint32_t index, uint64_t id) {
  uint64_t x = index, y = id >> 32, key = id & 0xffffffff;
  for (int round = 0; round < 7; ++round) {
    const uint64_t product = 0xD256D193ull * x;
    x = ((product >> 32) ^ key ^ y) & 0xffffffff;
    y = product & 0xffffffff;
    key = (key + 0x9E3779B9ull) & 0xffffffff;
  }
  return {double(x >> 8) / 16777216.0, double(y >> 8) / 16777216.0};
}

TEST(Plants, OfTheFirstClusterStandWhereEquations23To25PutThem) {
  Layer layer = meadow_layer(60.0f);
  layer.species.resize(1);
  const Field field = grow(layer, test::plain_map(k_side, 4, k_green), test::view_at({64.0, -64.0, 1.7}));
  std::map<uint64_t, FixedTriangle> by_id;
  for (size_t i = 0; i < field.triangles.size(); ++i) by_id[field.triangles.id()[i].bits] = field.triangles[i];
  int checked = 0;
  for (const Plant& p : field.plants) {
    if (p.rank >= 8) continue;
    auto [r1, r2] = philox_uniforms(p.rank, p.triangle.bits);
    if (r1 + r2 >= 1.0) std::tie(r1, r2) = std::pair{1.0 - r2, 1.0 - r1};
    const FixedTriangle& t = by_id.at(p.triangle.bits);
    const glm::dvec3 expected = t.apex + r1 * glm::dvec3(t.to_left) + r2 * glm::dvec3(t.to_right);
    ASSERT_NEAR(p.position.x, expected.x, 1e-6);
    ASSERT_NEAR(p.position.y, expected.y, 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 5000);
}

TEST(Plants, OfPlainLayersAreAllFull) {
  Layer layer = meadow_layer(20.0f);
  layer.plain = true;
  const Field field = grow(layer, patchwork(), test::view_at({64.0, -64.0, 1.7}));
  ASSERT_GT(field.plants.size(), 1000u);
  for (const Plant& p : field.plants) ASSERT_EQ(p.fade, 1.0f);
}

TEST(Plants, StandInEveryClusterSize) {
  for (const int size : {1, 3, 32}) {
    Layer layer = meadow_layer(20.0f);
    layer.species.resize(1);
    layer.cluster_size = size;
    const Field field = grow(layer, test::plain_map(k_side, 4, k_green), test::view_at({64.0, -64.0, 1.7}));
    const double expected = expected_plants(layer, 1.7, 1.7, 48.0);
    const auto near = std::count_if(field.plants.begin(), field.plants.end(), [](const Plant& p) {
      return glm::length(p.position - glm::dvec3(64.0, -64.0, 1.7)) < 48.0;
    });
    EXPECT_NEAR(double(near), expected, 4.0 * std::sqrt(expected)) << size;
  }
}

TEST(SurfaceHeight, FollowsTheDrawnSurface) {
  FixedTriangles triangles;
  triangles.set_surface_z(1000.0);
  // The middle of left-right stands at 1010, and below child 1 (m, right, apex) that of right-apex at 1020.
  triangles.add_node({10.0f, {0, 2}, 0});
  triangles.add_node({20.0f, {0, 0}, 0});
  FixedTriangle t;
  t.apex = {5.0, 5.0, 1000.0};
  t.to_left = {0, -2, 4};
  t.to_right = {2, 0, 8};
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.5f, 0.25f), 1004.0);  // flat: 2 + 2
  t.surface = 1;
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.0f, 0.0f), 1000.0);
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 1.0f, 0.0f), 1004.0);
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.0f, 1.0f), 1008.0);
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.5f, 0.5f), 1010.0);
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.75f, 0.25f), 1007.0);  // half of m, half of left
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.0f, 0.5f), 1020.0);
  EXPECT_DOUBLE_EQ(surface_height(triangles, t, 0.25f, 0.5f), 1015.0);  // half of m, half of that
}

TEST(SurfaceHeight, IsWherePlantsStand) {
  const Layer layer = meadow_layer(20.0f);
  const View view = test::view_at({64.0, -64.0, 61.7});
  FixedTriangles triangles = test::level_ground(k_side, k_level, {64.0, -64.0, 1.7}, 30.0);
  // A slope: z = 60 + x / 4, and everything refined once without a change, then lifted by a metre in the middle.
  triangles.set_surface_z(10.0);
  for (size_t i = 0; i < triangles.size(); ++i) {
    FixedTriangle t = triangles[i];
    t.apex.z = 44.0 + t.apex.x / 4.0;
    t.to_left.z = t.to_left.x / 4.0f;
    t.to_right.z = t.to_right.x / 4.0f;
    const double middle = t.apex.z + 0.5 * double(t.to_left.z + t.to_right.z);
    t.surface = triangles.add_node({float(middle + 1.0 - 10.0), {0, 0}, 0});
    triangles.set(i, t);
  }
  const ColorMap map = test::plain_map(k_side, 4, k_green);
  Seeding seeding;
  seed(layer, view, map, triangles, seeding);
  const auto plants = grow_plants(layer, view, map, triangles, seeding);
  ASSERT_GT(plants.size(), 500u);
  double least = 1e9, most = -1e9;
  for (const Plant& p : plants) {
    const double lift = p.position.z - 44.0 - p.position.x / 4.0;
    least = std::min(least, lift);
    most = std::max(most, lift);
  }
  EXPECT_GE(least, -1e-4);
  EXPECT_LE(most, 1.0 + 1e-4);
  EXPECT_LT(least, 0.05);
  EXPECT_GT(most, 0.95);
}

}  // namespace
}  // namespace sward
