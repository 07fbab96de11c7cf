// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/edits.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <memory>
#include <vector>

namespace sward {

/// What a Landscape is made of; it takes all of it over. The first three are what a host has, the rest are good as they
/// are.
struct LandscapeDesc {
  HeightField field;
  ColorMap colors;            ///< Its bounds are computed where it has none (ColorMap::bounds).
  std::vector<Layer> layers;  ///< Drawn in this order; near and low ones first cost least. May be empty.
  RoamOptions mesh = {};
  std::vector<GroundMaterial> materials = default_ground_materials();  ///< Near the eye; empty: noise alone.
  gl::Bindings bindings = {};
};

/// A height field covered with vegetation, for hosts with one view and one GL thread: it owns what the calls of
/// docs/integrate.md need and makes them in their order, no more. Every part can be reached and set as if the host had
/// made it. What does not fit (several views, a worker thread, worlds, clipmaps, meshes) is written out from the same
/// parts: landscape.cpp is the example to copy from.
///
/// All calls on the GL thread, with the context current, destruction included. Move-only; the parts keep their
/// addresses.
class SWARD_API Landscape {
 public:
  /// Bounds, mesh, textures, programs. Fails as the parts do, naming the thing: a budget below the root mesh, a layer
  /// or a map that does not validate, a shader's error, a GL below 4.5. Binds and leaves nothing. Cost: some 20 ns a
  /// sample a core, 35 ms a detail texture, and what the driver takes to compile 2 programs a kind of plant.
  static Expected<Landscape> create(LandscapeDesc desc, const gl::ShaderLibrary& shaders = {});
  Landscape(Landscape&&) noexcept;
  Landscape& operator=(Landscape&&) noexcept;
  ~Landscape();

  /// One frame into `framebuffer`, which is bound for drawing and has `samples` samples (1: no multisampling). Time in
  /// seconds, on a clock that goes on: the mesh and the plants move by it. The view's viewport is the host's
  /// glViewport. Binds and leaves what TerrainRenderer::draw(), VegetationRenderer::classify() and draw() list; the
  /// host clears, enables the depth test and disables culling and blending. Fails on a view or a time that is not valid
  /// and where a frame does not fit the device's buffers; the picture may then lack what comes after.
  Expected<void> draw(const View& view, const gl::Lighting& lighting, double time_s, int samples,
                      GLuint framebuffer = 0);

  /// Shapes on which nothing stands, from the next draw on; null: none. They must live until they are replaced.
  void set_exclusions(const Exclusions* exclusions);
  /// sward::edit() on the field, told to mesh and textures. Fails as it does.
  Expected<EditResult> edit(const Edit& edit);

  const HeightField& field() const;  ///< For heights and normals; edit() changes it.
  const Bounds& bounds() const;
  const ColorMap& colors() const;
  RoamMesh& mesh();
  gl::Frame& frame();
  gl::GroundTextures& ground();
  TerrainRenderer& terrain();
  size_t layer_count() const;
  /// The renderer of a layer by its place in LandscapeDesc::layers: wind, season, statistics are set and asked there.
  VegetationRenderer& vegetation(size_t layer);
  /// What the layer's last frame was drawn from, for grow_plants() and statistics. Valid until the next draw.
  const FixedTriangles& triangles(size_t layer) const;
  const Seeding& seeding(size_t layer) const;
  /// Of the mesh's last update.
  const RoamStats& mesh_stats() const;

 private:
  struct Parts;
  explicit Landscape(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace sward
