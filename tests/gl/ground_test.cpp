// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What GroundTextures puts on the GPU.
#include <sward/gl/ground.h>
#include <sward/terrain/edits.h>

#include <cmath>

#include "gl/gl_fixture.h"

namespace sward {
namespace {

class Ground : public test::GlTest {};

HeightField field_of(int columns, int rows, glm::dvec2 spacing, double (*height)(double x, double y)) {
  HeightFieldDesc desc;
  desc.columns = columns;
  desc.rows = rows;
  desc.spacing = spacing;
  desc.origin = {1000, 2000, 0};
  desc.relief.enabled = false;
  std::vector<float> samples;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      samples.push_back(float(height(column * spacing.x, -row * spacing.y)));
    }
  }
  Expected<HeightField> field = HeightField::create(desc, std::move(samples));
  EXPECT_TRUE(field) << field.error().message;
  return std::move(*field);
}

ColorMap numbered_map(int width, int height) {
  ColorMap map;
  map.width = width;
  map.height = height;
  map.min_corner = {-3, -4};
  map.size = {30, 20};
  for (int i = 0; i < width * height; ++i)
    map.texels.emplace_back(i * 7 % 256, i * 13 % 256, i * 29 % 256, i % 5 == 0 ? 0 : 255);
  return map;
}

std::vector<glm::vec2> read_slopes(const gl::GroundTextures& ground, glm::ivec2 size) {
  std::vector<glm::vec2> slopes(size_t(size.x * size.y));
  glGetTextureImage(ground.slopes().texture(), 0, GL_RG, GL_FLOAT, GLsizei(slopes.size() * sizeof(glm::vec2)),
                    slopes.data());
  return slopes;
}

TEST_F(Ground, RawViewHoldsTheFilesTexels) {
  const HeightField field = field_of(5, 5, {1, 1}, [](double, double) { return 0.0; });
  const ColorMap map = numbered_map(7, 5);  // rows of 28 bytes, odd sizes
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, map);
  ASSERT_TRUE(ground) << ground.error().message;
  std::vector<glm::u8vec4> read(35);
  glGetTextureImage(ground->base_map_raw(), 0, GL_RGBA, GL_UNSIGNED_BYTE, 140, read.data());
  for (size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], map.texels[i]) << i;
  GLint format = 0;
  glGetTextureLevelParameteriv(ground->base_map_raw(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  EXPECT_EQ(format, GL_RGBA8);
  glGetTextureLevelParameteriv(ground->base_map(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  EXPECT_EQ(format, GL_SRGB8_ALPHA8);
  GLint width = 0;
  glGetTextureLevelParameteriv(ground->base_map(), 2, GL_TEXTURE_WIDTH, &width);
  EXPECT_EQ(width, 1) << "the mip chain ends at one texel";
  EXPECT_EQ(ground->texels(), glm::ivec2(7, 5));
  EXPECT_EQ(ground->map_min(), map.min_corner);
  EXPECT_EQ(ground->map_size(), map.size);
}

// Averages of black and white are half the light, which is 188 when encoded, not 128.
TEST_F(Ground, MipsAverageLightNotCodes) {
  const HeightField field = field_of(3, 3, {1, 1}, [](double, double) { return 0.0; });
  ColorMap map;
  map.width = map.height = 2;
  map.texels = {{0, 0, 0, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}};
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, map);
  ASSERT_TRUE(ground) << ground.error().message;
  // Read through a view, so that the codes come back.
  GLuint view = 0;
  glGenTextures(1, &view);
  glTextureView(view, GL_TEXTURE_2D, ground->base_map(), GL_RGBA8, 1, 1, 0, 1);
  const gl::Texture owner(view);
  glm::u8vec4 texel{0};
  glGetTextureImage(view, 0, GL_RGBA, GL_UNSIGNED_BYTE, 4, &texel);
  EXPECT_NEAR(texel.r, 188, 2);
}

TEST_F(Ground, SlopesOfAPlaneAreItsGradientEverywhere) {
  const HeightField field = field_of(9, 6, {2, 5}, [](double x, double y) { return 0.5 * x - 0.25 * y; });
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, numbered_map(2, 2));
  ASSERT_TRUE(ground) << ground.error().message;
  for (const glm::vec2& slope : read_slopes(*ground, {9, 6})) {
    EXPECT_NEAR(slope.x, 0.5, 1e-3);
    EXPECT_NEAR(slope.y, -0.25, 1e-3);
  }
  // Texel centres stand on samples: the map reaches half a spacing beyond the data.
  EXPECT_EQ(ground->data_min(), glm::dvec2(1000 - 8, 2000 - 12.5));
  EXPECT_EQ(ground->data_max(), glm::dvec2(1000 + 8, 2000 + 12.5));
  EXPECT_EQ(ground->slopes().layer_min(0), glm::dvec2(1000 - 9, 2000 - 15));
  EXPECT_EQ(ground->slopes().layer_size(0), glm::dvec2(18, 30));
}

TEST_F(Ground, SlopesAreCentralDifferencesOfTheirOwnSample) {
  // z = x^2 / 8 + y^3 / 300: central differences are x / 4, and (3 y^2 + h^2) / 300 with h the spacing.
  const HeightField field = field_of(6, 7, {1, 2}, [](double x, double y) { return x * x / 8 + y * y * y / 300; });
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, numbered_map(3, 3));
  ASSERT_TRUE(ground) << ground.error().message;
  const std::vector<glm::vec2> slopes = read_slopes(*ground, {6, 7});
  for (int row = 1; row < 6; ++row) {
    for (int column = 1; column < 5; ++column) {
      const double y = -2.0 * row;
      EXPECT_NEAR(slopes[size_t(row * 6 + column)].x, column / 4.0, 2e-3) << column << " " << row;
      EXPECT_NEAR(slopes[size_t(row * 6 + column)].y, (3 * y * y + 4) / 300, 3e-3) << column << " " << row;
    }
  }
}

