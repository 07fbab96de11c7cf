// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/ground.h>
#include <sward/scene/scene.h>
#include <sward/terrain/bounds.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <sward/terrain/world.h>
#include <memory>

#include "host/scene_surfaces.h"

namespace sward::host {

/// A scene's ground in memory, a height field with its bounds or a world, and its base map: what needs no GL. Stays
/// where it is, because meshes refer to it.
class SceneTerrain {
 public:
  /// Computes the bounds.
  SceneTerrain(HeightField field, ColorMap colors, const Progress& progress = {});
  SceneTerrain(std::unique_ptr<World> world, ColorMap colors);
  SceneTerrain(const SceneTerrain&) = delete;
  SceneTerrain& operator=(const SceneTerrain&) = delete;

  const Surface& surface() const { return *surface_; }
  const ColorMap& colors() const { return colors_; }
  /// For rays and lines of sight (TerrainQueries); null over a world, which has none.
  const Bounds* bounds() const { return field_ ? &field_->bounds : nullptr; }
  /// What has to be followed by views (WorldStream); null where all of the ground is there from the start.
  World* world() const { return world_.get(); }
  /// What a layer with Layer::on_mesh covers; null for others.
  std::shared_ptr<const MeshSurface> mesh_of(const std::string& layer) const;
  /// What is odd about the scene's meshes, a line each.
  const std::vector<std::string>& warnings() const { return surfaces_.warnings; }
  /// Builds the scene's surfaces on this ground.
  Expected<void> add_surfaces(const Scene& scene);
  /// Needs a context.
  Expected<gl::GroundTextures> make_textures() const;

 private:
  struct Field {
    HeightField field;
    Bounds bounds;
  };
  std::unique_ptr<Field> field_;
  std::unique_ptr<World> world_;
  std::unique_ptr<FieldSurface> field_surface_;
  const Surface* surface_ = nullptr;
  ColorMap colors_;
  SceneSurfaces surfaces_;
};

/// Generates, loads or opens what the scene names. `detail` false switches the relief below the data off. A height map
/// without a texture is painted by slope, a world by the slope and height of its coarse data. Fails too when the
/// scene's camera has no ground below it to count its height from.
Expected<std::unique_ptr<SceneTerrain>> load_terrain(const Scene& scene, bool detail, const Progress& progress = {});

/// Near plane of the demo's views, metres, and a far plane that holds the whole ground from anywhere near it.
inline constexpr double k_near_plane_m = 0.1;
double far_plane_m(const Surface& surface);

/// Where the scene's camera stands (z above the ground resolved), looking along its yaw and pitch. Over a world the
/// ground is the finest that is resident.
View scene_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport);

}  // namespace sward::host
