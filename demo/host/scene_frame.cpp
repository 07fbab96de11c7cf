// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_frame.h"

namespace sward::host {

Expected<SceneFrame> SceneFrame::create(std::span<const Layer> layers, const SceneTerrain& terrain,
                                        const RoamOptions& options) {
  auto mesh = RoamMesh::create(terrain.surface(), options);
  if (!mesh) return tl::unexpected(mesh.error());
  SceneFrame frame(std::move(*mesh));
  frame.lattice_ = terrain.surface().lattice();
  if (terrain.world() != nullptr) frame.stream_.emplace(*terrain.world());
  frame.layers_.resize(layers.size());
  for (size_t i = 0; i < layers.size(); ++i) {
    if (auto valid = validate(layers[i]); !valid) return tl::unexpected(valid.error());
    if (auto loaded = require_maps(layers[i]); !loaded) return tl::unexpected(loaded.error());
    frame.layers_[i].mesh = terrain.mesh_of(layers[i].name);
    if (layers[i].on_mesh != (frame.layers_[i].mesh != nullptr))
      return fail("layer '" + layers[i].name +
                  "': on_mesh must be set where a surface names the layer, and only there");
    frame.set_layer(i, layers[i]);
  }
  return frame;
}

void SceneFrame::set_layer(size_t index, const Layer& layer) {
  layers_[index].layer = layer;
  layers_[index].level = level_for_area(lattice_, layer.triangle_area_m2);
  uint32_t species = 0;
  for (LayerFrame& each : layers_) {
    each.first_species = species;
    species += uint32_t(each.layer.species.size());
  }
}

Expected<void> SceneFrame::exclude(std::span<const ExclusionShape> shapes) {
  for (const ExclusionShape& shape : shapes)
    if (auto added = exclusions_.add(shape); !added) return tl::unexpected(added.error());
  return {};
}

void SceneFrame::set_season(float season) {
  for (LayerFrame& each : layers_) each.layer.season = season;
}

Expected<std::vector<LatticeBox>> SceneFrame::stream(const View& view, Streaming streaming) {
  if (!stream_) return std::vector<LatticeBox>();
  Expected<std::vector<LatticeBox>> boxes =
      streaming == Streaming::wait ? stream_->wait(view) : Expected<std::vector<LatticeBox>>(stream_->step(view));
  if (!boxes || boxes->empty()) return boxes;
  for (const LatticeBox& box : *boxes) mesh_.residency_changed(box);
  return boxes;
}

uint32_t SceneFrame::cut_triangles(const View& view) {
  uint32_t count = 0;
  for (LayerFrame& each : layers_) {
    FixedLevelOptions options;
    options.level = each.level;
    options.horizon_m = each.layer.horizon_m * float(view.zoom());
    options.canopy_m = canopy_height(each.layer);
    options.spread_m = canopy_spread(each.layer);
    // What stands upright shows its tips over the edge of ground that has just turned away: leaving that out pops.
    options.skip_back_faces = each.layer.plain;
    options.altitudes = needs_altitudes(each.layer);
    if (each.mesh) {
      options.skip_back_faces = true;
      each.mesh->fixed_level_triangles(view, each.layer.triangle_area_m2, options, each.triangles);
    } else {
      mesh_.fixed_level_triangles(options, each.triangles);
    }
    count += uint32_t(each.triangles.size());
  }
  return count;
}

void SceneFrame::seed_triangles(const View& view, const ColorMap& colors) {
  for (LayerFrame& each : layers_) {
    if (each.mesh)
      seed(each.layer, view, *each.mesh, each.triangles, each.seeding);
    else
      seed(each.layer, view, colors, each.triangles, each.seeding, &exclusions_);
  }
}

std::vector<Plant> SceneFrame::plants(const View& view, const ColorMap& colors, float sun_azimuth,
                                      const Disturbance* disturbance) const {
  std::vector<Plant> all;
  for (const LayerFrame& each : layers_) {
    std::vector<Plant> grown = each.mesh
                                   ? grow_plants(each.layer, view, each.triangles, each.seeding)
                                   : grow_plants(each.layer, view, colors, each.triangles, each.seeding, sun_azimuth,
                                                 disturbance);
    for (Plant& plant : grown) plant.species += each.first_species;
    all.insert(all.end(), grown.begin(), grown.end());
  }
  return all;
}

}  // namespace sward::host
