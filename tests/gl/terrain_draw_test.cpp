// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Pictures of small generated fields: what the terrain's and the sky's shaders compute, and what their draws leave.
#include <sward/terrain/edits.h>
#include <sward/terrain_gl/terrain_renderer.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "gl/gl_fixture.h"
#include "host/render_target.h"
#include "host/sky.h"

namespace sward {
namespace {

constexpr double k_pi = std::numbers::pi;

using Height = double (*)(double x, double y);

/// A field with everything that draws it. Heights are functions of metres from the field's middle.
struct World {
  HeightField field;
  ColorMap colors;
  std::optional<Bounds> bounds;
  std::optional<RoamMesh> mesh;
  std::optional<gl::GroundTextures> ground;

  World(glm::ivec2 samples, double spacing, glm::dvec3 origin, Height height, ColorMap map)
      : field(make_field(samples, spacing, origin, height)), colors(std::move(map)) {
    colors.min_corner = field.min_corner();
    colors.size = field.max_corner() - field.min_corner();
    bounds = Bounds::create(field, 1);
    RoamOptions options;
    options.max_triangles = 4000;
    Expected<RoamMesh> made = RoamMesh::create(*bounds, options);
    EXPECT_TRUE(made) << made.error().message;
    mesh = std::move(*made);
    Expected<gl::GroundTextures> textures = gl::GroundTextures::create(field, colors);
    EXPECT_TRUE(textures) << textures.error().message;
    ground = std::move(*textures);
  }

