// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Slopes for shading: which tiles are where, what is written, and that windows look like the whole map.
#include <sward/gl/slope_map.h>
#include <sward/terrain_gl/terrain_renderer.h>

#include <cmath>
#include <map>
#include <random>

#include "../../terrain/src/gl/slope_tiles.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"
#include "world_support.h"

namespace sward {
namespace {

using gl::k_slope_tile;
using gl::SlopeTiles;

// What each place of the texture holds, by layer and place, written as told.
class Texture {
 public:
  void write(const SlopeTiles& tiles, const std::vector<SlopeTiles::Tile>& some) {
    for (const SlopeTiles::Tile& tile : some) {
      const SlopeTiles::Box box = tiles.box(tile);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_GE(box.place[axis], 0);
        EXPECT_LE(box.place[axis] + box.size[axis], tiles.texels()[axis]);
        EXPECT_EQ(box.place[axis], box.first[axis] % tiles.texels()[axis]);
      }
      held_[{tile.layer, {box.place.x, box.place.y}}] = box.first;
    }
  }
  // Whether texel (of the whole surface) of a layer is where it belongs.
  bool holds(const SlopeTiles& tiles, int layer, glm::ivec2 texel) const {
    const glm::ivec2 first = texel / k_slope_tile * k_slope_tile, place = first % tiles.texels();
    const auto found = held_.find({layer, {place.x, place.y}});
    return found != held_.end() && found->second == first;
  }

