// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A module with a copy of the library of its own, as two plug-ins of one host may each have. Draws a small meadow.
#include <sward/terrain/terrain.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>

#include "copy.h"

namespace {

using namespace sward;

int asserts = 0;

struct Meadow {
  HeightField field;
  Bounds bounds = Bounds::create(field, 1);
  RoamMesh mesh = RoamMesh::create(bounds, {.max_triangles = 500}).value();
  ColorMap colors{1, 1, {{90, 130, 50, 255}}, field.min_corner(), field.max_corner() - field.min_corner()};
  Layer layer;
  gl::Frame frame = gl::Frame::create().value();
  gl::GroundTextures ground = gl::GroundTextures::create(field, colors).value();
  TerrainRenderer terrain = TerrainRenderer::create({}).value();
  VegetationRenderer plants;
  FixedTriangles triangles;
  Seeding seeding;

  Meadow(HeightField of, const Layer& grass)
      : field(std::move(of)), layer(grass), plants(VegetationRenderer::create(layer, {}).value()) {}

  bool draw(GLuint framebuffer, int side) {
    const View view = View::look({0, 0, 2}, 1, -0.2, 0.9, {side, side}, 0.1, 1000);
    if (!mesh.update(view)) return false;
    FixedLevelOptions cut;
    cut.level = level_for_area(field, layer.triangle_area_m2);
    cut.horizon_m = layer.horizon_m;
    cut.canopy_m = canopy_height(layer);
    cut.spread_m = canopy_spread(layer);
    mesh.fixed_level_triangles(cut, triangles);
    seed(layer, view, colors, triangles, seeding);
    frame.upload(view, {}, 0, 1);
    terrain.upload(mesh);
    terrain.draw(view, frame, ground);
    if (!plants.upload(seeding, triangles, view)) return false;
    plants.classify(frame, ground, framebuffer);
    plants.draw(frame, ground);
    return true;
  }
};

std::unique_ptr<Meadow> meadow;

}  // namespace

bool copy_create() {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 17;
  desc.spacing = glm::dvec2(4);
  auto field = HeightField::create(desc, std::vector<float>(17 * 17, 0.0f));
  if (!field) return false;
  Species grass;
  grass.name = "grass";
  grass.reference_hsv = {0.25f, 0.615f, 0.51f};
  Layer layer;
  layer.species = {grass};
  layer.horizon_m = 20;
  layer.density = 30;
  layer.triangle_area_m2 = 4;
  meadow = std::make_unique<Meadow>(std::move(*field), layer);
  return true;
}

bool copy_draw(unsigned framebuffer, int side) {
  return meadow->draw(framebuffer, side);
}

void copy_destroy() {
  meadow.reset();
}

void copy_count_asserts() {
  set_assert_handler([](const char*, const char*, const char*, int) { ++asserts; });
}

int copy_provoke_assert() {
  gl::Frame().upload(View(), {}, 0, 1);
  return asserts;
}