  static HeightField make_field(glm::ivec2 samples, double spacing, glm::dvec3 origin, Height height) {
    HeightFieldDesc desc;
    desc.columns = samples.x;
    desc.rows = samples.y;
    desc.spacing = glm::dvec2(spacing);
    desc.origin = origin;
    desc.relief.enabled = false;
    std::vector<float> heights;
    for (int row = 0; row < samples.y; ++row) {
      for (int column = 0; column < samples.x; ++column) {
        heights.push_back(
            float(height((column - (samples.x - 1) / 2.0) * spacing, ((samples.y - 1) / 2.0 - row) * spacing)));
      }
    }
    Expected<HeightField> field = HeightField::create(desc, std::move(heights));
    EXPECT_TRUE(field) << field.error().message;
    return std::move(*field);
  }
};

ColorMap map_of(int width, int height, std::vector<glm::u8vec3> colors) {
  ColorMap map;
  map.width = width;
  map.height = height;
  for (int i = 0; i < width * height; ++i) map.texels.emplace_back(colors[size_t(i) % colors.size()], 255);
  return map;
}

double flat(double, double) {
  return 5;
}
double hills(double x, double y) {
  return 30 * std::sin(x / 60) * std::cos(y / 45) + 6 * std::sin(x / 17 + 1) * std::sin(y / 23);
}

/// No haze and no shadows of it: the answers stay simple.
gl::Lighting plain_light() {
  gl::Lighting light;
  light.sun_azimuth = 0.9f;
  light.sun_elevation = 0.8f;
  light.haze_distance_m = 1e12f;
  return light;
}

View straight_down(glm::dvec3 eye, glm::ivec2 size, double fov_y) {
  return View::look(eye, k_pi / 2, -k_pi / 2, fov_y, size, 1, 1e6);  // the picture's top is north
}

double decode(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

/// The documented output: exposure, then half of the tone curve a channel and half on luminance, then sRGB.
glm::dvec3 expected_code(const gl::Lighting& light, glm::dvec3 radiance) {
  const auto curve = [](double x) { return 1 - std::exp(-1.15 * x * x / (x + 0.03)); };
  const glm::dvec3 exposed = radiance * double(light.exposure);
  const double luminance = 0.2126 * exposed.r + 0.7152 * exposed.g + 0.0722 * exposed.b;
  glm::dvec3 code;
  for (int i = 0; i < 3; ++i) {
    const double mapped = 0.5 * curve(exposed[i]) + 0.5 * exposed[i] * curve(luminance) / luminance;
    code[i] = 255 * (mapped <= 0.0031308 ? 12.92 * mapped : 1.055 * std::pow(mapped, 1 / 2.4) - 0.055);
  }
  return code;
}

/// Lambert's law with the sky's light on ground of this normal.
glm::dvec3 expected_ground(const gl::Lighting& light, glm::u8vec3 color, glm::dvec3 normal) {
  const glm::dvec3 sun(std::cos(light.sun_elevation) * std::cos(light.sun_azimuth),
                       std::cos(light.sun_elevation) * std::sin(light.sun_azimuth), std::sin(light.sun_elevation));
  const double up = normal.z;
  const glm::dvec3 above =
      glm::mix(glm::dvec3(light.horizon_radiance), glm::dvec3(light.sky_radiance), 0.55 + 0.25 * up);
  const double t = (up + 1) / 2;
  const glm::dvec3 ambient = glm::mix(glm::dvec3(light.ground_radiance), above, t * t * (3 - 2 * t));
  glm::dvec3 radiance;
  for (int i = 0; i < 3; ++i) {
    radiance[i] =
        decode(color[i] / 255.0) * (ambient[i] + light.sun_radiance[i] * std::max(glm::dot(sun, normal), 0.0));
  }
  return radiance;
}

struct Picture {
  glm::ivec2 size{0};
  std::vector<uint8_t> rgb;
  glm::ivec3 at(int x, int y) const {
    const uint8_t* p = &rgb[size_t(y * size.x + x) * 3];
    return {p[0], p[1], p[2]};
  }
  bool empty(int x, int y) const { return at(x, y) == glm::ivec3(0); }
};

class TerrainDraw : public test::GlTest {
 protected:
  void TearDown() override {
    if (!test::shared_context()) return;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_DEPTH_TEST);
    GlTest::TearDown();
  }

  TerrainRenderer make_renderer() {
    Expected<TerrainRenderer> renderer = TerrainRenderer::create(library_);
    EXPECT_TRUE(renderer) << renderer.error().message;
    return std::move(*renderer);
  }

  Picture draw(TerrainRenderer& renderer, const World& world, const View& view, const gl::Lighting& light,
               int samples = 1) {
    Expected<gl::Frame> frame = gl::Frame::create();
    EXPECT_TRUE(frame) << frame.error().message;
    frame->upload(view, light, 0, samples);
    Expected<host::RenderTarget> target = host::RenderTarget::create(view.viewport, samples);
    EXPECT_TRUE(target) << target.error().message;
    target->begin();
    renderer.draw(view, *frame, *world.ground);
    return {view.viewport, target->read_rgb()};
  }

  Picture update_and_draw(World& world, const View& view, const gl::Lighting& light) {
    TerrainRenderer renderer = make_renderer();
    EXPECT_TRUE(world.mesh->update(view));
    renderer.upload(*world.mesh);
    return draw(renderer, world, view, light);
  }

  gl::ShaderLibrary library_;
};

int largest_difference(const Picture& a, const Picture& b) {
  int most = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(int(a.rgb[i]) - int(b.rgb[i])));
  return most;
}

void expect_code(glm::ivec3 pixel, glm::dvec3 expected, double tolerance, const char* what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], expected[i], tolerance) << what << ", channel " << i;
}

// From so high that a pixel covers more than any detail, the ground has the base map's colour, lit.
TEST_F(TerrainDraw, FlatGroundFromFarAboveIsTheBaseMapLit) {
  const glm::u8vec3 grass(90, 122, 53);
  World world({33, 33}, 1000, {0, 0, 0}, flat, map_of(4, 4, {grass}));
  const gl::Lighting light = plain_light();
  const Picture picture = update_and_draw(world, straight_down({0, 0, 30000}, {64, 64}, 0.8), light);
  const glm::dvec3 expected = expected_code(light, expected_ground(light, grass, {0, 0, 1}));
  for (int y = 0; y < 64; y += 7) {
    for (int x = 0; x < 64; x += 7) expect_code(picture.at(x, y), expected, 1.5, "grass");
  }
}

