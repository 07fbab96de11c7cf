// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What growth draws: where blades and shadows land on the screen, and how many triangles they take.
#include <sward/terrain/terrain.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/blade_shape.h>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class Grow : public GlTest {};

constexpr glm::ivec2 k_size{160, 120};

struct Picture {
  std::vector<uint8_t> rgb;
  glm::ivec3 at(int x, int y) const {
    const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
    return {p[0], p[1], p[2]};
  }
  template <class Visit>
  void each(Visit visit) const {
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x) visit(x, y, at(x, y));
  }
};

bool lit(glm::ivec3 color) {
  return color.x + color.y + color.z > 0;
}

/// Plants alone on black; `ground` draws first.
template <class Ground>
Picture render_over(Patch& patch, const View& view, Ground ground) {
  auto target = host::RenderTarget::create(k_size, patch.samples);
  EXPECT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(view);
  ground();
  patch.classify(target->framebuffer());
  patch.draw();
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
  return {target->read_rgb()};
}

Picture render(Patch& patch, const View& view) {
  return render_over(patch, view, [] {});
}

size_t count_lit(const Picture& picture) {
  size_t count = 0;
  picture.each([&](int, int, glm::ivec3 color) { count += lit(color); });
  return count;
}

/// Pixel of a world point, y down.
glm::dvec2 pixel_of(const View& view, glm::dvec3 world) {
  const glm::dvec4 clip = view.clip_from_relative() * glm::dvec4(world - view.eye, 1.0);
  const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
  return {(ndc.x * 0.5 + 0.5) * k_size.x, (0.5 - ndc.y * 0.5) * k_size.y};
}

Layer grass_without_shadows() {
  Layer layer = grass_and_soil();
  layer.shadows = false;
  return layer;
}

TEST_F(Grow, BladesAreGreenAndStandOnGreenGroundOnly) {
  Patch patch(grass_without_shadows(), painted_map(16, [](int column, int) { return column < 8 ? k_brown : k_green; }));
  const View view = eye_level_view({8.0, -15.0, 1.7}, k_size);
  const Picture picture = render(patch, view);
  const double horizon = pixel_of(view, view.eye + glm::dvec3(0, 1000, 0)).y;
  size_t east = 0, west = 0, sky = 0, green = 0;
  picture.each([&](int x, int y, glm::ivec3 color) {
    if (!lit(color)) return;
    // Colours blend over a metre, blades bend by less than half of one: west is what is clearly west at 2 m.
    east += x >= k_size.x / 2;
    west += x < k_size.x / 2 - 45;
    sky += y < horizon - 1;
    green += color.y > color.x && color.y > color.z;
  });
  EXPECT_GT(east, 400u);
  EXPECT_EQ(west, 0u);
  EXPECT_EQ(sky, 0u);
  EXPECT_GT(double(green), 0.7 * double(east));
}

TEST_F(Grow, NothingIsDrawnOnBareGround) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_brown));
  EXPECT_EQ(count_lit(render(patch, eye_level_view({8.0, -15.0, 1.7}, k_size))), 0u);
  EXPECT_EQ(patch.renderer().stats(true).primitives, 0u);
}

TEST_F(Grow, OneAndFourSamplesCoverAlike) {
  // Thinner than a pixel everywhere.
  Layer layer = grass_without_shadows();
  layer.species[0].width_m = {0.003f, 0.004f};
  Patch patch(layer, plain_map(k_side, 8, k_green));
  const View view = eye_level_view({8.0, -15.0, 1.7}, k_size);
  double light[2];
  for (const int i : {0, 1}) {
    patch.samples = i == 0 ? 1 : 4;
    if (patch.samples > host::RenderTarget::max_samples()) GTEST_SKIP() << "no multisampling here";
    light[i] = 0;
    render(patch, view).each([&](int, int, glm::ivec3 color) { light[i] += color.y; });
  }
  // Hashed alpha has the mean of coverage, not its pattern.
  EXPECT_NEAR(light[0] / light[1], 1.0, 0.15);
}

/// Straight blades, few, full-grown, everything near.
Layer posts() {
  Layer layer = grass_without_shadows();
  layer.plain = true;
  layer.density = 3;
  layer.full_distance_m = 50;
  layer.horizon_m = 50;
  layer.full_segments_m = 50;
  layer.species[0].stiffness = {1, 1};
  layer.species[0].lean = 0;
  layer.species[0].width_m = {0.02f, 0.02f};
  return layer;
}

View from_above(double height) {
  return View::look({8.0, -8.0, height}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 1.2, k_size, 0.05, 1000);
}

TEST_F(Grow, TrianglesFollowSegments) {
  for (const int segments : {1, 3, 5}) {
    for (const bool shadows : {false, true}) {
      Layer layer = posts();
      layer.species[0].max_segments = segments;
      layer.shadows = shadows;
      Patch patch(layer, plain_map(k_side, 8, k_green));
      patch.lighting.sun_elevation = 0.6f;
      // From 14 m the whole patch lies inside of the frustum: every plant is drawn.
      render(patch, from_above(14));
      const size_t plants = patch.plants_of_gpu().size();
      ASSERT_GT(plants, 300u);
      // A strip of n quads whose last is a triangle.
      const size_t strip = size_t(2 * segments - 1);
      EXPECT_EQ(patch.renderer().stats(true).primitives, plants * strip * (shadows ? 2 : 1)) << segments << shadows;
    }
  }
}

