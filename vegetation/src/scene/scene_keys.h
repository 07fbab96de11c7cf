// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>

#include "scene/scene_schema.h"

namespace sward::scene_file {

// Every key of a scene file. docs/scene_format.md lists the same, which a test checks.
const Schema<Scene>& scene_schema();
const Schema<Scene>& terrain_schema();
const Schema<ReliefOptions>& relief_schema();
const Schema<SceneMaterial>& material_schema();
const Schema<Scene>& base_map_schema();
const Schema<Scene>& sun_schema();
const Schema<Scene>& haze_schema();
const Schema<Scene>& camera_schema();
const Schema<Layer>& layer_schema();
const Schema<Species>& species_schema();
const Schema<TuftShape>& tuft_schema();
const Schema<FlowerShape>& flower_schema();
const Schema<CustomKind>& custom_schema();
const Schema<SeasonFrame>& species_season_schema();
const Schema<Scene>& season_schema();
const Schema<GroundSeason>& ground_season_schema();
const Schema<ExclusionShape>& exclude_schema();
const Schema<SceneSurface>& surface_schema();
const Schema<SceneDisturbance>& disturbance_schema();
const Schema<SceneWalker>& walker_schema();
const Schema<SceneEvent>& event_schema();
const Schema<PlantMesh>& plant_mesh_schema();
/// Surfaces and layers on meshes name each other.
Expected<void> check_surfaces(const toml::table& table, const Scene& scene, const Context& context);

/// `[[wind.source]]` as it is read.
struct SceneWindSource {
  enum class Kind { gust, whirlwind };
  Kind kind = Kind::gust;
  float speed_m_s = 12;  ///< A gust's outwards, a whirlwind's around.
  WindSource source;
};
const Schema<SceneWind>& wind_schema();
const Schema<SceneWindSource>& wind_source_schema();
const Schema<SceneWindMover>& wind_mover_schema();
/// `[wind]`.
Key<Scene> wind_key();
/// `resistance` of a species.
Key<Species> resistance_key();

/// `[[terrain.material]]`.
Key<Scene> materials_key();
/// Gives materials that name a species its reference colour and weights. Fails where there is none of that name.
Expected<void> take_species_colors(const toml::table& table, Scene& scene, const Context& context);

}  // namespace sward::scene_file
