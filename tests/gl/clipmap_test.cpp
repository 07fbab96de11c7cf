// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Clipmap terrain drawn: no cracks, the mesh's picture, what its calls leave.
#include <sward/terrain_gl/clipmap_renderer.h>
#include <sward/terrain_gl/terrain_renderer.h>

#include <cmath>

#include "clipmap_support.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class ClipmapDraw : public GlTest {};

ColorMap patched_map(const HeightField& field) {
  ColorMap map;
  map.width = map.height = 64;
  for (int i = 0; i < 64 * 64; ++i) map.texels.emplace_back(60 + 3 * (i % 13), 90 + 2 * (i / 64 % 17), 40 + i % 7, 255);
  map.min_corner = field.min_corner();
  map.size = field.max_corner() - map.min_corner;
  return map;
}

/// A field, its clipmap and its mesh, drawn into a target.
struct Stage {
  ClipmapGround ground;
  gl::GroundTextures textures;
  gl::Clipmap clipmap;
  ClipmapRenderer renderer;
  gl::Frame frame;
  gl::Lighting light;

  explicit Stage(const ClipmapField& from, int texels = 64)
      : ground(from),
        textures(gl::GroundTextures::create(*ground.field, patched_map(*ground.field)).value()),
        clipmap(gl::Clipmap::create(*ground.surface, {texels}).value()),
        renderer(ClipmapRenderer::create(gl::ShaderLibrary()).value()),
        frame(gl::Frame::create().value()) {
    light.haze_distance_m = 1e12f;
  }

  std::vector<uint8_t> draw(const View& view, host::RenderTarget& target, glm::vec3 clear) {
    begin(target, clear);
    clipmap.follow(view);
    frame.upload(view, light, 0, target.samples());
    renderer.draw(view, clipmap, frame, textures);
    return target.read_rgb();
  }

  std::vector<uint8_t> draw_mesh(const View& view, host::RenderTarget& target, glm::vec3 clear) {
    RoamOptions options;
    options.max_triangles = 200000;
    RoamMesh mesh = RoamMesh::create(*ground.bounds, options).value();
    EXPECT_TRUE(mesh.update(view));
    TerrainRenderer terrain = TerrainRenderer::create(gl::ShaderLibrary()).value();
    terrain.upload(mesh);
    begin(target, clear);
    frame.upload(view, light, 0, target.samples());
    terrain.draw(view, frame, textures);
    return target.read_rgb();
  }

  static void begin(host::RenderTarget& target, glm::vec3 clear) {
    target.begin();
    glClearColor(clear.r, clear.g, clear.b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
};

/// Channels' mean difference, of 255.
double mean_difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(int(a[i]) - int(b[i]));
  return sum / double(a.size());
}

// Magenta behind the ground: green ground never has more blue than green. The eye looks down into rough ground that
// fills the picture, so that every ring's border is in it.
TEST_F(ClipmapDraw, NoCracks) {
  Stage stage({});
  size_t looked_at = 0;
  for (const int samples : {1, 4}) {
    if (samples > host::RenderTarget::max_samples()) continue;
    auto target = host::RenderTarget::create({320, 320}, samples);
    ASSERT_TRUE(target) << target.error().message;
    for (int i = 0; i < 12; ++i) {
      const glm::dvec2 at(17.3 * i - 90, 40 - 11.7 * i);
      const View view =
          view_over(stage.ground, at, i % 3 == 0 ? 100 : 3 + 5 * i, 30 * i, i % 3 == 0 ? -90 : -55, {320, 320});
      const std::vector<uint8_t> picture = stage.draw(view, *target, {1, 0, 1});
      size_t background = 0;
      for (size_t p = 0; p < picture.size(); p += 3) background += picture[p + 2] > picture[p + 1] + 8;
      EXPECT_EQ(background, 0u) << "eye " << i << ", " << samples << " samples";
      looked_at += picture.size() / 3;
      EXPECT_LT(stage.clipmap.rings().finest() + 2, stage.clipmap.rings().rings());
    }
  }
  EXPECT_GT(looked_at, 1000000u);
}

/// Straight down, without perspective: 200 m a side.
View map_view(View view) {
  constexpr double k_half = 100, k_near = -300, k_far = 300;
  view.clip_from_eye = glm::dmat4(1);
  view.clip_from_eye[0][0] = view.clip_from_eye[1][1] = 1 / k_half;
  view.clip_from_eye[2][2] = -2 / (k_far - k_near);
  view.clip_from_eye[3][2] = -(k_far + k_near) / (k_far - k_near);
  return view;
}

// A height field as a map, without a depth test: every pixel gets one fragment; two where rings overlap or a hole is
// not cut, none where they leave a gap.
TEST_F(ClipmapDraw, EveryPixelOnce) {
  Stage stage({});
  auto target = host::RenderTarget::create({320, 320}, 1);
  ASSERT_TRUE(target) << target.error().message;
  const gl::Query query = gl::create_query(GL_SAMPLES_PASSED);
  for (int i = 0; i < 16; ++i) {
    const View view =
        map_view(view_over(stage.ground, {11.3 * i - 80, 75 - 9.7 * i}, 1 + 2 * i, 17 * i, -90, {320, 320}));
    Stage::begin(*target, {1, 0, 1});
    stage.clipmap.follow(view);
    stage.frame.upload(view, stage.light, 0, 1);
    glDepthFunc(GL_ALWAYS);
    glBeginQuery(GL_SAMPLES_PASSED, query.id());
    stage.renderer.draw(view, stage.clipmap, stage.frame, stage.textures);
    glEndQuery(GL_SAMPLES_PASSED);
    glDepthFunc(GL_LESS);
    GLuint64 samples = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &samples);
    EXPECT_EQ(samples, GLuint64(320 * 320)) << i;
    EXPECT_LT(stage.clipmap.rings().finest() + 2, stage.clipmap.rings().rings());
  }
}