TEST_F(Ground, LargeFieldsAreUploadedInBandsWithoutSeams) {
  const HeightField field = field_of(3, 700, {1, 1}, [](double, double y) { return y * y / 2000; });
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, numbered_map(1, 1));
  ASSERT_TRUE(ground) << ground.error().message;
  const std::vector<glm::vec2> slopes = read_slopes(*ground, {3, 700});
  for (int row = 1; row < 699; ++row) EXPECT_NEAR(slopes[size_t(row) * 3].y, -row / 1000.0, 1e-3) << row;
}

// As if made from the edited field: every texel of every level, and no other state.
TEST_F(Ground, SlopesOfAnEditedFieldAreThoseOfANewMap) {
  HeightField field =
      field_of(75, 52, {2, 3}, [](double x, double y) { return std::sin(x / 9) + 0.3 * std::cos(y / 5); });
  Bounds bounds = Bounds::create(field, 1);
  const ColorMap map = numbered_map(5, 3);
  Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, map);
  ASSERT_TRUE(ground) << ground.error().message;
  const auto levels = [](const gl::GroundTextures& of) {
    std::vector<glm::vec2> all;
    for (glm::ivec2 size(75, 52);; size = glm::max(size / 2, glm::ivec2(1))) {
      std::vector<glm::vec2> level(size_t(size.x * size.y));
      const GLint number = GLint(std::log2(75 / size.x + 0.5));
      glGetTextureImage(of.slopes().texture(), number, GL_RG, GL_FLOAT, GLsizei(level.size() * sizeof(glm::vec2)),
                        level.data());
      all.insert(all.end(), level.begin(), level.end());
      if (size == glm::ivec2(1)) return all;
    }
  };
  const std::vector<glm::vec2> before = levels(*ground);
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  // In the middle, over a corner, one sample alone, over the whole of it.
  for (const EditRegion& region :
       {EditRegion::disc(0.5 * (low + high), 14), EditRegion::disc(low, 20, 5),
        EditRegion::disc(field.world_xy({0, 0}), 0.5), EditRegion::rectangle(low - 10.0, high + 10.0, 15)}) {
    Edit change;
    change.region = region;
    change.metres = 7;
    const Expected<EditResult> edited = edit(field, bounds, change);
    ASSERT_TRUE(edited) << edited.error().message;
    ASSERT_GT(edited->samples, 0);
    {
      const test::PoisonedState poison;
      const test::GlState state = test::capture_state();
      ground->update_slopes(field, edited->changed);
      test::expect_only_changed(state, test::capture_state(), {});
    }
    const Expected<gl::GroundTextures> anew = gl::GroundTextures::create(field, map);
    ASSERT_TRUE(anew) << anew.error().message;
    EXPECT_EQ(levels(*ground), levels(*anew));
  }
  EXPECT_NE(levels(*ground), before);
  const std::vector<glm::vec2> last = levels(*ground);
  ground->update_slopes(field, LatticeBox{});
  EXPECT_EQ(levels(*ground), last);
}

TEST_F(Ground, RefusesMapsBeyondTheDevice) {
  const HeightField field = field_of(3, 3, {1, 1}, [](double, double) { return 0.0; });
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  const Expected<gl::GroundTextures> ground = gl::GroundTextures::create(field, numbered_map(limit + 1, 1));
  ASSERT_FALSE(ground);
  EXPECT_NE(ground.error().message.find("base map of " + std::to_string(limit + 1) + " x 1"), std::string::npos);
  EXPECT_NE(ground.error().message.find(std::to_string(limit)), std::string::npos) << ground.error().message;
  ColorMap wrong = numbered_map(4, 4);
  wrong.texels.pop_back();
  EXPECT_FALSE(gl::GroundTextures::create(field, wrong));
}

TEST_F(Ground, CreationLeavesStateAsItWas) {
  const HeightField field = field_of(5, 4, {1, 1}, [](double x, double) { return x; });
  const ColorMap map = numbered_map(5, 3);
  Expected<gl::GroundTextures> ground = fail("not made");
  {
    const test::PoisonedState poison;
    const test::GlState before = test::capture_state();
    ground = gl::GroundTextures::create(field, map);
    test::expect_only_changed(before, test::capture_state(), {});
  }
  ASSERT_TRUE(ground) << ground.error().message;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  std::vector<glm::u8vec4> read(15);
  glGetTextureImage(ground->base_map_raw(), 0, GL_RGBA, GL_UNSIGNED_BYTE, 60, read.data());
  for (size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], map.texels[i]) << i;
}

}  // namespace
}  // namespace sward
