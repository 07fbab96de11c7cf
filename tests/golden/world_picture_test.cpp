// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// A world of which everything is resident against the height field of the same samples: the same plants, the same
// picture.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "gl/gl_fixture.h"
#include "host/render_target.h"
#include "host/scene_renderer.h"
#include "world_support.h"

namespace {

using namespace sward;

constexpr glm::ivec2 k_size{320, 180};
// The same driver, the same mesh, the same slopes: only the order in which triangles came into being differs, and with
// it the edges of plants that are as far away as others.
constexpr double k_mean_limit = 0.1;  // of 255

// 3 x 2 squares, of which a field of these samples makes its bintree, too: ids are the same.
world_support::Heights make_hills() {
  WorldDesc desc = world_support::make_desc({3, 2}, 6, 2);
  desc.spacing = {2, 2};
  desc.scale = 0.001;
  desc.origin = {300, -700, 20};
  world_support::Heights heights{desc, {}, {}};
  for (int row = 0; row < desc.rows; ++row)
    for (int column = 0; column < desc.columns; ++column)
      heights.samples.push_back(float(std::lround(30000 + 8000 * std::sin(column * 0.071) * std::cos(row * 0.057) +
                                                  1200 * std::sin(column * 0.31 + row * 0.2))));
  return heights;
}

ColorMap make_colors(const Lattice& lattice) {
  ColorMap map{48, 32, {}, lattice.min_corner(), lattice.max_corner() - lattice.min_corner()};
  for (int i = 0; i < 48 * 32; ++i)
    map.texels.push_back((i / 6 + i / 48 / 5) % 2 == 0 ? glm::u8vec4(96, 118, 58, 255)
                                                       : glm::u8vec4(150, 138, 88, 255));
  return map;
}

Scene make_scene() {
  Scene scene;
  Layer layer;
  layer.horizon_m = 40;
  layer.density = 60;
  Species green, straw;
  green.name = "green";
  green.reference_hsv = {0.228f, 0.51f, 0.46f};
  straw.name = "straw";
  straw.reference_hsv = {0.134f, 0.41f, 0.59f};
  layer.species = {green, straw};
  scene.layers = {layer};
  scene.max_triangles = 6000;
  return scene;
}

std::unique_ptr<host::SceneTerrain> make_field(const world_support::Heights& heights) {
  HeightFieldDesc desc;
  desc.columns = heights.desc.columns;
  desc.rows = heights.desc.rows;
  desc.spacing = heights.desc.spacing;
  desc.origin = heights.desc.origin;
  desc.scale = heights.desc.scale;
  desc.relief.enabled = false;
  std::vector<uint16_t> samples(heights.samples.begin(), heights.samples.end());
  auto field = HeightField::create(desc, std::move(samples)).value();
  ColorMap colors = make_colors(field.lattice());
  return std::make_unique<host::SceneTerrain>(std::move(field), std::move(colors));
}

std::unique_ptr<host::SceneTerrain> make_world(const world_support::Heights& heights) {
  auto world = world_support::make_world(heights, world_support::loader_of(heights), world_support::roomy());
  ColorMap colors = make_colors(world->lattice());
  return std::make_unique<host::SceneTerrain>(std::move(world), std::move(colors));
}

View view_of(const host::SceneTerrain& terrain, glm::dvec2 from_middle, double above, double yaw, double pitch) {
  const glm::dvec2 xy = glm::dvec2(terrain.surface().lattice().origin) + from_middle;
  const glm::dvec3 eye(xy, terrain.surface().height(xy) + above);
  return View::look(eye, yaw, pitch, 0.87, k_size, 0.1, 2000);
}

using Standing = std::tuple<uint64_t, uint32_t, uint32_t, double, double, float, float>;
std::vector<Standing> standing(const std::vector<Plant>& plants) {
  std::vector<Standing> all;
  for (const Plant& p : plants)
    all.emplace_back(p.triangle.bits, p.rank, p.species, p.position.x, p.position.y, p.height, p.fade);
  std::sort(all.begin(), all.end());
  return all;
}

// Plants of a frame over the ground as it is, or after everything that the view wants has come.
std::vector<Standing> plants_of(const host::SceneTerrain& terrain, const View& view, host::SceneFrame& frame,
                                host::Streaming streaming) {
  EXPECT_TRUE(frame.stream(view, streaming));
  for (int i = 0; i < 200; ++i) {
    const auto stats = frame.mesh().update(view);
    EXPECT_TRUE(stats);
    if (stats->splits + stats->merges == 0 && !stats->capped) break;
  }
  frame.cut_triangles(view);
  frame.seed_triangles(view, terrain.colors());
  return standing(frame.plants(view, terrain.colors(), 0));
}

TEST(WorldPlants, AreThoseOfTheField) {
  const auto heights = make_hills();
  const auto field = make_field(heights), world = make_world(heights);
  ASSERT_EQ(field->surface().lattice(), world->surface().lattice());
  RoamOptions options;
  options.max_triangles = 6000;
  const Scene scene = make_scene();
  auto over_field = host::SceneFrame::create(scene.layers, *field, options);
  auto over_world = host::SceneFrame::create(scene.layers, *world, options);
  ASSERT_TRUE(over_field && over_world);
  // On a border of squares, and across a corner of four.
  const View first = view_of(*field, {0, -3}, 1.7, 1.4, -0.1), second = view_of(*field, {62, 2}, 6, 3.5, -0.3);
  const auto expected = plants_of(*field, first, *over_field, host::Streaming::live);
  EXPECT_GT(expected.size(), 3000u);
  // The first frame is drawn before anything is resident; densities follow coarse slopes then.
  EXPECT_NE(plants_of(*world, first, *over_world, host::Streaming::live), expected);
  EXPECT_EQ(plants_of(*world, first, *over_world, host::Streaming::wait), expected);
  EXPECT_EQ(plants_of(*world, second, *over_world, host::Streaming::wait),
            plants_of(*field, second, *over_field, host::Streaming::live));
}

class WorldPicture : public test::GlTest {
 protected:
  static std::vector<uint8_t> render(const host::SceneTerrain& terrain, const View& view) {
    const Scene scene = make_scene();
    if (terrain.world() != nullptr && !host::WorldStream(*terrain.world()).wait(view)) return {};
    auto renderer = host::SceneRenderer::create(scene, terrain, gl::ShaderLibrary());
    auto target = host::RenderTarget::create(k_size, 4);
    if (!renderer || !target) return {};
    renderer->set_streaming(host::Streaming::wait);
    target->begin();
    const auto lighting = gl::Lighting::clear_day(3.5f, 0.6f);
    auto stats = renderer->draw(view, lighting, 0, target->framebuffer(), target->samples(), true);
    EXPECT_TRUE(stats);
    EXPECT_EQ(stats->world.has_value(), terrain.world() != nullptr);
    return target->read_rgb();
  }
};

TEST_F(WorldPicture, IsTheFields) {
  const auto heights = make_hills();
  const auto field = make_field(heights), world = make_world(heights);
  const View views[] = {view_of(*field, {0, -3}, 1.7, 1.4, -0.1), view_of(*field, {62, 2}, 30, 3.5, -0.4),
                        view_of(*field, {-20, 10}, 120, 0, -1.5)};
  for (const View& view : views) {
    const auto expected = render(*field, view), found = render(*world, view);
    ASSERT_EQ(expected.size(), size_t(k_size.x) * size_t(k_size.y) * 3);
    ASSERT_EQ(found.size(), expected.size());
    double mean = 0;
    for (size_t i = 0; i < found.size(); ++i) mean += std::abs(int(found[i]) - int(expected[i]));
    EXPECT_LT(mean / double(found.size()), k_mean_limit);
    EXPECT_NE(*std::max_element(found.begin(), found.end()), *std::min_element(found.begin(), found.end()));
  }
}

// Squares come while frames are drawn: at the end the picture is the one of a world that was there from the start.
TEST_F(WorldPicture, StreamedInEndsAsTheSame) {
  const auto heights = make_hills();
  const auto there = make_world(heights), coming = make_world(heights);
  const Scene scene = make_scene();
  const View view = view_of(*make_field(heights), {0, -3}, 12, 1.4, -0.4);
  const auto expected = render(*there, view);
  auto renderer = host::SceneRenderer::create(scene, *coming, gl::ShaderLibrary());
  auto target = host::RenderTarget::create(k_size, 4);
  ASSERT_TRUE(renderer && target);
  const auto lighting = gl::Lighting::clear_day(3.5f, 0.6f);
  std::vector<uint8_t> first;
  double time = 0;
  int still = 0;
  for (int frame = 0; frame < 3000 && still < 10; ++frame) {
    target->begin();
    time += 1.0 / 15;
    auto stats = renderer->draw(view, lighting, time, target->framebuffer(), target->samples(), true);
    ASSERT_TRUE(stats) << stats.error().message;
    if (frame == 0) first = target->read_rgb();
    const bool quiet = coming->world()->settled() && stats->roam.splits + stats->roam.merges + stats->roam.moving == 0;
    still = quiet ? still + 1 : 0;
  }
  EXPECT_EQ(still, 10);
  const auto mean_to = [&](const std::vector<uint8_t>& picture) {
    double mean = 0;
    for (size_t i = 0; i < expected.size(); ++i) mean += std::abs(int(picture[i]) - int(expected[i]));
    return mean / double(expected.size());
  };
  // Plants do not move with the time; what differs is where equals were split.
  EXPECT_LT(mean_to(target->read_rgb()), 0.5);
  EXPECT_GT(mean_to(first), 2) << "the first frame has the coarse ground alone";
}

TEST(WorldStream, NamesSquaresThatCannotBeLoaded) {
  const auto heights = make_hills();
  const auto load = [inner = world_support::loader_of(heights)](const SquareRequest& request) -> Expected<SquareData> {
    if (request.square == glm::ivec2(1, 0)) return fail("the disk is gone");
    return inner(request);
  };
  auto made = world_support::make_world(heights, load, world_support::roomy());
  ColorMap colors = make_colors(made->lattice());
  const host::SceneTerrain terrain(std::move(made), std::move(colors));
  const View view = view_of(terrain, {0, 0}, 20, 0, -0.5);
  host::WorldStream stream(*terrain.world());
  const auto waited = stream.wait(view);
  ASSERT_FALSE(waited);
  EXPECT_NE(waited.error().message.find("1 square of the world cannot be loaded: square (1, 0): "), std::string::npos)
      << waited.error().message;
  EXPECT_NE(waited.error().message.find("the disk is gone"), std::string::npos);
  // Live frames go on, and say it once.
  testing::internal::CaptureStderr();
  for (int i = 0; i < 2000; ++i) {
    stream.step(view);
    if (terrain.world()->settled() && i > 100) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(terrain.world()->stats().resident, 5u);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(said.rfind("sward: warning: square (1, 0): the disk is gone", 0), 0u) << said;
  EXPECT_EQ(terrain.world()->failures().size(), 1u);
}

}  // namespace
