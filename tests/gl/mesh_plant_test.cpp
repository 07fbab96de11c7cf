// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants that are small meshes: where they land on the screen, how they bend, their colours and shadows.
#include <sward/vegetation/mesh_surface.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {
namespace {

using namespace test;

class MeshPlants : public GlTest {};

constexpr glm::ivec2 k_size{160, 120};
constexpr double k_degree = std::numbers::pi / 180;

/// A square pillar of `rings` + 1 rings, so that it can bend: 0.2 of its height across, red below, blue above.
std::shared_ptr<const TriangleMesh> pillar(int rings) {
  TriangleMesh mesh;
  for (int ring = 0; ring <= rings; ++ring) {
    const double z = 3.0 * ring / rings;
    for (int side = 0; side < 4; ++side) {
      const double x = side == 1 || side == 2 ? 0.2 : -0.2, y = side >= 2 ? 0.2 : -0.2;
      mesh.positions.emplace_back(x, y, z);
      mesh.colors.push_back(ring * 2 <= rings ? glm::u8vec3(200, 20, 20) : glm::u8vec3(20, 20, 200));
    }
  }
  for (uint32_t ring = 0; ring < uint32_t(rings); ++ring)
    for (uint32_t side = 0; side < 4; ++side) {
      const uint32_t a = 4 * ring + side, b = 4 * ring + (side + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 4, a, b + 4, a + 4});
    }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// One plant on 16 x 16 m.
Layer lone(float stiffness, bool shadows = false) {
  Layer layer;
  layer.species = {grass_of("pillar", k_green)};
  Species& species = layer.species[0];
  species.kind = PlantKind::mesh;
  species.mesh.mesh = pillar(12);
  species.height_m = {1, 1};
  species.width_m = {0.2f, 0.2f};
  species.stiffness = {stiffness, stiffness};
  species.lean = 0;
  species.age_share = 0;
  species.root_shade = 1;
  layer.plain = true;
  layer.density = 1.0f / 256;
  layer.full_distance_m = layer.horizon_m = layer.full_segments_m = layer.shadow_distance_m = 1000;
  layer.shadows = shadows;
  return layer;
}

FixedTriangles half_of_the_patch(const View& view) {
  FixedTriangles all = level_ground(k_side, 0, view.eye, 1000), one;
  FixedTriangle t = all[0];
  t.distance = 0.01f;
  one.push_back(t);
  return one;
}

std::vector<uint8_t> picture(Patch& patch, const View& view) {
  auto target = host::RenderTarget::create(k_size, patch.samples);
  EXPECT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(view, half_of_the_patch(view));
  patch.classify(target->framebuffer());
  patch.draw();
  return target->read_rgb();
}

Plant only_plant(Patch& patch) {
  picture(patch, View::look({8, -8, 20}, 0, -1.5, 1, k_size, 0.05, 100));
  const std::vector<Plant> plants = patch.plants_of_gpu();
  EXPECT_EQ(plants.size(), 1u);
  return plants.empty() ? Plant{} : plants.front();
}

struct Pixel {
  int x, y;
  glm::ivec3 rgb;
};
std::vector<Pixel> lit(const std::vector<uint8_t>& rgb) {
  std::vector<Pixel> pixels;
  for (int y = 0; y < k_size.y; ++y)
    for (int x = 0; x < k_size.x; ++x) {
      const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
      if (p[0] + p[1] + p[2] > 0) pixels.push_back({x, y, {p[0], p[1], p[2]}});
    }
  return pixels;
}

/// At half a plant's height, across its azimuth where `across`, from 4 m.
View beside(const Plant& plant, double distance, double fov) {
  const double yaw = double(plant.azimuth) + std::numbers::pi / 2;
  const glm::dvec3 back(-std::cos(yaw), -std::sin(yaw), 0);
  return View::look(plant.position + glm::dvec3(0, 0, 0.5) + distance * back, yaw, 0, fov, k_size, 0.05, 100);
}

TEST_F(MeshPlants, StandUprightInTheirOwnColours) {
  Patch patch(lone(1), plain_map(k_side, 8, k_green));
  patch.level = 0;
  const Plant plant = only_plant(patch);
  const double distance = 4, fov = 18 * k_degree, pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  const auto pixels = lit(picture(patch, beside(plant, distance, fov)));
  ASSERT_GT(pixels.size(), 100u);
  double low = 1e9, high = -1e9;
  size_t wrong = 0;
  std::vector<int> breadth(size_t(k_size.y));  // by row: even the stiffest bend a little
  for (const Pixel& p : pixels) {
    const double up = 0.5 + (0.5 * k_size.y - p.y - 0.5) * pixel;
    low = std::min(low, up), high = std::max(high, up);
    ++breadth[size_t(p.y)];
    if (std::abs(up - 0.5) > 0.12) wrong += (up < 0.5) != (p.rgb.r > p.rgb.b);
  }
  EXPECT_NEAR(low, 0, 3 * pixel);
  EXPECT_NEAR(high, plant.height, 3 * pixel);
  // 0.2 m across the corners, turned at random: 0.14 to 0.2.
  EXPECT_NEAR(pixel * *std::max_element(breadth.begin(), breadth.end()), 0.17, 0.04 + pixel);
  EXPECT_EQ(wrong, 0u);
}

// The way along the axis, over the bend, is the plant's height.
TEST_F(MeshPlants, KeepTheirLengthWhenTheyBend) {
  Patch patch(lone(0.45f), plain_map(k_side, 8, k_green));
  patch.level = 0;
  const Plant plant = only_plant(patch);
  const double distance = 4, fov = 34 * k_degree, pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  const auto pixels = lit(picture(patch, beside(plant, distance, fov)));
  ASSERT_GT(pixels.size(), 100u);
  double farthest = 0, highest = 0, area = 0;
  for (const Pixel& p : pixels) {
    const glm::dvec2 at((p.x + 0.5 - 0.5 * k_size.x) * pixel, 0.5 + (0.5 * k_size.y - p.y - 0.5) * pixel);
    farthest = std::max(farthest, glm::length(at));
    highest = std::max(highest, at.y);
    area += pixel * pixel;
  }
  EXPECT_LT(highest, 0.95 * double(plant.height)) << "it does not bend";
  EXPECT_LT(farthest, double(plant.height) + 0.1);
  // Length times the breadth that it has when it stands.
  EXPECT_NEAR(area, 0.17 * double(plant.height), 0.05);
}

TEST_F(MeshPlants, CoverAsMuchWithFewerFaces) {
  Patch patch(lone(1), plain_map(k_side, 8, k_green));
  patch.level = 0;
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  const Plant plant = only_plant(patch);
  // The light of a plant of 100 pixels and of one of 25.
  const auto light = [&](double distance) {
    double sum = 0;
    for (const Pixel& p : lit(picture(patch, beside(plant, distance, 24 * k_degree))))
      sum += std::min(p.rgb.r + p.rgb.g + p.rgb.b, 150);
    return sum * distance * distance;
  };
  const double near = light(3), far = light(11);
  EXPECT_NEAR(far / near, 1.0, 0.45);
}

TEST_F(MeshPlants, LayTheirShadowOnTheGround) {
  const glm::dvec3 down(0, 0, -1);
  Patch with(lone(1, true), plain_map(k_side, 8, k_green)), without(lone(1, false), plain_map(k_side, 8, k_green));
  with.level = without.level = 0;
  with.lighting.sun_azimuth = without.lighting.sun_azimuth = 0;
  with.lighting.sun_elevation = without.lighting.sun_elevation = 0.6f;
  const Plant plant = only_plant(with);
  const View above =
      View::look(plant.position + glm::dvec3(0, 0, 6), 0, -0.5 * std::numbers::pi, 0.7, k_size, 0.05, 100);
  const auto shadow = lit(picture(with, above)), plain = lit(picture(without, above));
  EXPECT_GT(shadow.size(), 2 * plain.size());
  // West of it, which is down in a picture that looks east and down.
  double mean = 0;
  for (const Pixel& p : shadow) mean += p.y + 0.5 - 0.5 * k_size.y;
  EXPECT_GT(mean / double(shadow.size()), 3.0);
}

TEST_F(MeshPlants, ManyAreDrawnWholeOnSoftwareRenderers) {
  Layer layer = lone(1);
  layer.density = 8;
  layer.triangle_area_m2 = 8;
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.level = 4;
  const View view = View::look({8, -8, 14}, 0, -0.5 * std::numbers::pi, 1.2, k_size, 0.05, 1000);
  auto target = host::RenderTarget::create(k_size, 1);
  target->begin();
  patch.look(view);
  patch.classify(target->framebuffer());
  patch.draw();
  const auto pixels = lit(target->read_rgb());
  // Roots in every part of the patch have a plant.
  std::vector<int> parts(16);
  for (const Pixel& p : pixels) ++parts[size_t(p.y / 30 * 4 + p.x / 40)];
  for (const int part : {5, 6, 9, 10}) EXPECT_GT(parts[size_t(part)], 30) << part;
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
}

TEST(MeshPlantShaders, AreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  const std::string path = testing::TempDir() + "sward_mesh_plant.";
  const gl::ShaderLibrary shaders;
  for (const bool on_mesh : {false, true}) {
    Layer layer;
    layer.on_mesh = on_mesh;
    for (const std::string stage : {"tesc", "tese", "geom", "frag"}) {
      const auto text = shaders.resolve("mesh_plant." + stage + ".glsl", layer_defines(layer, {}));
      ASSERT_TRUE(text) << text.error().message;
      std::ofstream(path + stage) << text->text;
      EXPECT_EQ(std::system(("glslangValidator " + path + stage).c_str()), 0) << stage;
      std::filesystem::remove(path + stage);
    }
  }
}

}  // namespace
}  // namespace sward