 private:
  std::map<std::pair<int, std::pair<int, int>>, glm::ivec2> held_;
};

TEST(SlopeTiles, OneLayerWhereAllFits) {
  SlopeTiles tiles({300, 200}, 512, 300);
  EXPECT_EQ(tiles.layers(), 1);
  EXPECT_EQ(tiles.texels(), glm::ivec2(300, 200));
  EXPECT_FALSE(tiles.settled());
  Texture texture;
  texture.write(tiles, tiles.take(0));  // all of it is missing, and comes at once
  EXPECT_TRUE(tiles.settled());
  for (const glm::ivec2 texel : {glm::ivec2(0), glm::ivec2(299, 199), glm::ivec2(128, 127)})
    EXPECT_TRUE(texture.holds(tiles, 0, texel));
  tiles.changed({127, 0}, {127, 0});  // the next sample's difference reads it
  EXPECT_EQ(tiles.take(9).size(), 2u);
  EXPECT_TRUE(tiles.settled());
}

// Whatever the eye does and however little is written a frame, what a picture reads is there.
TEST(SlopeTiles, ReachIsAlwaysFilled) {
  const glm::ivec2 samples(40000, 9000);
  SlopeTiles tiles(samples, 1024, 4097);
  ASSERT_EQ(tiles.layers(), 4);
  EXPECT_EQ(tiles.stride(3), 64);
  Texture texture;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  glm::dvec2 eye(20000, 100), speed(10, 4);
  size_t most = 0;
  for (int frame = 0; frame < 3000; ++frame) {
    if (frame % 500 == 499) eye = glm::dvec2(samples) * (0.5 + 0.6 * glm::dvec2(unit(random), unit(random)));
    if (frame % 50 == 0) speed = 12.0 * glm::dvec2(unit(random), unit(random));
    eye += speed;
    if (frame % 100 == 50) tiles.changed(glm::ivec2(eye), glm::ivec2(eye) + 1000);
    tiles.follow(eye);
    const auto taken = tiles.take(4);
    if (frame % 500 != 499 && frame > 0) most = std::max(most, taken.size());
    texture.write(tiles, taken);
    for (int layer = 0; layer < 4; ++layer)
      for (int i = 0; i < 20; ++i) {
        const double reach = layer == 3 ? 1e9 : tiles.reach() * tiles.stride(layer);
        const glm::dvec2 at = eye + reach * glm::dvec2(unit(random), unit(random));
        const glm::ivec2 sample(glm::clamp(at, glm::dvec2(0), glm::dvec2(samples - 1)));
        if (layer < 3 && glm::any(glm::greaterThan(glm::abs(glm::dvec2(sample) - eye), glm::dvec2(reach)))) continue;
        ASSERT_TRUE(texture.holds(tiles, layer, sample / tiles.stride(layer)))
            << "frame " << frame << " layer " << layer << " sample " << sample.x << " " << sample.y;
      }
  }
  EXPECT_LE(most, 4u) << "windows move within the budget";
  for (int i = 0; i < 400 && !tiles.settled(); ++i) tiles.take(4);
  EXPECT_TRUE(tiles.settled());
}

TEST(SlopeTiles, WhatHasChangedIsReadAgainNearestFirst) {
  SlopeTiles tiles({4000, 4000}, 512, 4000);
  const glm::dvec2 eye(2000, 2000);
  tiles.follow(eye);
  tiles.take(0);
  ASSERT_TRUE(tiles.settled());
  tiles.changed({0, 0}, {3999, 3999});
  double before = 0;
  size_t count = 0;
  for (auto some = tiles.take(10); !some.empty(); some = tiles.take(10)) {
    EXPECT_LE(some.size(), 10u);
    for (const SlopeTiles::Tile& tile : some) {
      EXPECT_GE(tile.distance, before);
      before = tile.distance;
      ++count;
    }
  }
  EXPECT_EQ(count, 32u * 32u);
}

class SlopeMap : public test::GlTest {
 protected:
  static std::vector<glm::vec2> read(const gl::SlopeMap& map, glm::ivec2 size, int level = 0) {
    std::vector<glm::vec2> slopes(size_t(size.x) * size_t(size.y) * size_t(map.layers()));
    glGetTextureImage(map.texture(), level, GL_RG, GL_FLOAT, GLsizei(slopes.size() * sizeof(glm::vec2)), slopes.data());
    return slopes;
  }
};

HeightField field_of(const world_support::Heights& heights) {
  HeightFieldDesc desc;
  desc.columns = heights.desc.columns;
  desc.rows = heights.desc.rows;
  desc.spacing = heights.desc.spacing;
  desc.scale = heights.desc.scale;
  desc.relief.enabled = false;
  std::vector<uint16_t> samples(heights.samples.begin(), heights.samples.end());
  return HeightField::create(desc, std::move(samples)).value();
}

// A world's map is its field's once all squares are there, and was another before.
TEST_F(SlopeMap, OfAWorldFollowsWhatIsResident) {
  const auto heights = world_support::make_heights(world_support::make_desc({3, 2}, 6, 2));
  const auto world = world_support::make_world(heights, world_support::loader_of(heights), world_support::roomy());
  const HeightField field = field_of(heights);
  const glm::ivec2 size(heights.desc.columns, heights.desc.rows);
  auto map = gl::SlopeMap::create(*world);
  const auto whole = gl::SlopeMap::create(field);
  ASSERT_TRUE(map && whole);
  EXPECT_EQ(map->layers(), 1);
  EXPECT_EQ(map->layer_min(0), whole->layer_min(0));
  EXPECT_EQ(map->layer_size(0), whole->layer_size(0));
  EXPECT_FALSE(map->settled());
  {
    const test::PoisonedState poison;
    const test::GlState state = test::capture_state();
    map->follow(*world, {0, 0}, 0);
    test::expect_only_changed(state, test::capture_state(), {});
  }
  EXPECT_TRUE(map->settled());
  EXPECT_NE(read(*map, size), read(*whole, size)) << "nothing is resident yet";
  for (const LatticeBox& box : world_support::settle(*world, world_support::view_over(*world))) map->changed(box);
  while (!map->settled()) map->follow(*world, {0, 0}, 2);
  EXPECT_EQ(read(*map, size), read(*whole, size));
}

TEST_F(SlopeMap, RefusesWindowsThatAreNone) {
  const auto heights = world_support::make_heights(world_support::make_desc({1, 1}, 4, 2));
  const auto world = world_support::make_world(heights, world_support::loader_of(heights), world_support::roomy());
  for (const int window : {0, 256, 1000, 16384}) {
    const auto map = gl::SlopeMap::create(*world, {4097, window});
    ASSERT_FALSE(map) << window;
    EXPECT_NE(map.error().message.find(std::to_string(window)), std::string::npos) << map.error().message;
  }
}

// Gentle hills of several lengths, so that a coarser window shows the same.
world_support::Heights gentle_hills() {
  world_support::Heights heights{world_support::make_desc({3, 3}, 10, 4), {}, {}};
  for (int row = 0; row < heights.desc.rows; ++row)
    for (int column = 0; column < heights.desc.columns; ++column)
      heights.samples.push_back(float(std::lround(30000 + 9000 * std::sin(column * 0.013) * std::cos(row * 0.011) +
                                                  1500 * std::sin(column * 0.05 + row * 0.04))));
  return heights;
}

// Every texel of every level of every layer that has been written is the mean of the four below it.
TEST_F(SlopeMap, LevelsOfWindowsAreMeans) {
  const auto heights = gentle_hills();
  const HeightField field = field_of(heights);
  const Bounds bounds = Bounds::create(field);
  const FieldSurface surface(bounds);
  auto map = gl::SlopeMap::create(surface, {1024, 512});
  ASSERT_TRUE(map);
  map->follow(surface, {1237, -2411}, 1000);
  map->follow(surface, {-9237, 8411}, 1000);
  std::vector<glm::vec2> finer = read(*map, {512, 512});
  double sum = 0;
  for (int level = 1; level < 7; ++level) {
    const int side = 512 >> level, below = 2 * side;
    const std::vector<glm::vec2> coarser = read(*map, {side, side}, level);
    for (int layer = 0; layer < map->layers(); ++layer)
      for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
          const glm::vec2* at = &finer[size_t((layer * below + 2 * row) * below + 2 * column)];
          const glm::vec2 mean = 0.25f * (at[0] + at[1] + at[below] + at[below + 1]);
          const glm::vec2 found = coarser[size_t((layer * side + row) * side + column)];
          ASSERT_LT(glm::length(found - mean), 1e-3f) << level << " " << layer << " " << row << " " << column;
          sum += double(glm::length(found));
        }
    finer = coarser;
  }
  EXPECT_GT(sum, 100);
}