TEST_F(TerrainDraw, SlopesFaceTheSunByTheSlopeMap) {
  const glm::u8vec3 grey(128, 128, 128);
  const gl::Lighting light = plain_light();
  for (const Height height :
       {Height([](double x, double) { return 0.5 * x; }), Height([](double, double y) { return 0.4 * y; })}) {
    const double dx = height(1, 0) - height(0, 0), dy = height(0, 1) - height(0, 0);
    World world({33, 33}, 1000, {0, 0, 0}, height, map_of(1, 1, {grey}));
    const Picture picture = update_and_draw(world, straight_down({0, 0, 40000}, {32, 32}, 0.4), light);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-dx, -dy, 1));
    expect_code(picture.at(16, 16), expected_code(light, expected_ground(light, grey, normal)), 1.5, "slope");
  }
}

TEST_F(TerrainDraw, LinearOutputIsRadiance) {
  const glm::u8vec3 grey(150, 150, 150);
  World world({33, 33}, 1000, {0, 0, 0}, flat, map_of(1, 1, {grey}));
  gl::Lighting light = plain_light();
  light.sun_radiance = glm::vec3(1);
  light.encode_srgb = false;
  const Picture picture = update_and_draw(world, straight_down({0, 0, 30000}, {16, 16}, 0.5), light);
  expect_code(picture.at(8, 8), 255.0 * expected_ground(light, grey, {0, 0, 1}), 1.5, "radiance");
}

TEST_F(TerrainDraw, HazeTakesItsShareOfADistance) {
  World world(
      {33, 33}, 1000, {0, 0, 0}, [](double, double) { return 0.0; }, map_of(1, 1, {{0, 0, 0}}));
  gl::Lighting light = plain_light();
  light.sun_elevation = -0.2f;  // no sun, so no glow in the haze
  light.haze_height_m = 1e9f;   // uniform
  light.haze_distance_m = 20000;
  light.encode_srgb = false;
  light.horizon_radiance = {0.8f, 0.8f, 0.8f};
  const View view = straight_down({0, 0, 20000}, {15, 15}, 0.1);
  const Picture picture = update_and_draw(world, view, light);
  // Green has lost 1 - 1/e of its light after the haze distance; straight down is between ahead and away from the sun.
  EXPECT_NEAR(picture.at(7, 7).g, 255 * 0.8 * (1 - std::exp(-1)), 0.06 * 204);
  EXPECT_GT(picture.at(7, 7).b, picture.at(7, 7).g) << "blue is scattered first";
  EXPECT_GT(picture.at(7, 7).g, picture.at(7, 7).r);
}

TEST_F(TerrainDraw, BaseMapLiesTheRightWayRound) {
  const std::vector<glm::u8vec3> quadrants{
      {220, 40, 40}, {40, 200, 40}, {180, 180, 40}, {200, 40, 190}};  // NW NE SW SE
  ColorMap map;
  map.width = map.height = 16;
  for (int i = 0; i < 256; ++i) map.texels.emplace_back(quadrants[size_t(i / 128 * 2 + i % 16 / 8)], 255);
  World world({33, 33}, 1000, {3e5, -2e5, 0}, flat, map);
  const gl::Lighting light = plain_light();
  const Picture picture =
      update_and_draw(world, straight_down({3e5, -2e5, 40000}, {65, 65}, 2 * std::atan(0.4)), light);
  // The picture shows 32 km across: a texel's centre is a quarter of the picture from its corner.
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 pixel(i % 2 == 0 ? 16 : 48, i / 2 == 0 ? 16 : 48);
    expect_code(picture.at(pixel.x, pixel.y),
                expected_code(light, expected_ground(light, quadrants[size_t(i)], {0, 0, 1})), 6, "quadrant");
  }
}

