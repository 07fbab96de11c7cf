// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/landscape.h>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward::test {
namespace {

constexpr glm::ivec2 k_size{160, 90};

LandscapeDesc small_landscape(std::vector<Layer> layers) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 65;
  desc.spacing = {2, 2};
  std::vector<float> heights;
  for (int i = 0; i < 65 * 65; ++i) heights.push_back(float(i % 7));
  HeightField field = HeightField::create(desc, std::move(heights)).value();
  ColorMap colors{1, 1, {k_green}, field.min_corner(), field.max_corner() - field.min_corner()};
  return {std::move(field), std::move(colors), std::move(layers)};
}

View view_over(const HeightField& field) {
  return View::look({0, 0, field.height(glm::dvec2(0)) + 2}, 1, -0.3, 0.9, k_size, 0.1, 1000);
}

class LandscapeTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    auto target = host::RenderTarget::create(k_size, 1);
    ASSERT_TRUE(target) << target.error().message;
    target_ = std::make_unique<host::RenderTarget>(std::move(*target));
  }
  void TearDown() override {
    target_.reset();
    glDisable(GL_DEPTH_TEST);
    GlTest::TearDown();
  }
  std::vector<uint8_t> picture(Landscape& landscape, double time) {
    target_->begin();
    const View view = view_over(landscape.field());
    const auto drawn = landscape.draw(view, gl::Lighting{}, time, 1, target_->framebuffer());
    EXPECT_TRUE(drawn) << drawn.error().message;
    return target_->read_rgb();
  }
  std::unique_ptr<host::RenderTarget> target_;
};

/// The same frame from the parts, in the order of docs/integrate.md.
std::vector<uint8_t> drawn_by_hand(const LandscapeDesc& desc, host::RenderTarget& target) {
  const Layer& layer = desc.layers[0];
  const Bounds bounds = Bounds::create(desc.field);
  RoamMesh mesh = RoamMesh::create(bounds, desc.mesh).value();
  const gl::ShaderLibrary shaders;
  gl::Frame frame = gl::Frame::create().value();
  auto ground = gl::GroundTextures::create(desc.field, desc.colors).value();
  EXPECT_TRUE(ground.set_materials(desc.materials));
  auto terrain = TerrainRenderer::create(shaders).value();
  auto plants = VegetationRenderer::create(layer, shaders).value();
  const View view = view_over(desc.field);
  FixedLevelOptions cut;
  cut.level = level_for_area(desc.field, layer.triangle_area_m2);
  cut.horizon_m = layer.horizon_m * float(view.zoom());
  cut.canopy_m = canopy_height(layer);
  cut.spread_m = canopy_spread(layer);
  FixedTriangles triangles;
  Seeding seeding;

  EXPECT_TRUE(mesh.update(view, 3));
  mesh.fixed_level_triangles(cut, triangles);
  seed(layer, view, desc.colors, triangles, seeding);
  target.begin();
  frame.upload(view, gl::Lighting{}, 3, 1);
  terrain.upload(mesh);
  terrain.draw(view, frame, ground);
  EXPECT_TRUE(plants.upload(seeding, triangles, view));
  plants.classify(frame, ground, target.framebuffer());
  plants.draw(frame, ground);
  return target.read_rgb();
}

TEST_F(LandscapeTest, DrawsWhatItsPartsDraw) {
  auto landscape = Landscape::create(small_landscape({grass_and_soil()}));
  ASSERT_TRUE(landscape) << landscape.error().message;
  const std::vector<uint8_t> ours = picture(*landscape, 3);
  EXPECT_GT(landscape->vegetation(0).stats(true).primitives, 1000u);
  EXPECT_GT(landscape->mesh_stats().visible, 100u);
  EXPECT_EQ(ours, drawn_by_hand(small_landscape({grass_and_soil()}), *target_));
}