TEST_F(Grow, NothingIsDrawnOutsideOfTheFrustum) {
  Patch patch(posts(), plain_map(k_side, 8, k_green));
  const View away = View::look({8.0, -8.0, 1.7}, 0, 0.5 * std::numbers::pi, 0.8, k_size, 0.05, 1000);
  render(patch, away);
  EXPECT_EQ(patch.renderer().stats(true).primitives, 0u);
}

/// World point of a plant at a row of the table of shapes.
glm::dvec3 point_of(const Plant& plant, const BladeShapes& shapes, int row) {
  const int column = int(std::lround(plant.stiffness * (k_blade_columns - 1)));
  const glm::dvec3 shape(shapes.texels[size_t(row * k_blade_columns + column)]);
  const glm::dvec3 way(std::cos(plant.azimuth) * shape.x, std::sin(plant.azimuth) * shape.x, shape.y);
  return plant.position + double(plant.height) * way;
}

TEST_F(Grow, BladesFollowTheirCurve) {
  const auto shapes = make_blade_shapes();
  ASSERT_TRUE(shapes) << shapes.error().message;
  for (const float stiffness : {0.0f, 1.0f}) {
    Layer layer = posts();
    layer.density = 0.4f;
    layer.species[0].stiffness = {stiffness, stiffness};
    layer.species[0].height_m = {0.8f, 0.8f};
    layer.species[0].width_m = {0.3f, 0.3f};  // covers whole pixels even edge-on
    layer.species[0].max_segments = 31;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    patch.level = 5;
    const View view = eye_level_view({8.0, -14.0, 1.5}, k_size, -15);
    const Picture picture = render(patch, view);
    const auto lit_at = [&](glm::dvec2 pixel) {
      for (int i = 0; i < 9; ++i) {
        const glm::ivec2 p = glm::ivec2(pixel) + glm::ivec2(i % 3 - 1, i / 3 - 1);
        if (lit(picture.at(std::clamp(p.x, 0, k_size.x - 1), std::clamp(p.y, 0, k_size.y - 1)))) return true;
      }
      return false;
    };
    size_t checked = 0;
    for (const Plant& plant : patch.plants_of_gpu()) {
      const double ahead = plant.position.y - view.eye.y;
      if (ahead < 2 || ahead > 5) continue;
      for (const int row : {1, 6, 11, 13}) {
        const glm::dvec2 pixel = pixel_of(view, point_of(plant, *shapes, row));
        if (pixel.x < 2 || pixel.x > k_size.x - 2 || pixel.y > k_size.y - 2) continue;
        EXPECT_TRUE(lit_at(pixel)) << "stiffness " << stiffness << " row " << row << " at " << pixel.x << ", "
                                   << pixel.y;
        ++checked;
      }
    }
    EXPECT_GE(checked, 12u);
  }
}

TEST_F(Grow, EveryPlantIsDrawnHoweverManyPointsADrawHas) {
  // Three plants on each of 512 triangles; of 63 segments they have more points than 16 bits can number, of 15 not.
  size_t covered[2];
  for (const int many : {0, 1}) {
    Layer layer = posts();
    layer.density = 5;
    layer.species[0].max_segments = many == 1 ? 63 : 15;
    layer.species[0].width_m = {0.3f, 0.3f};
    Patch patch(layer, plain_map(k_side, 8, k_green));
    covered[many] = count_lit(render(patch, from_above(14)));
    ASSERT_GT(patch.plants_of_gpu().size(), size_t(0x10000 / 64));
  }
  EXPECT_NEAR(double(covered[1]) / double(covered[0]), 1.0, 0.03);
}

/// The patch's level ground, drawn.
class Ground {
 public:
  Ground() {
    HeightFieldDesc desc;
    desc.columns = desc.rows = 5;
    desc.spacing = glm::dvec2(k_side / 4);
    desc.origin = {k_side / 2, -k_side / 2, 0};
    desc.relief.enabled = false;
    field_ = std::make_unique<HeightField>(*HeightField::create(desc, std::vector<float>(25, 0.0f)));
    bounds_ = std::make_unique<Bounds>(Bounds::create(*field_));
    mesh_ = std::make_unique<RoamMesh>(*RoamMesh::create(*bounds_, {}));
    renderer_ = std::make_unique<TerrainRenderer>(*TerrainRenderer::create(gl::ShaderLibrary()));
  }
  void draw(const View& view, const Patch& patch) {
    ASSERT_TRUE(mesh_->update(view));
    renderer_->upload(*mesh_);
    renderer_->draw(view, patch.frame(), patch.ground());
  }

 private:
  std::unique_ptr<HeightField> field_;
  std::unique_ptr<Bounds> bounds_;
  std::unique_ptr<RoamMesh> mesh_;
  std::unique_ptr<TerrainRenderer> renderer_;
};

