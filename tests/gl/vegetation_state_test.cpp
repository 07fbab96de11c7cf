// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What drawing leaves behind in a context whose state is poisoned, by kind, samples and moved binding points; the
// entry points one by one are in state_contract_test.cpp.
#include <sward/vegetation/wind_textures.h>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class VegetationState : public GlTest {};

const View k_view = eye_level_view({8.0, -15.0, 1.7}, {32, 24});

/// What a stage promises to leave: its units and uniform buffers empty, nothing current.
GlState left_by_stage(std::initializer_list<GLuint> uniforms, std::initializer_list<GLuint> units) {
  GlState left{{"program", {0}}, {"vertex array", {0}}};
  for (const GLuint index : uniforms) add_empty_uniforms(left, index);
  for (const GLuint unit : units) add_empty_unit(left, unit);
  return left;
}

GlState left_by_classify(const gl::Bindings& b, GLuint framebuffer) {
  GlState left =
      left_by_stage({b.frame, b.species}, {b.base_map_raw, b.triangles, b.surface, b.exclusions, b.placement});
  left["transform feedback"] = {0};
  for (int i = 0; i < 4; ++i) left["feedback buffer " + std::to_string(i)] = {0};
  left["draw framebuffer"] = {double(framebuffer)};
  left["rasterizer discard"] = {0};
  return left;
}

GlState left_by_draw(const gl::Bindings& b) {
  GlState left = left_by_stage({b.frame, b.species, b.materials, b.disturbance},
                               {b.base_map, b.base_map_raw, b.triangles, b.surface, b.exclusions, b.placement,
                                b.blade_shape, b.plant_images, b.plant_mesh, b.detail, b.detail_slope,
                                b.disturbance_map});
  left["patch vertices"] = {1};
  // Where draws go in parts the counts of clusters are read.
  if (gl::software_renderer()) left["query buffer"] = {0};
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
    left.merge(left_by_stage({bindings.wind}, {bindings.wind_maps, bindings.wind_grid, bindings.wind_painted}));
    expect_only_changed(before, capture_state(), left);
    EXPECT_GT(patch.renderer().stats(true).primitives, 0u);
  }
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
