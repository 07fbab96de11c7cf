// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/vegetation/plants.h>
#include <sward/vegetation/seeding.h>
#include <optional>
#include <span>
#include <vector>

#include "host/scene_terrain.h"
#include "host/world_stream.h"

namespace sward::host {

/// One layer's share of a frame.
struct LayerFrame {
  Layer layer;
  int level = 0;               ///< Seeding level.
  std::shared_ptr<const MeshSurface> mesh;  ///< That it stands on; null: the terrain.
  uint32_t first_species = 0;  ///< Species of the layers before it: plants of all layers are numbered in one row.
  FixedTriangles triangles;
  Seeding seeding;
};

/// The half of a frame that needs no GL: mesh, fixed-level triangles, seeding. One thread at a time.
class SceneFrame {
 public:
  /// `terrain` must outlive the frame.
  static Expected<SceneFrame> create(std::span<const Layer> layers, const SceneTerrain& terrain,
                                     const RoamOptions& options);

  RoamMesh& mesh() { return mesh_; }
  const RoamMesh& mesh() const { return mesh_; }
  std::span<const LayerFrame> layers() const { return layers_; }
  /// Replaces a layer's species and rules; the next frame follows them.
  void set_layer(size_t index, const Layer& layer);

  /// Ground on which nothing stands; the next seeding follows changes.
  Exclusions& exclusions() { return exclusions_; }
  Expected<void> exclude(std::span<const ExclusionShape> shapes);
  /// Layer::season of every layer.
  void set_season(float season);

  /// Worlds: takes over what has been loaded and asks for what the view wants; the boxes in which the ground has
  /// changed, of which mesh and layers know. Before the mesh's update.
  Expected<std::vector<LatticeBox>> stream(const View& view, Streaming streaming);
  /// Fixed-level triangles of every layer on the mesh of its last update. Returns how many.
  uint32_t cut_triangles(const View& view);
  /// Seeds the cut triangles.
  void seed_triangles(const View& view, const ColorMap& colors);
  /// The CPU twin's plants of all layers; Plant::species counts on from layer to layer. `sun_azimuth` in radians;
  /// `disturbance` as grow_plants() takes it.
  std::vector<Plant> plants(const View& view, const ColorMap& colors, float sun_azimuth,
                            const Disturbance* disturbance = nullptr) const;

 private:
  explicit SceneFrame(RoamMesh mesh) : mesh_(std::move(mesh)) {}
  RoamMesh mesh_;
  std::vector<LayerFrame> layers_;
  Lattice lattice_;
  std::optional<WorldStream> stream_;
  Exclusions exclusions_;
};

}  // namespace sward::host
