// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Clipmap rings without GL: what they hold, what they read, where the drawn surface is.
#include "clipmap_support.h"

#include <sward/terrain/edits.h>

#include <random>

namespace sward {
namespace {

using namespace test;

ClipmapRings rings_over(const ClipmapGround& ground, int texels = 64) {
  auto rings = ClipmapRings::create(*ground.surface, {texels});
  EXPECT_TRUE(rings) << rings.error().message;
  return std::move(*rings);
}

size_t points_of(std::span<const ClipmapRings::Change> changes) {
  size_t points = 0;
  for (const auto& change : changes) points += size_t(change.size.x) * size_t(change.size.y);
  return points;
}

/// Every point of every ring's window holds the surface's height and relief.
void expect_current(const ClipmapRings& rings) {
  const int side = rings.cells() + 1, mask = rings.texels() - 1;
  for (int ring = rings.finest(); ring < rings.rings(); ++ring) {
    const LatticeGrid grid{rings.first(ring) * (1 << rings.shift(ring)), 1 << rings.shift(ring), glm::ivec2(side)};
    std::vector<float> heights(grid.size());
    std::vector<glm::vec2> relief(grid.size());
    rings.surface().grid_heights(grid, rings.base(), heights);
    rings.surface().grid_relief(grid, relief);
    size_t wrong = 0;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const glm::ivec2 at = (rings.first(ring) + glm::ivec2(column, row)) & mask;
        const size_t held = size_t(at.y) * size_t(rings.texels()) + size_t(at.x), i = size_t(row * side + column);
        wrong += rings.heights(ring)[held] != heights[i];
        if (!rings.relief(ring).empty()) wrong += rings.relief(ring)[held] != relief[i];
      }
    EXPECT_EQ(wrong, 0u) << "ring " << ring;
  }
}

TEST(ClipmapRings, RefusesSizesOutOfRange) {
  const ClipmapGround ground;
  for (const int texels : {0, 32, 100, 2048}) EXPECT_FALSE(ClipmapRings::create(*ground.surface, {texels})) << texels;
}

TEST(ClipmapRings, HoldTheSurfaceOnAnyWay) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  EXPECT_GE(rings.rings(), 4);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> step(-12, 12), anywhere(-400, 400);
  glm::dvec2 at(0);
  for (int i = 0; i < 40; ++i) {
    at = i % 10 == 9 ? glm::dvec2(anywhere(random), anywhere(random)) : at + glm::dvec2(step(random), step(random));
    View view = view_over(ground, glm::clamp(at, -250.0, 250.0), 1.7, 0, 0);
    view.eye.x = at.x;
    view.eye.y = at.y;
    rings.follow(view);
    ASSERT_TRUE(rings.settled());
    ASSERT_EQ(rings.finest(), 0);
    expect_current(rings);
  }
}

TEST(ClipmapRings, ReadOnlyWhatTheyHaveComeTo) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  View view = view_over(ground, {10.1, -20.2}, 1.7, 0, 0);
  rings.follow(view);
  EXPECT_EQ(points_of(rings.follow(view)), 0u);
  view.eye.z += 0.5;
  EXPECT_EQ(points_of(rings.follow(view)), 0u);
  // Two cells of the finest ring east: two columns of it, and of the next one at most.
  view.eye.x += 1.0;
  const size_t column = size_t(rings.cells() + 1);
  const size_t points = points_of(rings.follow(view));
  EXPECT_GE(points, 2 * column);
  EXPECT_LE(points, 4 * column);
}