// Structure below the texels neither brightens nor tints the ground on the whole.
TEST_F(TerrainDraw, DetailKeepsTheMeanColourAndAddsStructure) {
  const glm::u8vec3 grass(90, 122, 53);
  World world({257, 257}, 1, {0, 0, 0}, flat, map_of(2, 2, {grass}));
  gl::Lighting light = plain_light();
  light.encode_srgb = false;
  light.sun_elevation = float(k_pi / 2);  // clods' slopes matter least
  light.sun_radiance *= 0.5f;
  const glm::dvec3 expected = 255.0 * expected_ground(light, grass, {0, 0, 1});
  glm::dvec3 mean(0);
  double deviation = 0;
  for (int i = 0; i < 9; ++i) {
    const glm::dvec3 eye(-80 + i % 3 * 80, -80 + i / 3 * 80, 25);
    const Picture picture = update_and_draw(world, straight_down(eye, {128, 128}, 1.4), light);
    for (int pixel = 0; pixel < 128 * 128; ++pixel) {
      const glm::dvec3 color(picture.at(pixel % 128, pixel / 128));
      mean += color / (9 * 128.0 * 128.0);
      deviation += std::pow(color.g - expected.g, 2) / (9 * 128.0 * 128.0);
    }
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i] / expected[i], 1, 0.04) << i;
  EXPECT_GT(std::sqrt(deviation) / expected.g, 0.04);
}

TEST_F(TerrainDraw, PaddingIsNotDrawn) {
  // 33 x 24 samples: whole root squares reach beyond the data in the south.
  World world({33, 24}, 10, {0, 0, 0}, flat, map_of(2, 2, {{200, 200, 200}}));
  ASSERT_NE((world.field.desc().rows - 1) % (1 << world.field.root_bits()), 0) << "the field must need padding";
  const View view = straight_down({0, 0, 505}, {200, 200}, 2 * std::atan(0.4));  // 2 m a pixel, 400 m across
  const Picture picture = update_and_draw(world, view, plain_light());
  // Data: x within +-160 m, y within +-115 m: pixels 20..179, 43..156.
  int covered = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool inside = x > 20 && x < 179 && y > 43 && y < 156;
      const bool outside = x < 19 || x > 180 || y < 42 || y > 158;
      if (inside) {
        EXPECT_FALSE(picture.empty(x, y)) << x << " " << y;
      }
      if (outside) {
        EXPECT_TRUE(picture.empty(x, y)) << x << " " << y;
      }
      covered += picture.empty(x, y) ? 0 : 1;
    }
  }
  EXPECT_NEAR(covered, 160 * 115, 400);
}

TEST_F(TerrainDraw, FarFromTheOriginThePictureIsTheSame) {
  const std::vector<glm::u8vec3> colors{{90, 122, 53}, {120, 100, 70}, {60, 90, 40}};
  Picture pictures[2];
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 origin =
        i == 0 ? glm::dvec3(0) : glm::dvec3(1024.0 * 9765, -1024.0 * 9000, 0);  // whole noise periods
    World world({65, 65}, 8, origin, hills, map_of(16, 16, colors));
    const View view = View::look(origin + glm::dvec3(-100.25, 30.5, 60), 0.3, -0.35, 0.9, {160, 120}, 0.5, 5000);
    pictures[i] = update_and_draw(world, view, gl::Lighting::clear_day(2, 0.7f));
  }
  EXPECT_LE(largest_difference(pictures[0], pictures[1]), 3);
}

/// A camera that turns and flies over the hills.
View flight_view(int frame) {
  return View::look({-150.0 + 12 * frame, 20.0 * std::sin(frame * 0.4), 45}, 0.05 * frame, -0.3, 0.9, {96, 72}, 0.5,
                    5000);
}

