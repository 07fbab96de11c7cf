// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What is static of the triangles that the GPU seeds, against the bintree and the CPU's seeding.
#include "vegetation/clipmap_table.h"

#include <sward/terrain/edits.h>

#include <map>

#include "clipmap_support.h"
#include "unit/plant_fixtures.h"

namespace sward {
namespace {

using namespace test;

ColorMap map_over(const HeightField& field) {
  ColorMap map = plain_map(1, 64, {90, 130, 50, 255});
  map.min_corner = field.min_corner();
  map.size = field.max_corner() - field.min_corner();
  return map;
}

Layer layer_of(double triangle_area_m2, float horizon_m) {
  Layer layer;
  layer.species.resize(1);
  layer.species[0].name = "grass";
  layer.triangle_area_m2 = float(triangle_area_m2);
  layer.horizon_m = horizon_m;
  layer.density = 20;
  return layer;
}

/// All triangles of a level, by walking the bintree from its roots.
void walk(TriangleId id, const TriangleCorners& c, int level, std::map<uint64_t, TriangleCorners>& out) {
  if (id.level() == level) {
    out[id.bits] = c;
    return;
  }
  const LatticePoint middle = (c.left + c.right) / 2;
  walk(id.child(0), {middle, c.apex, c.left}, level, out);
  walk(id.child(1), {middle, c.right, c.apex}, level, out);
}

TEST(ClipmapTable, CellsHoldTheBintreesTrianglesOnceEach) {
  for (int level = 0; level <= 9; ++level) {
    std::map<uint64_t, TriangleCorners> all;
    const glm::ivec2 squares(3, 2);
    for (int row = 0; row < squares.y; ++row)
      for (int column = 0; column < squares.x; ++column)
        for (int root = 0; root < 2; ++root) {
          const TriangleId id = TriangleId::root(root, {column, row});
          walk(id, corners_of(id), level, all);
        }
    const int a_cell = level % 2 == 0 ? 2 : 4;
    const glm::ivec2 cells = squares * (1 << (level / 2));
    std::map<uint64_t, TriangleCorners> found;
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x)
        for (int i = 0; i < a_cell; ++i) {
          const CandidateTriangle t = find_candidate(level, {x, y}, i);
          EXPECT_TRUE(found.emplace(t.id.bits, t.corners).second) << level;
        }
    ASSERT_EQ(found.size(), all.size()) << level;
    for (const auto& [id, corners] : found) {
      ASSERT_TRUE(all.contains(id)) << level;
      EXPECT_EQ(all[id].apex, corners.apex);
      EXPECT_EQ(all[id].left, corners.left);
      EXPECT_EQ(all[id].right, corners.right);
    }
  }
}

void expect_same_after_any_way(double triangle_area_m2) {
  const ClipmapGround ground({.samples = {97, 65}, .holes = true});
  const ColorMap map = map_over(*ground.field);
  Exclusions exclusions;
  ASSERT_TRUE(exclusions.add(ExclusionShape::disc({20, 5}, 7)));
  const Layer layer = layer_of(triangle_area_m2, 40);
  ClipmapTable moved(layer, *ground.surface, map);
  size_t solid = 0, shaped = 0;
  for (const glm::dvec2 at : {glm::dvec2(0, 0), {3, 1}, {9, -4}, {15, 20}, {-150, 80}, {-140, 70}, {20, 0}, {21, -9}}) {
    View view = view_over(ground, {0, 0}, 2, 0, 0);
    view.eye.x = at.x;
    view.eye.y = at.y;
    ASSERT_TRUE(moved.follow(view, &exclusions));
    ClipmapTable fresh(layer, *ground.surface, map);
    ASSERT_TRUE(fresh.follow(view, &exclusions));
    ASSERT_EQ(moved.first(), fresh.first());
    ASSERT_EQ(moved.cells(), fresh.cells());
    for (int y = 0; y < fresh.cells().y; ++y)
      for (int x = 0; x < fresh.cells().x; ++x) {
        const glm::ivec2 cell = (fresh.first() + glm::ivec2(x, y)) & (fresh.memory() - 1);
        for (int i = 0; i < fresh.triangles_a_cell(); ++i) {
          const size_t place = size_t((cell.y * fresh.memory().x + cell.x) * fresh.triangles_a_cell() + i);
          const SeedGround &a = moved.ground()[place], &b = fresh.ground()[place];
          ASSERT_EQ(a.area, b.area);
          ASSERT_EQ(a.texel, b.texel);
          ASSERT_EQ(a.texel_fraction, b.texel_fraction);
          ASSERT_EQ(a.bound, b.bound);
          ASSERT_EQ(a.exclusions == 0, b.exclusions == 0);
          solid += a.area > 0;
          shaped += a.exclusions != 0;
          // Runs lie elsewhere, and say the same.
          for (size_t k = 0; a.exclusions != 0; ++k) {
            const glm::vec4 run = moved.exclusions()[a.exclusions + k];
            ASSERT_EQ(run, fresh.exclusions()[b.exclusions + k]);
            if (run == glm::vec4(0.0f)) break;
          }
        }
      }
  }
  EXPECT_GT(solid, 1000u);
  EXPECT_GT(shaped, 10u);
}

TEST(ClipmapTable, HoldsTheSameAfterAnyWayAsAFreshOne) {
  expect_same_after_any_way(8);
  expect_same_after_any_way(4);
}

TEST(ClipmapTable, ReadsOnlyWhatTheWindowHasComeTo) {
  const ClipmapGround ground;
  const Layer layer = layer_of(8, 40);
  ClipmapTable table(layer, *ground.surface, map_over(*ground.field));
  View view = view_over(ground, {0.5, 0.5}, 2, 0, 0);
  ASSERT_TRUE(table.follow(view, nullptr));
  ASSERT_TRUE(table.follow(view, nullptr));
  EXPECT_TRUE(table.written().empty());
  view.eye.x += 4;  // a cell of this level
  ASSERT_TRUE(table.follow(view, nullptr));
  size_t triangles = 0;
  for (const ClipmapTable::Run& run : table.written()) triangles += run.count;
  EXPECT_EQ(triangles, size_t(table.cells().y * table.triangles_a_cell()));
}

TEST(ClipmapTable, ShapesThatChangeAreFollowed) {
  const ClipmapGround ground;
  const Layer layer = layer_of(8, 40);
  ClipmapTable table(layer, *ground.surface, map_over(*ground.field));
  const View view = view_over(ground, {0, 0}, 2, 0, 0);
  const auto solid = [&] {
    size_t count = 0;
    for (const SeedGround& triangle : table.ground()) count += triangle.area > 0;
    return count;
  };
  Exclusions exclusions;
  ASSERT_TRUE(table.follow(view, &exclusions));
  const size_t before = solid();
  const auto disc = exclusions.add(ExclusionShape::disc({0, 0}, 20));
  ASSERT_TRUE(disc);
  ASSERT_TRUE(table.follow(view, &exclusions));
  EXPECT_LT(solid(), before);
  EXPECT_TRUE(exclusions.remove(*disc));
  ASSERT_TRUE(table.follow(view, &exclusions));
  EXPECT_EQ(solid(), before);
}

TEST(ClipmapTable, EditsAreReadAgain) {
  ClipmapGround ground;
  const Layer layer = layer_of(8, 80);
  const ColorMap map = map_over(*ground.field);
  ClipmapTable table(layer, *ground.surface, map);
  const View view = view_over(ground, {0, 0}, 2, 0, 0);
  ASSERT_TRUE(table.follow(view, nullptr));
  const auto edited = edit(*ground.field, *ground.bounds, {Edit::Kind::raise, EditRegion::disc({5, 5}, 12, 6), 9.0});
  ASSERT_TRUE(edited) << edited.error().message;
  table.changed(edited->changed);
  ASSERT_TRUE(table.follow(view, nullptr));
  ClipmapTable fresh(layer, *ground.surface, map);
  ASSERT_TRUE(fresh.follow(view, nullptr));
  size_t read = 0;
  for (const ClipmapTable::Run& run : table.written()) read += run.count;
  EXPECT_LT(read, table.candidates() / 2);
  for (size_t i = 0; i < fresh.ground().size(); ++i) ASSERT_EQ(table.ground()[i].area, fresh.ground()[i].area);
}

TEST(ClipmapTable, GroundThatFeedsNothingIsLeftOut) {
  const ClipmapGround ground;
  ColorMap map = map_over(*ground.field);
  for (int i = 0; i < 64 * 64; ++i)
    if (i % 64 < 32) map.texels[size_t(i)] = {120, 90, 60, 255};
  Layer layer = layer_of(8, 60);
  const glm::vec3 green(0.25f, 0.615f, 0.51f), brown(0.0833f, 0.5f, 0.47f);
  layer.species[0].reference_hsv = green;
  layer.species[0].max_distance = 0.05f;
  SeasonValues as_green, as_brown;
  as_green.reference_hsv = green;
  as_brown.reference_hsv = brown;
  layer.species[0].seasons = {{0.0f, as_green}, {0.5f, as_brown}};
  const View view = view_over(ground, {0, 0}, 2, 0, 0);
  const auto solid = [&](const ClipmapTable& table, bool west) {
    size_t count = 0;
    for (const SeedGround& triangle : table.ground())
      count += triangle.area > 0 && (west ? triangle.texel.x < 14 : triangle.texel.x > 49);
    return count;
  };
  map.bounds = bound_colors(map);
  layer.horizon_m = 200;  // beyond the tiles that hold both colours
  ClipmapTable table(layer, *ground.surface, map);
  ASSERT_TRUE(table.follow(view, nullptr));
  EXPECT_EQ(solid(table, true), 0u);
  EXPECT_GT(solid(table, false), 500u);
  table.set_season(0.5f);
  ASSERT_TRUE(table.follow(view, nullptr));
  EXPECT_GT(solid(table, true), 500u);
  EXPECT_EQ(solid(table, false), 0u);
}

TEST(ClipmapTable, RefusesHorizonsOfTooManyTriangles) {
  const ClipmapGround ground;
  ClipmapTable table(layer_of(0.2, 5000), *ground.surface, map_over(*ground.field));
  const auto followed = table.follow(view_over(ground, {0, 0}, 2, 0, 0), nullptr);
  ASSERT_FALSE(followed);
  EXPECT_NE(followed.error().message.find("horizon"), std::string::npos) << followed.error().message;
}

}  // namespace
}  // namespace sward
