// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the vegetation renderer's entry points leave behind, in a context whose state is poisoned.
#include <sward/vegetation/wind_textures.h>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class VegetationState : public GlTest {};

const View k_view = eye_level_view({8.0, -15.0, 1.7}, {32, 24});

/// What a stage promises to leave: its units and uniform buffers empty, nothing current.
GlState left_by_stage(const gl::Bindings& bindings, std::initializer_list<GLuint> units) {
  GlState left{{"program", {0}}, {"vertex array", {0}}, {"uniform buffer", {0}}};
  for (const GLuint unit : units)
    for (const char* kind : {"texture 2D ", "texture 2D array ", "texture buffer ", "sampler "})
      left[kind + std::to_string(unit)] = {0};
  left["uniform buffer " + std::to_string(bindings.frame)] = {0};
  left["uniform buffer " + std::to_string(bindings.species)] = {0};
  return left;
}

GlState left_by_classify(const gl::Bindings& bindings, GLuint framebuffer) {
  GlState left = left_by_stage(
      bindings, {bindings.base_map_raw, bindings.triangles, bindings.surface, bindings.exclusions, bindings.placement});
  left["transform feedback"] = {0};
  left["draw framebuffer"] = {double(framebuffer)};
  left["rasterizer discard"] = {0};
  return left;
}

TEST_F(VegetationState, CreationChangesNothing) {
  const PoisonedState poison;
  const GlState before = capture_state();
  auto renderer = VegetationRenderer::create(grass_and_soil(), gl::ShaderLibrary());
  ASSERT_TRUE(renderer) << renderer.error().message;
  expect_only_changed(before, capture_state(), {});
}

TEST_F(VegetationState, UploadChangesNothing) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green));
  const PoisonedState poison;
  const GlState before = capture_state();
  patch.look(k_view);
  expect_only_changed(before, capture_state(), {});
}

TEST_F(VegetationState, ClassifyLeavesWhatItSays) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green));
  auto target = host::RenderTarget::create({32, 24}, 1);
  ASSERT_TRUE(target) << target.error().message;
  patch.look(k_view);
  const PoisonedState poison;
  const GlState before = capture_state();
  patch.classify(target->framebuffer());
  expect_only_changed(before, capture_state(), left_by_classify(patch.frame().bindings(), target->framebuffer()));
  EXPECT_GT(patch.renderer().stats(true).clusters_fertile, 0u);
}

GlState left_by_draw(const gl::Bindings& bindings) {
  GlState left =
      left_by_stage(bindings, {bindings.base_map, bindings.base_map_raw, bindings.triangles, bindings.surface,
                               bindings.exclusions, bindings.placement, bindings.blade_shape, bindings.plant_images,
                               bindings.plant_mesh, bindings.detail, bindings.detail_slope, bindings.disturbance_map});
  left["uniform buffer " + std::to_string(bindings.disturbance)] = {0};
  left["uniform buffer " + std::to_string(bindings.materials)] = {0};
  left["patch vertices"] = {1};
  return left;
}

void expect_draw_leaves_what_it_says(const Layer& layer, int samples) {
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.samples = samples;
  auto target = host::RenderTarget::create({32, 24}, samples);
  ASSERT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(k_view);
  patch.classify(target->framebuffer());
  const PoisonedState poison;
  const GlState before = capture_state();
  patch.draw();
  expect_only_changed(before, capture_state(), left_by_draw(patch.frame().bindings()));
  EXPECT_GT(patch.renderer().stats(true).primitives, 0u);
}

TEST_F(VegetationState, DrawLeavesWhatItSays) {
  for (const int samples : {1, 4}) {
    if (samples > host::RenderTarget::max_samples()) continue;
    for (const PlantKind kind : {PlantKind::blade, PlantKind::tuft, PlantKind::flower}) {
      Layer layer = grass_and_soil();
      layer.species[0].kind = kind;
      expect_draw_leaves_what_it_says(layer, samples);
    }
  }
}

TEST_F(VegetationState, DrawInWindLeavesWhatItSays) {
  for (const PlantKind kind : {PlantKind::blade, PlantKind::flower, PlantKind::fern}) {
    Layer layer = grass_and_soil();
    layer.species[0].kind = kind;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    auto target = host::RenderTarget::create({32, 24}, 1);
    auto wind = WindTextures::create();
    ASSERT_TRUE(target && wind);
    target->begin();
    patch.look(k_view);
    patch.classify(target->framebuffer());
    const PoisonedState poison;
    const GlState before = capture_state();
    ASSERT_TRUE(patch.renderer().set_wind(&*wind));
    expect_only_changed(before, capture_state(), {});
    patch.draw();
    const gl::Bindings& bindings = patch.frame().bindings();
    GlState left = left_by_draw(bindings);
    for (const GLuint unit : {bindings.wind_maps, bindings.wind_grid, bindings.wind_painted})
      for (const char* kind_of_unit : {"texture 2D ", "texture 2D array ", "texture buffer ", "sampler "})
        left[kind_of_unit + std::to_string(unit)] = {0};
    left["uniform buffer " + std::to_string(bindings.wind)] = {0};
    expect_only_changed(before, capture_state(), left);
    EXPECT_GT(patch.renderer().stats(true).primitives, 0u);
  }
}

TEST_F(VegetationState, ReadBackLeavesWhatItSays) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green));
  patch.look(k_view);
  patch.classify();
  const PoisonedState poison;
  const GlState before = capture_state();
  EXPECT_FALSE(patch.plants_of_gpu().empty());
  const gl::Bindings& bindings = patch.frame().bindings();
  GlState left = left_by_classify(bindings, 0);
  left["uniform buffer " + std::to_string(bindings.disturbance)] = {0};
  for (const char* kind : {"texture 2D ", "texture 2D array ", "texture buffer ", "sampler "})
    left[kind + std::to_string(bindings.disturbance_map)] = {0};
  expect_only_changed(before, capture_state(), left);
}

TEST_F(VegetationState, BindingPointsCanBeMoved) {
  gl::Bindings bindings;
  bindings.frame = 5;
  bindings.species = 3;
  bindings.base_map = 9;
  bindings.base_map_raw = 8;
  bindings.triangles = 12;
  bindings.surface = 2;
  bindings.blade_shape = 11;
  bindings.plant_images = 10;
  bindings.plant_mesh = 13;
  bindings.clipmap_heights = 15;
  bindings.placement = 6;
  bindings.exclusions = 7;
  bindings.materials = 2;
  bindings.detail = 1;
  bindings.detail_slope = 4;
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green), bindings);
  auto target = host::RenderTarget::create({32, 24}, 1);
  ASSERT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(k_view);
  const PoisonedState poison;
  const GlState before = capture_state();
  patch.classify(target->framebuffer());
  expect_only_changed(before, capture_state(), left_by_classify(bindings, target->framebuffer()));
  patch.draw();
  const VegetationStats stats = patch.renderer().stats(true);
  EXPECT_GT(stats.clusters_fertile, 0u);
  EXPECT_GT(stats.primitives, 0u);
}

}  // namespace
}  // namespace sward
