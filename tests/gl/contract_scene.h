// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// A tiny scene with everything that a host may draw, for tests of the contract between host and library: terrain from a
// mesh and from a clipmap, plants on both in wind and on disturbed ground, a mesh with its body.
#include <sward/terrain/terrain.h>
#include <sward/terrain_gl/clipmap_renderer.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/clipmap_seeding.h>
#include <sward/vegetation/disturbance_textures.h>
#include <sward/vegetation/mesh_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <sward/vegetation/wind_textures.h>

#include <array>
#include <numbers>

#include "clipmap_support.h"

namespace sward::test {

inline constexpr glm::ivec2 k_contract_size{64, 64};

/// An Expected's value, or a failed test and the end of it.
template <class T>
T made(Expected<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

inline Layer contract_layer() {
  Species grass;
  grass.name = "grass";
  grass.reference_hsv = {0.25f, 0.615f, 0.51f};
  Layer layer;
  layer.species = {grass};
  layer.density = 30;
  layer.full_distance_m = 4;
  layer.horizon_m = 20;
  layer.triangle_area_m2 = 4;
  return layer;
}

/// What needs no context. Stays where it is.
struct ContractWorld {
  ClipmapGround ground;
  ColorMap map;
  Layer layer = contract_layer();
  Wind wind;
  Disturbance disturbance = made(Disturbance::create());
  Exclusions exclusions;
  std::array<glm::dvec3, 3> face{glm::dvec3(2, 4, 2), glm::dvec3(4, 4, 2), glm::dvec3(3, 4.5, 4)};
  MeshSurface body = make_body();

  ContractWorld() : ground(ClipmapField{.samples = {65, 65}}) {
    map = {2, 2, {4, glm::u8vec4(90, 130, 50, 255)}, ground.field->min_corner(), {}, {}};
    map.size = ground.field->max_corner() - map.min_corner;
    if (!disturbance.press_disc({0, 0}, 3, 0.9f)) throw std::runtime_error("the ground cannot be pressed");
  }
  ContractWorld(const ContractWorld&) = delete;
  ContractWorld& operator=(const ContractWorld&) = delete;

  View look(glm::ivec2 viewport = k_contract_size) const {
    return view_over(ground, {0.0, -6.0}, 1.7, 90, -15, viewport);
  }

 private:
  MeshSurface make_body() const {
    const uint32_t indices[] = {0, 1, 2};
    const glm::u8vec3 colors[] = {{90, 130, 50}, {90, 130, 50}, {90, 130, 50}};
    return made(MeshSurface::create(face, indices, colors));
  }
};

/// What a context holds of it, and the CPU's part of a frame.
struct ContractScene {
  const ContractWorld& world;
  gl::Bindings bindings;
  gl::ShaderLibrary shaders;
  RoamMesh mesh = made(RoamMesh::create(*world.ground.bounds, {.max_triangles = 1500, .morph_s = 0}));
  gl::Frame frame = made(gl::Frame::create(bindings));
  gl::GroundTextures textures = made(gl::GroundTextures::create(*world.ground.field, world.map));
  TerrainRenderer terrain = made(TerrainRenderer::create(shaders, bindings));
  VegetationRenderer plants = made(VegetationRenderer::create(world.layer, shaders, bindings));
  gl::Lighting lighting;
  View view;
  FixedTriangles triangles;
  Seeding seeding;
  double time_s = 1;
  int samples = 1;

  explicit ContractScene(const ContractWorld& of, gl::ShaderLibrary from = {}, gl::Bindings at = {})
      : world(of), bindings(at), shaders(std::move(from)) {
    look(world.look());
  }

  /// The CPU's part.
  void look(const View& at) {
    view = at;
    made(mesh.update(view));
    FixedLevelOptions cut;
    cut.level = level_for_area(*world.ground.field, world.layer.triangle_area_m2);
    cut.horizon_m = world.layer.horizon_m;
    cut.canopy_m = canopy_height(world.layer);
    cut.spread_m = canopy_spread(world.layer);
    mesh.fixed_level_triangles(cut, triangles);
    seed(world.layer, view, world.map, triangles, seeding);
  }

  /// All that GL does in a frame, into what is bound; `framebuffer` is that.
  void draw(GLuint framebuffer) {
    frame.upload(view, lighting, time_s, samples);
    terrain.upload(mesh);
    terrain.draw(view, frame, textures);
    if (auto uploaded = plants.upload(seeding, triangles, view); !uploaded)
      throw std::runtime_error(uploaded.error().message);
    plants.classify(frame, textures, framebuffer);
    plants.draw(frame, textures);
  }
};

/// The same over a clipmap.
struct ContractClipmap {
  const ContractWorld& world;
  gl::Clipmap clipmap = made(gl::Clipmap::create(*world.ground.surface, {64}));
  ClipmapRenderer terrain = made(ClipmapRenderer::create(gl::ShaderLibrary()));
  ClipmapSeeder seeder =
      made(ClipmapSeeder::create(world.layer, *world.ground.surface, world.map, gl::ShaderLibrary()));
  VegetationRenderer plants = made(VegetationRenderer::create_for_clipmap(world.layer, gl::ShaderLibrary()));

  explicit ContractClipmap(const ContractWorld& of) : world(of) {}

  void draw(const View& view, const gl::Frame& frame, const gl::GroundTextures& textures, GLuint framebuffer) {
    clipmap.follow(view);
    terrain.draw(view, clipmap, frame, textures);
    if (auto seeded = seeder.seed(view, clipmap); !seeded) throw std::runtime_error(seeded.error().message);
    plants.upload(seeder, clipmap, view);
    plants.classify(frame, textures, framebuffer);
    plants.draw(frame, textures);
  }
};

}  // namespace sward::test