struct ShadowSpot {
  size_t darker = 0, brighter = 0;
  glm::dvec2 mean{0};  ///< Of the darkened pixels against the root next to each.
};

glm::dvec2 from_nearest(glm::dvec2 pixel, const std::vector<glm::dvec2>& roots) {
  return pixel - *std::min_element(roots.begin(), roots.end(), [&](glm::dvec2 a, glm::dvec2 b) {
           return glm::distance(a, pixel) < glm::distance(b, pixel);
         });
}

/// Compares pictures with and without shadows, seen from above: x east, y south.
ShadowSpot find_shadows(float azimuth, float elevation) {
  Picture pictures[2];
  std::vector<glm::dvec2> roots;
  for (const int with : {0, 1}) {
    Layer layer = posts();
    layer.density = 0.1f;
    layer.species[0].height_m = {1, 1};
    layer.species[0].width_m = {0.1f, 0.1f};
    layer.shadows = with == 1;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    patch.level = 3;
    patch.lighting.sun_azimuth = azimuth;
    patch.lighting.sun_elevation = elevation;
    patch.samples = std::min(4, host::RenderTarget::max_samples());
    const View view = from_above(14);
    Ground ground;
    pictures[with] = render_over(patch, view, [&] { ground.draw(view, patch); });
    roots.clear();
    for (const Plant& plant : patch.plants_of_gpu()) roots.push_back(pixel_of(view, plant.position));
  }
  ShadowSpot spot;
  pictures[0].each([&](int x, int y, glm::ivec3 before) {
    const int change = pictures[1].at(x, y).y - before.y;
    spot.brighter += change > 2;
    if (change >= -2) return;
    ++spot.darker;
    spot.mean += from_nearest({x + 0.5, y + 0.5}, roots);
  });
  if (spot.darker > 0) spot.mean /= double(spot.darker);
  return spot;
}

TEST_F(Grow, ShadowsDarkenTheGroundAwayFromTheSun) {
  // Sun in the east, then in the north.
  const ShadowSpot east = find_shadows(0.0f, 0.8f);
  EXPECT_GT(east.darker, 100u);
  EXPECT_LT(double(east.brighter), 0.05 * double(east.darker));
  EXPECT_LT(east.mean.x, -2.0);
  EXPECT_LT(std::abs(east.mean.y), 0.7);
  const ShadowSpot north = find_shadows(float(std::numbers::pi / 2), 0.8f);
  EXPECT_GT(north.mean.y, 2.0);
  EXPECT_LT(std::abs(north.mean.x), 0.7);
}

TEST_F(Grow, NoShadowsOnceTheSunHasSet) {
  const ShadowSpot night = find_shadows(0.0f, -0.1f);
  EXPECT_EQ(night.darker, 0u);
  EXPECT_EQ(night.brighter, 0u);
}

size_t count_objects(GLboolean (*is_object)(GLuint)) {
  size_t count = 0;
  for (GLuint id = 1; id < 4096; ++id) count += is_object(id) == GL_TRUE;
  return count;
}

TEST_F(Grow, FramesLeakNoObjects) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green));
  auto target = host::RenderTarget::create({32, 24}, 1);
  ASSERT_TRUE(target) << target.error().message;
  std::vector<size_t> counts[2];
  for (int frame = 0; frame < 12; ++frame) {
    target->begin();
    // The eye wanders, so that frames need more and less than those before.
    patch.look(eye_level_view({8.0, -15.0 + 0.6 * frame, 1.7}, {32, 24}));
    patch.classify(target->framebuffer());
    patch.draw();
    patch.plants_of_gpu();
    patch.renderer().stats(false);
    if (frame != 3 && frame != 11) continue;
    counts[frame == 11] = {count_objects([](GLuint id) { return glIsBuffer(id); }),
                           count_objects([](GLuint id) { return glIsTexture(id); }),
                           count_objects([](GLuint id) { return glIsQuery(id); }),
                           count_objects([](GLuint id) { return glIsTransformFeedback(id); }),
                           count_objects([](GLuint id) { return glIsVertexArray(id); }),
                           count_objects([](GLuint id) { return glIsFramebuffer(id); })};
  }
  EXPECT_EQ(counts[0], counts[1]);
}

TEST_F(Grow, ABrokenShaderIsAnErrorWithTheDriversLog) {
  gl::ShaderLibrary shaders;
  shaders.add_source("grass_blade.frag.glsl", "void main() { this does not compile; }\n");
  const auto renderer = VegetationRenderer::create(grass_and_soil(), shaders);
  ASSERT_FALSE(renderer);
  EXPECT_NE(renderer.error().message.find("grass_blade.frag.glsl"), std::string::npos) << renderer.error().message;
  take_messages();
}

TEST_F(Grow, AnInvalidLayerIsRefused) {
  Layer layer = grass_and_soil();
  layer.cluster_size = 0;
  const auto renderer = VegetationRenderer::create(layer, gl::ShaderLibrary());
  ASSERT_FALSE(renderer);
  EXPECT_NE(renderer.error().message.find("cluster"), std::string::npos) << renderer.error().message;
}

}  // namespace
}  // namespace sward