TEST_F(TerrainDraw, UploadingChangesGivesTheSamePictureAsUploadingAll) {
  World world({65, 65}, 8, {0, 0, 0}, hills, map_of(8, 8, {{90, 122, 53}, {150, 130, 90}}));
  TerrainRenderer incremental = make_renderer();
  const gl::Lighting light = plain_light();
  for (int frame = 0; frame < 24; ++frame) {
    const View view = flight_view(frame);
    ASSERT_TRUE(world.mesh->update(view));
    if (frame % 7 == 5) continue;  // a missed update must be noticed
    EXPECT_GT(incremental.upload(*world.mesh), 0u);
    EXPECT_EQ(incremental.triangles(), world.mesh->visible_indices().size() / 3);
    if (frame % 3 != 0) continue;
    TerrainRenderer fresh = make_renderer();
    fresh.upload(*world.mesh);
    EXPECT_EQ(largest_difference(draw(incremental, world, view, light), draw(fresh, world, view, light)), 0) << frame;
  }
}

TEST_F(TerrainDraw, EditedGroundLooksAsIfMadeThatWay) {
  const ColorMap map = map_of(8, 8, {{90, 122, 53}, {150, 130, 90}});
  World edited({65, 65}, 8, {0, 0, 0}, hills, map), still({65, 65}, 8, {0, 0, 0}, hills, map);
  const View view = flight_view(4);
  const Picture before = update_and_draw(edited, view, plain_light());
  Edit crater;
  crater.kind = Edit::Kind::crater;
  crater.region = EditRegion::disc({10, 20}, 60);
  crater.metres = 18;
  const auto change = [&](World& world) {
    const Expected<EditResult> result = edit(world.field, *world.bounds, crater);
    EXPECT_TRUE(result) << result.error().message;
    world.mesh->surface_changed(result->changed);
    return result->changed;
  };
  edited.ground->update_slopes(edited.field, change(edited));
  change(still);
  World anew({65, 65}, 8, {0, 0, 0}, hills, map);
  change(anew);
  anew.ground = std::move(*gl::GroundTextures::create(anew.field, anew.colors));
  const Picture expected = update_and_draw(anew, view, plain_light());
  EXPECT_EQ(largest_difference(update_and_draw(edited, view, plain_light()), expected), 0);
  EXPECT_GT(largest_difference(before, expected), 30);
  EXPECT_GT(largest_difference(update_and_draw(still, view, plain_light()), expected), 30) << "shaded by old slopes";
}

TEST_F(TerrainDraw, UploadWritesOnlyWhatChanged) {
  World world({65, 65}, 8, {0, 0, 0}, hills, map_of(8, 8, {{90, 122, 53}}));
  TerrainRenderer renderer = make_renderer();
  const View view = flight_view(3);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.mesh->update(view));
  const size_t all = renderer.upload(*world.mesh);
  const size_t indices = world.mesh->visible_indices().size_bytes();
  EXPECT_EQ(all, indices + world.mesh->vertices().size_bytes());
  EXPECT_EQ(renderer.upload(*world.mesh), 0u) << "nothing happened since";
  ASSERT_TRUE(world.mesh->update(view));
  EXPECT_EQ(renderer.upload(*world.mesh), 0u) << "a still view changes nothing";
}

TEST_F(TerrainDraw, AnotherMeshIsUploadedWhole) {
  World first({33, 33}, 10, {0, 0, 0}, hills, map_of(2, 2, {{90, 122, 53}}));
  World second({33, 33}, 10, {0, 0, 0}, flat, map_of(2, 2, {{90, 122, 53}}));
  const View view = View::look({-100, 0, 60}, 0, -0.4, 0.9, {64, 48}, 0.5, 5000);
  TerrainRenderer renderer = make_renderer();
  ASSERT_TRUE(first.mesh->update(view));
  ASSERT_TRUE(second.mesh->update(view));
  renderer.upload(*first.mesh);
  renderer.upload(*second.mesh);
  TerrainRenderer fresh = make_renderer();
  fresh.upload(*second.mesh);
  EXPECT_EQ(largest_difference(draw(renderer, second, view, plain_light()), draw(fresh, second, view, plain_light())),
            0);
}