TEST_F(SlopeMap, WindowsShowWhatTheWholeMapShows) {
  const auto heights = gentle_hills();
  const HeightField field = field_of(heights);
  const Bounds bounds = Bounds::create(field);
  const FieldSurface surface(bounds);
  const ColorMap colors{1, 1, {{120, 120, 120, 255}}, field.min_corner(), field.max_corner() - field.min_corner()};
  auto whole = gl::GroundTextures::create(field, colors);
  auto windows = gl::GroundTextures::create(surface, colors, {1024, 512});
  auto terrain = TerrainRenderer::create(gl::ShaderLibrary());
  auto frame = gl::Frame::create();
  auto target = host::RenderTarget::create({320, 180}, 1);
  ASSERT_TRUE(whole && windows && terrain && frame && target);
  EXPECT_EQ(windows->slopes().layers(), 3);
  RoamOptions options;
  options.max_triangles = 20000;
  auto mesh = RoamMesh::create(bounds, options).value();
  auto lighting = gl::Lighting::clear_day(2.0f, 0.25f);
  lighting.haze_distance_m = 1e6f;
  const auto draw = [&](const View& view, const gl::GroundTextures& ground) {
    EXPECT_TRUE(mesh.update(view));
    terrain->upload(mesh);
    target->begin();
    frame->upload(view, lighting, 0, 1);
    terrain->draw(view, *frame, ground);
    return target->read_rgb();
  };
  // Off the middle, so that windows wrap; beyond the edge; then somewhere else.
  for (const glm::dvec3 eye : {glm::dvec3(1237, -2411, 600), {-15200, 14000, 900}, {4000, 9000, 2500}}) {
    const View view = View::look(eye, 0.7, -0.35, 0.87, {320, 180}, 1, 1e5);
    windows->slopes().follow(surface, glm::dvec2(eye), 0);
    const auto expected = draw(view, *whole), found = draw(view, *windows);
    ASSERT_EQ(expected.size(), found.size());
    double mean = 0, spread = 0;
    int most = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
      const int off = std::abs(int(expected[i]) - int(found[i]));
      mean += off;
      most = std::max(most, off);
      spread += std::abs(int(expected[i]) - int(expected[i / 3 * 3 + i % 3 >= 30 ? i - 30 : i]));
    }
    EXPECT_LT(mean / double(expected.size()), 0.8) << eye.x;
    EXPECT_LT(most, 40) << eye.x;
    EXPECT_GT(spread / double(expected.size()), 2) << "a picture without light says nothing";
  }
}

}  // namespace
}  // namespace sward