TEST(ClipmapRings, AFrameReadsNoMoreThanAllowed) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  const size_t whole = size_t(rings.cells() + 1) * size_t(rings.cells() + 1);
  const View view = view_over(ground, {0, 0}, 1.7, 0, 0);
  EXPECT_EQ(rings.finest(), rings.rings());
  for (int frame = 0; frame < rings.rings(); ++frame) {
    EXPECT_FALSE(rings.settled());
    EXPECT_LE(points_of(rings.follow(view, 0)), whole);
    EXPECT_EQ(rings.finest(), rings.rings() - 1 - frame);
    EXPECT_TRUE(std::isfinite(rings.height({3, 4})));
  }
  EXPECT_TRUE(rings.settled());
  // After a jump the same: coarse ground at once, the rest ring by ring.
  const View far = view_over(ground, {200, 200}, 1.7, 0, 0);
  int frames = 0;
  for (; frames < 20 && (frames == 0 || !rings.settled()); ++frames) EXPECT_LE(points_of(rings.follow(far, 0)), whole);
  EXPECT_TRUE(rings.settled());
  EXPECT_LE(frames, rings.rings());
  expect_current(rings);
}

TEST(ClipmapRings, TheFinestRingIsTheFinestSurface) {
  for (const glm::dvec3 origin : {glm::dvec3(0), glm::dvec3(1e7, -1e7, 300)}) {
    const ClipmapGround ground({.origin = origin});
    ClipmapRings rings = rings_over(ground, 128);
    const View view = view_over(ground, {31.3, 17.9}, 1.7, 0, 0);
    rings.follow(view);
    // Cells of half a metre.
    const double reach = 0.5 * rings.melt_begin() - 0.5;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> offset(-reach, reach);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 xy = glm::dvec2(view.eye) + glm::dvec2(offset(random), offset(random));
      EXPECT_NEAR(rings.height(xy), ground.field->height(xy), 2e-5);
    }
  }
}

TEST(ClipmapRings, NeighboursMeetAtEveryBorder) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(0, 1), anywhere(-180, 180);
  const Lattice& lattice = ground.field->lattice();
  size_t asked = 0;
  for (int trial = 0; trial < 20; ++trial) {
    rings.follow(view_over(ground, {anywhere(random), anywhere(random)}, 1.7, 0, 0));
    for (int ring = rings.finest(); ring + 1 < rings.rings(); ++ring) {
      const double side = std::ldexp(1.0, rings.shift(ring));
      const glm::dvec2 low = glm::dvec2(rings.first(ring)) * side, high = low + side * rings.cells();
      for (int i = 0; i < 100; ++i) {
        const bool vertical = i % 2 == 0, end = i % 4 < 2;
        glm::dvec2 at = low + (high - low) * along(random);
        (vertical ? at.x : at.y) = end ? (vertical ? high.x : high.y) : (vertical ? low.x : low.y);
        const glm::dvec2 across = vertical ? glm::dvec2(0.01, 0) : glm::dvec2(0, 0.01);
        const auto world = [&](glm::dvec2 p) {
          return glm::dvec2(lattice.world_xy({0, 0})) +
                 p / double(lattice.sample_step()) * glm::dvec2(lattice.spacing.x, -lattice.spacing.y);
        };
        const double a = rings.height(world(at - across)), b = rings.height(world(at + across));
        if (std::isnan(a) || std::isnan(b)) continue;
        ++asked;
        // The two places are a third of a millimetre apart.
        EXPECT_NEAR(a, b, 2e-3) << "ring " << ring;
      }
    }
  }
  EXPECT_GT(asked, 3000u);
}

TEST(ClipmapRings, TheDrawnSurfaceMovesSmoothlyWithTheEye) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  View view = view_over(ground, {0, 0}, 1.7, 0, 0);
  std::vector<glm::dvec2> places;
  for (int i = -60; i <= 60; i += 3)
    for (int j = -60; j <= 60; j += 7) places.emplace_back(i + 0.2, j + 0.3);
  std::vector<double> before(places.size(), NAN);
  double largest = 0;
  for (int frame = 0; frame < 300; ++frame) {
    rings.follow(view);
    for (size_t i = 0; i < places.size(); ++i) {
      const double z = rings.height(places[i]);
      if (frame > 0) largest = std::max(largest, std::abs(z - before[i]));
      before[i] = z;
    }
    view.eye += glm::dvec3(0.025, 0.011, frame < 150 ? 0.3 : -0.3);
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(largest, 0.12);
}