TEST_F(TerrainDraw, UploadAndDrawLeaveWhatTheyDocument) {
  World world({33, 33}, 10, {0, 0, 0}, hills, map_of(2, 2, {{90, 122, 53}}));
  gl::Bindings bindings;
  bindings.frame = 3;
  bindings.base_map = 9;
  bindings.slope_map = 11;
  bindings.materials = 8;
  bindings.detail = 2;
  bindings.detail_slope = 6;
  Expected<TerrainRenderer> renderer = TerrainRenderer::create(library_, bindings);
  ASSERT_TRUE(renderer) << renderer.error().message;
  Expected<host::Sky> sky = host::Sky::create(library_, bindings);
  ASSERT_TRUE(sky) << sky.error().message;
  Expected<gl::Frame> frame = gl::Frame::create(bindings);
  ASSERT_TRUE(frame);
  Expected<host::RenderTarget> target = host::RenderTarget::create({64, 48}, 1);
  ASSERT_TRUE(target);
  const View view = View::look({-100, 0, 60}, 0, -0.1, 0.9, {64, 48}, 0.5, 5000);
  frame->upload(view, {}, 0, 1);
  ASSERT_TRUE(world.mesh->update(view));
  target->begin();
  Picture picture;
  {
    const test::PoisonedState poison;
    const test::GlState before = test::capture_state();
    renderer->upload(*world.mesh);
    test::expect_only_changed(before, test::capture_state(), {});
    renderer->draw(view, *frame, *world.ground);
    test::GlState left{{"program", {0}}, {"vertex array", {0}}};
    for (const GLuint index : {3u, 7u, 8u}) test::add_empty_uniforms(left, index);
    for (const GLuint unit : {17u, 9u, 11u, 2u, 6u}) test::add_empty_unit(left, unit);
    test::expect_only_changed(before, test::capture_state(), left);
  }
  {
    const test::PoisonedState poison;
    const test::GlState before = test::capture_state();
    sky->draw(*frame);
    test::expect_only_changed(before, test::capture_state(),
                              {{"program", {0}}, {"vertex array", {0}}, {"uniform buffer 3", {0}}});
  }
  picture = {{64, 48}, target->read_rgb()};
  // Moved bindings and foreign state change nothing in the picture: terrain below, sky above, no hole.
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) EXPECT_FALSE(picture.empty(x, y)) << x << " " << y;
  }
  EXPECT_GT(picture.at(32, 1).b, picture.at(32, 1).r) << "sky";
  EXPECT_GT(picture.at(32, 46).g, picture.at(32, 46).b) << "grass";
}

TEST_F(TerrainDraw, SkyMeetsTheHazeAtTheHorizonUnderAnyProjection) {
  Expected<host::Sky> sky = host::Sky::create(library_);
  ASSERT_TRUE(sky) << sky.error().message;
  Expected<gl::Frame> frame = gl::Frame::create();
  ASSERT_TRUE(frame);
  Expected<host::RenderTarget> target = host::RenderTarget::create({64, 64}, 1);
  ASSERT_TRUE(target);
  gl::Lighting light = gl::Lighting::clear_day(2.5f, -0.1f);  // no sun: the horizon has one colour
  View view = View::look({0, 0, 0}, 0.4, 0.0, 0.9, {64, 64}, 0.5, 5000);
  Picture pictures[2];
  for (int i = 0; i < 2; ++i) {
    if (i == 1) {
      // The same frustum without a far plane.
      view.clip_from_eye[2][2] = -1;
      view.clip_from_eye[3][2] = -2 * 0.5;
    }
    frame->upload(view, light, 0, 1);
    target->begin();
    sky->draw(*frame);
    pictures[i] = {{64, 64}, target->read_rgb()};
  }
  EXPECT_LE(largest_difference(pictures[0], pictures[1]), 1);
  const glm::ivec3 horizon = pictures[0].at(32, 32), top = pictures[0].at(32, 0);
  const glm::dvec3 haze = expected_code(light, glm::dvec3(light.horizon_radiance) * 0.97);
  expect_code(horizon, haze, 8, "horizon");
  EXPECT_NE(horizon, top);
}

}  // namespace
}  // namespace sward
