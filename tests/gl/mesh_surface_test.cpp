// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants on meshes: the twins, where plants land on the screen, the body below them.
#include <sward/scene/generated_mesh.h>
#include <sward/vegetation/mesh_renderer.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gl/twins.h"
#include "gl/vegetation_fixture.h"
#include "host/render_target.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {
namespace {

using namespace test;

class MeshSurfaces : public GlTest {};

constexpr glm::ivec2 k_size{160, 120};
constexpr double k_degree = std::numbers::pi / 180;

Layer ivy() {
  Layer layer;
  layer.species = {grass_of("ivy", k_green), bare_of("wood", k_brown)};
  layer.on_mesh = true;
  layer.triangle_area_m2 = 0.2f;
  layer.density = 120;
  layer.horizon_m = 30;
  layer.full_distance_m = 4;
  return layer;
}

/// A mesh with a layer on it, on both sides.
class Body {
 public:
  Body(Layer layer, const TriangleMesh& mesh) : layer_(std::move(layer)) {
    auto surface = MeshSurface::create(mesh);
    EXPECT_TRUE(surface) << surface.error().message;
    surface_.emplace(std::move(*surface));
    HeightFieldDesc desc;
    desc.columns = desc.rows = 5;
    desc.spacing = glm::dvec2(4);
    auto field = HeightField::create(desc, std::vector<float>(25, 0.0f));
    auto ground = gl::GroundTextures::create(*field, plain_map(k_side, 8, k_green));
    EXPECT_TRUE(ground) << ground.error().message;
    ground_.emplace(std::move(*ground));
    auto frame = gl::Frame::create();
    frame_ = std::move(*frame);
    auto renderer = VegetationRenderer::create(layer_, gl::ShaderLibrary());
    EXPECT_TRUE(renderer) << renderer.error().message;
    renderer_.emplace(std::move(*renderer));
    auto body = MeshRenderer::create(*surface_, layer_, gl::ShaderLibrary());
    EXPECT_TRUE(body) << body.error().message;
    body_.emplace(std::move(*body));
  }

  void look(const View& view) {
    view_ = view;
    FixedLevelOptions options;
    options.horizon_m = layer_.horizon_m * float(view.zoom());
    options.canopy_m = canopy_height(layer_);
    surface_->fixed_level_triangles(view, layer_.triangle_area_m2, options, triangles_);
    seed(layer_, view, *surface_, triangles_, seeding_);
    frame_.upload(view, lighting, 0, 1);
    EXPECT_TRUE(renderer_->upload(seeding_, triangles_, view));
  }

  std::vector<Plant> plants_of_gpu() {
    renderer_->classify(frame_, *ground_, 0);
    auto plants = renderer_->read_back(frame_, *ground_, view_, seeding_, 0);
    EXPECT_TRUE(plants) << plants.error().message;
    return std::move(*plants);
  }
  std::vector<Plant> plants_of_cpu() const { return grow_plants(layer_, view_, triangles_, seeding_); }

  /// On black.
  std::vector<uint8_t> picture(bool plants, bool body) {
    auto target = host::RenderTarget::create(k_size, 1);
    EXPECT_TRUE(target) << target.error().message;
    target->begin();
    if (body) body_->draw(view_, frame_);
    if (plants) {
      renderer_->classify(frame_, *ground_, target->framebuffer());
      renderer_->draw(frame_, *ground_);
    }
    return target->read_rgb();
  }

  gl::Lighting lighting;