TEST(ClipmapRings, HighAboveTheGroundTheFinestAreLeftOut) {
  const ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  int before = -1;
  for (const double above : {1.7, 30.0, 100.0, 400.0}) {
    rings.follow(view_over(ground, {0, 0}, above, 0, -90));
    EXPECT_GT(rings.finest(), before) << above;
    before = rings.finest();
    if (above == 30.0) before = 0;
  }
  EXPECT_LT(rings.finest(), rings.rings());
}

TEST(ClipmapRings, EditsAreReadAgain) {
  ClipmapGround ground;
  ClipmapRings rings = rings_over(ground);
  const View view = view_over(ground, {0, 0}, 1.7, 0, 0);
  rings.follow(view);
  const double before = rings.height({2, 3});
  const auto edited = edit(*ground.field, *ground.bounds, {Edit::Kind::flatten, EditRegion::disc({0, 0}, 25), 9.0});
  ASSERT_TRUE(edited) << edited.error().message;
  rings.changed(edited->changed);
  EXPECT_FALSE(rings.settled());
  EXPECT_NEAR(rings.height({2, 3}), before, 1e-9);
  const size_t points = points_of(rings.follow(view));
  EXPECT_GT(points, 0u);
  EXPECT_NEAR(rings.height({2, 3}), ground.field->height(glm::dvec2(2, 3)), 1e-4);
  expect_current(rings);
}

TEST(ClipmapRings, WhatIsInThePictureIsInABlockThatIsDrawn) {
  const ClipmapGround ground({.samples = {97, 129}, .spacing = {4, 5}});
  ClipmapRings rings = rings_over(ground);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-150, 150), angle(-180, 180), unit(0, 1);
  const Lattice& lattice = ground.field->lattice();
  std::vector<ClipmapRings::Block> blocks;
  size_t inside = 0, drawn = 0, all = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const View view = view_over(ground, {anywhere(random), anywhere(random)}, 1 + 60 * unit(random), angle(random),
                                -70 * unit(random));
    rings.follow(view);
    rings.visible_blocks(view, blocks);
    drawn += blocks.size();
    const int a_side = rings.cells() / ClipmapRings::k_block_cells;
    all += size_t(rings.rings() * a_side * a_side);
    const glm::dmat4 clip = view.clip_from_relative();
    for (int i = 0; i < 400; ++i) {
      const glm::dvec2 xy =
          lattice.min_corner() + (lattice.max_corner() - lattice.min_corner()) * glm::dvec2(unit(random), unit(random));
      const glm::dvec4 c = clip * glm::dvec4(glm::dvec3(xy, rings.height(xy)) - view.eye, 1);
      if (c.w <= 0.1 || std::abs(c.x) > c.w || std::abs(c.y) > c.w) continue;
      ++inside;
      const glm::dvec2 place = lattice.from_world(xy);
      int covering = 0;
      for (const ClipmapRings::Block& block : blocks) {
        const double side = std::ldexp(1.0, rings.shift(block.ring));
        const glm::dvec2 cell = place / side;
        const glm::dvec2 first(rings.first(block.ring) + ClipmapRings::k_block_cells * block.place);
        const bool in = glm::all(glm::greaterThanEqual(cell, first)) &&
                        glm::all(glm::lessThan(cell, first + double(ClipmapRings::k_block_cells)));
        bool finer = false;
        if (block.ring > rings.finest()) {
          const glm::dvec2 hole(rings.first(block.ring - 1) / 2);
          finer = glm::all(glm::greaterThanEqual(cell, hole)) &&
                  glm::all(glm::lessThan(cell, hole + double(rings.cells() / 2)));
        }
        covering += in && !finer;
      }
      EXPECT_EQ(covering, 1);
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_LT(double(drawn), 0.6 * double(all));
}

}  // namespace
}  // namespace sward