TEST_F(LandscapeTest, MovesWithItsPartsIntact) {
  auto created = Landscape::create(small_landscape({grass_and_soil()}));
  ASSERT_TRUE(created) << created.error().message;
  const std::vector<uint8_t> before = picture(*created, 3);
  Landscape moved = std::move(*created);
  created = fail("gone");
  EXPECT_EQ(picture(moved, 3), before);
}

TEST_F(LandscapeTest, ExclusionsAndEditsReachTheNextFrame) {
  auto landscape = Landscape::create(small_landscape({grass_and_soil()}));
  ASSERT_TRUE(landscape) << landscape.error().message;
  picture(*landscape, 1);
  const size_t seeded = landscape->seeding(0).records.size();
  ASSERT_GT(seeded, 0u);

  Exclusions everywhere;
  ASSERT_TRUE(everywhere.add(ExclusionShape::disc({0, 0}, 200)));
  landscape->set_exclusions(&everywhere);
  picture(*landscape, 2);
  EXPECT_EQ(landscape->seeding(0).records.size(), 0u);
  landscape->set_exclusions(nullptr);

  const double height = landscape->field().height(glm::dvec2(0));
  Edit hill{.kind = Edit::Kind::raise, .region = EditRegion::disc({0, 0}, 20), .metres = 5};
  const auto edited = landscape->edit(hill);
  ASSERT_TRUE(edited) << edited.error().message;
  EXPECT_NEAR(landscape->field().height(glm::dvec2(0)), height + 5, 1e-3);
  picture(*landscape, 3);
  EXPECT_TRUE(landscape->mesh().validate());
  hill.region = EditRegion::disc({1e6, 0}, 20);
  EXPECT_FALSE(landscape->edit(hill));
}

TEST_F(LandscapeTest, SaysWhatIsWrong) {
  LandscapeDesc poor = small_landscape({grass_and_soil()});
  poor.mesh.max_triangles = 1;
  EXPECT_FALSE(Landscape::create(std::move(poor)));

  Layer hedge = grass_and_soil();
  hedge.name = "hedge";
  hedge.on_mesh = true;
  const auto refused = Landscape::create(small_landscape({hedge}));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("hedge"), std::string::npos) << refused.error().message;

  auto landscape = Landscape::create(small_landscape({}));
  ASSERT_TRUE(landscape) << landscape.error().message;
  EXPECT_EQ(landscape->layer_count(), 0u);
  View view = view_over(landscape->field());
  view.viewport = {0, 0};
  EXPECT_FALSE(landscape->draw(view, gl::Lighting{}, 0, 1));
}

TEST_F(LandscapeTest, CreationAndDrawLeaveWhatTheySay) {
  target_->begin();
  const PoisonedState poison;
  GlState before = capture_state();
  auto landscape = Landscape::create(small_landscape({grass_and_soil()}));
  ASSERT_TRUE(landscape) << landscape.error().message;
  expect_only_changed(before, capture_state(), {});

  const View view = view_over(landscape->field());
  ASSERT_TRUE(landscape->draw(view, gl::Lighting{}, 0, 1, target_->framebuffer()));
  const gl::Bindings& b = landscape->frame().bindings();
  GlState left{{"program", {0}}, {"vertex array", {0}}, {"patch vertices", {1}}, {"transform feedback", {0}}};
  for (const GLuint unit : {b.base_map, b.base_map_raw, b.slope_map, b.triangles, b.surface, b.exclusions, b.placement,
                            b.blade_shape, b.plant_images, b.plant_mesh, b.detail, b.detail_slope, b.disturbance_map})
    add_empty_unit(left, unit);
  for (const GLuint index : {b.frame, b.species, b.materials, b.disturbance}) add_empty_uniforms(left, index);
  if (gl::software_renderer()) left["query buffer"] = {0};
  for (int i = 0; i < 4; ++i) left["feedback buffer " + std::to_string(i)] = {0};
  expect_only_changed(before, capture_state(), left);
}

}  // namespace
}  // namespace sward::test