 private:
  Layer layer_;
  std::optional<MeshSurface> surface_;
  View view_;
  FixedTriangles triangles_;
  Seeding seeding_;
  gl::Frame frame_;
  std::optional<gl::GroundTextures> ground_;
  std::optional<VegetationRenderer> renderer_;
  std::optional<MeshRenderer> body_;
};

TriangleMesh topiary() {
  auto mesh = generate_mesh_shape("topiary", {.size_m = {1.6, 1.6, 2.4}, .seed = 4});
  EXPECT_TRUE(mesh);
  // Patches of wood, where nothing grows.
  for (size_t i = 0; i < mesh->colors.size(); ++i) mesh->colors[i] = glm::u8vec3(i % 7 == 0 ? k_brown : k_green);
  return std::move(*mesh);
}

// Of a face each a colour and a direction.
TriangleMesh wall(glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v) {
  TriangleMesh mesh;
  mesh.positions = {origin, origin + u, origin + u + v, origin + v};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.paint(glm::u8vec3(k_green));
  return mesh;
}

TEST_F(MeshSurfaces, TwinsGrowTheSamePlants) {
  Body body(ivy(), topiary());
  for (const double angle : {0.3, 2.0, 4.4}) {
    const glm::dvec3 eye(-3.5 * std::cos(angle), -3.5 * std::sin(angle), 1.3 + 0.3 * angle);
    body.look(View::look(eye, angle, -0.1, 60 * k_degree, k_size, 0.05, 100));
    std::vector<Plant> gpu = body.plants_of_gpu(), cpu = body.plants_of_cpu();
    sort_plants(gpu);
    sort_plants(cpu);
    ASSERT_GT(cpu.size(), 200u);
    ASSERT_EQ(gpu.size(), cpu.size());
    for (size_t i = 0; i < gpu.size(); ++i) {
      const Plant &a = gpu[i], &b = cpu[i];
      ASSERT_EQ(plant_key(a), plant_key(b));
      EXPECT_LT(glm::length(a.position - b.position), 1e-3);
      EXPECT_NEAR(a.height, b.height, 1e-4f * b.height);
      EXPECT_NEAR(a.azimuth, b.azimuth, 1e-4f);
      EXPECT_NEAR(a.fade, b.fade, 1e-3f);
      EXPECT_EQ(a.axis, b.axis);
    }
  }
}

/// Extent of what is lit, metres from the eye's axis at a distance: right, up.
struct Extent {
  glm::dvec2 low{1e9}, high{-1e9};
  size_t lit = 0;
};
Extent extent_of(const std::vector<uint8_t>& rgb, double distance, double fov) {
  const double pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  Extent e;
  for (int y = 0; y < k_size.y; ++y)
    for (int x = 0; x < k_size.x; ++x) {
      const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
      if (p[0] + p[1] + p[2] == 0) continue;
      const glm::dvec2 at((x + 0.5 - 0.5 * k_size.x) * pixel, (0.5 * k_size.y - y - 0.5) * pixel);
      e.low = glm::min(e.low, at);
      e.high = glm::max(e.high, at);
      ++e.lit;
    }
  return e;
}

/// Stiff plants of one height, no lean.
Layer bristles(PlantKind kind, float height) {
  Layer layer = ivy();
  layer.species.resize(1);
  Species& species = layer.species[0];
  species.kind = kind;
  species.height_m = {height, height};
  species.width_m = {0.01f, 0.01f};
  species.stiffness = {1, 1};
  species.lean = 0;
  species.flower.head_m = {0.02f, 0.02f};
  species.tuft.spread = 0;
  layer.plain = true;
  layer.density = 200;
  layer.full_distance_m = 100;
  return layer;
}

// Along a wall, edge-on: what grows on it reaches out by its height, and nothing behind it.
TEST_F(MeshSurfaces, PlantsStandOutFromWallsAndHangFromCeilings) {
  const double distance = 6, fov = 30 * k_degree, height = 0.5, pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  const View east = View::look({-distance, 0, 0}, 0, 0, fov, k_size, 0.05, 100);
  const double reach = 0.1;  // of the wall to either side of the place that is measured, metres
  for (const PlantKind kind : {PlantKind::blade, PlantKind::tuft, PlantKind::flower, PlantKind::fern}) {
    // Looks south, so its plants reach to the right.
    Body south(bristles(kind, float(height)), wall({-reach, 0, -1}, {2 * reach, 0, 0}, {0, 0, 2}));
    south.look(east);
    const Extent wall_extent = extent_of(south.picture(true, false), distance, fov);
    ASSERT_GT(wall_extent.lit, 50u) << int(kind);
    EXPECT_GT(wall_extent.low.x, -2 * pixel) << int(kind);
    // Of nearly balanced species plants stay smaller; here there is one. Heads and leaves reach a little further.
    EXPECT_NEAR(wall_extent.high.x, height, kind == PlantKind::fern ? 0.2 : 0.04) << int(kind);
    // Looks down.
    Body ceiling(bristles(kind, float(height)), wall({-reach, 1, 0}, {2 * reach, 0, 0}, {0, -2, 0}));
    ceiling.look(east);
    const Extent ceiling_extent = extent_of(ceiling.picture(true, false), distance, fov);
    ASSERT_GT(ceiling_extent.lit, 50u) << int(kind);
    EXPECT_LT(ceiling_extent.high.y, 2 * pixel) << int(kind);
    EXPECT_NEAR(ceiling_extent.low.y, -height, kind == PlantKind::fern ? 0.2 : 0.04) << int(kind);
  }
}

// What is limp bends downhill: seen along the wall its tips are below its roots.
TEST_F(MeshSurfaces, LimpPlantsHangDownTheWall) {
  const double distance = 6, fov = 30 * k_degree;
  Layer layer = bristles(PlantKind::blade, 0.5f);
  layer.species[0].stiffness = {0.05f, 0.1f};
  layer.species[0].width_m = {0.06f, 0.06f};
  Body body(layer, wall({-0.1, 0, -0.1}, {0.2, 0, 0}, {0, 0, 0.2}));
  body.look(View::look({-distance, 0, 0}, 0, 0, fov, k_size, 0.05, 100));
  const Extent extent = extent_of(body.picture(true, false), distance, fov);
  ASSERT_GT(extent.lit, 20u);
  EXPECT_LT(extent.low.y, -0.1 - 0.15);
  EXPECT_LT(extent.high.y, 0.1 + 0.1);
}

TEST_F(MeshSurfaces, TheBodyFillsTheGaps) {
  TriangleMesh mesh = topiary();
  mesh.paint(glm::u8vec3(k_green));
  Layer thin = ivy();
  thin.density = 10;
  Body body(thin, mesh);
  body.look(View::look({-4, 0, 1.2}, 0, 0, 60 * k_degree, k_size, 0.05, 100));
  const auto lit = [](const std::vector<uint8_t>& rgb) {
    size_t count = 0;
    for (size_t i = 0; i < rgb.size(); i += 3) count += rgb[i] + rgb[i + 1] + rgb[i + 2] > 0;
    return count;
  };
  const size_t plants = lit(body.picture(true, false)), with_body = lit(body.picture(true, true));
  const std::vector<uint8_t> alone = body.picture(false, true);
  EXPECT_GT(lit(alone), 2000u);
  EXPECT_GE(with_body, lit(alone));
  EXPECT_LT(plants, lit(alone));
  // Dark, and green.
  glm::dvec3 mean(0);
  for (size_t i = 0; i < alone.size(); i += 3) mean += glm::dvec3(alone[i], alone[i + 1], alone[i + 2]);
  mean /= double(lit(alone));
  EXPECT_LT(mean.g, 110);
  EXPECT_GT(mean.g, 1.1 * mean.b);
}

// An independent compiler must accept what we hand to drivers.
TEST(MeshShaders, AreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  const std::string path = testing::TempDir() + "sward_on_mesh.";
  const gl::ShaderLibrary shaders;
  for (const std::string file :
       {"mesh_body.vert.glsl",   "mesh_body.frag.glsl",   "classify.vert.glsl",    "grass_blade.tesc.glsl",
        "grass_blade.tese.glsl", "grass_blade.geom.glsl", "grass_blade.frag.glsl", "shoot.tesc.glsl",
        "shoot.tese.glsl",       "flower_head.tesc.glsl", "flower_head.tese.glsl", "flower_head.geom.glsl",
        "flower_head.frag.glsl", "gravel.tesc.glsl",      "gravel.geom.glsl",      "leaf.tesc.glsl",
        "leaf.tese.glsl",        "leaf.geom.glsl",        "leaf.frag.glsl",        "litter.geom.glsl",
        "litter.frag.glsl",      "billboard.geom.glsl",   "billboard.frag.glsl",   "fern.frag.glsl",
        "read_back.vert.glsl"}) {
    const std::string stage = file.substr(file.find('.') + 1, 4);
    std::vector<gl::Define> defines = layer_defines(ivy(), {});
    defines.push_back({"SWARD_LIT_AT_VERTICES", file.starts_with("grass_blade") ? "1" : "0"});
    const auto text = shaders.resolve(file, defines);
    ASSERT_TRUE(text) << text.error().message;
    std::ofstream(path + stage) << text->text;
    EXPECT_EQ(std::system(("glslangValidator " + path + stage).c_str()), 0) << file;
    std::filesystem::remove(path + stage);
  }
}

}  // namespace
}  // namespace sward