TEST_F(ClipmapDraw, ThePictureIsTheMeshs) {
  Stage stage({}, 256);
  auto target = host::RenderTarget::create({320, 180}, 1);
  ASSERT_TRUE(target) << target.error().message;
  for (const auto& [above, pitch] : {std::pair{1.7, -8.0}, {12.0, -25.0}, {60.0, -50.0}}) {
    const View view = view_over(stage.ground, {11, -23}, above, 70, pitch);
    const auto rings = stage.draw(view, *target, {0.5f, 0.7f, 0.9f});
    const auto mesh = stage.draw_mesh(view, *target, {0.5f, 0.7f, 0.9f});
    const double difference = mean_difference(rings, mesh);
    RecordProperty("mean_difference_" + std::to_string(int(above)) + "_m", std::to_string(difference));
    std::printf("%.1f m above the ground: mean difference %.3f of 255\n", above, difference);
    EXPECT_LT(difference, 1.0);
    // Not because nothing is drawn.
    EXPECT_GT(mean_difference(rings, std::vector<uint8_t>(rings.size(), rings[0])), 10.0);
  }
}

TEST_F(ClipmapDraw, FarFromTheOriginThePictureIsTheSame) {
  // Noise on the ground counts from the world's origin modulo 1024 m.
  Stage near({}), far({.origin = {1024.0 * 9766, -1024.0 * 9766, 200}});
  auto target = host::RenderTarget::create({320, 180}, 1);
  ASSERT_TRUE(target) << target.error().message;
  const auto a = near.draw(view_over(near.ground, {5, 9}, 1.7, 70, -12), *target, {0.5f, 0.7f, 0.9f});
  const auto b = far.draw(view_over(far.ground, {5, 9}, 1.7, 70, -12), *target, {0.5f, 0.7f, 0.9f});
  EXPECT_LT(mean_difference(a, b), 0.1);
}

TEST_F(ClipmapDraw, OneDrawOfTheBlocksInSight) {
  Stage stage({}, 256);
  auto target = host::RenderTarget::create({64, 36}, 1);
  ASSERT_TRUE(target) << target.error().message;
  stage.draw(view_over(stage.ground, {0, 0}, 1.7, 70, -5), *target, {1, 0, 1});
  const int a_side = stage.clipmap.rings().cells() / ClipmapRings::k_block_cells;
  EXPECT_GT(stage.renderer.blocks(), 20u);
  EXPECT_LT(stage.renderer.blocks(), uint32_t(stage.clipmap.rings().rings() * a_side * a_side) / 2);
}

TEST_F(ClipmapDraw, UploadsFollowTheMotion) {
  Stage stage({}, 256);
  View view = view_over(stage.ground, {0.1, 0.1}, 1.7, 70, -5);
  const gl::Clipmap::Upload first = stage.clipmap.follow(view);
  const size_t side = size_t(stage.clipmap.rings().cells() + 1);
  EXPECT_EQ(first.points, side * side * size_t(stage.clipmap.rings().rings()));
  EXPECT_EQ(stage.clipmap.follow(view).points, 0u);
  size_t most = 0;
  for (int i = 0; i < 100; ++i) {
    view.eye.x += 1.5 / 60;
    most = std::max(most, stage.clipmap.follow(view).points);
  }
  EXPECT_GT(most, 0u);
  EXPECT_LE(most, 4 * side);
}

}  // namespace
}  // namespace sward
