// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <memory>
#include <optional>
#include <string>

#include "host/scene_maps.h"
#include "host/scene_renderer.h"

namespace CLI {
class App;
}

namespace sward::tool {

/// The options that name a scene, shared by all commands that draw or measure one.
struct SceneOptions {
  std::string scene;  ///< A file, or the name of a built-in scene; empty: meadow.
  std::string height, texture;
  std::string world;                ///< A folder that bake made.
  std::optional<double> memory_mb;  ///< Cap of a world's heights and bounds.
  std::string spacing;              ///< "M" or "M,M"; empty: the scene's.
  std::optional<double> height_scale, height_offset;
  std::optional<uint32_t> triangles;
  std::string camera;           ///< "x,y,z,yaw,pitch"; empty: the scene's.
  std::string sun;              ///< "azimuth,elevation"; empty: the scene's.
  std::optional<float> season;  ///< Time of the year.
  std::string detail;           ///< "on" or "off".
  bool detail_given = false;
  std::string source;   ///< "roam" or "clipmap"; empty: the scene's.
  std::string shaders;  ///< Folder of shader files that replace those built in; empty: none.
};

void add_scene_options(CLI::App& app, SceneOptions& options, bool detail_by_default);
/// --wait, of commands that draw frames.
void add_wait_option(CLI::App& app, bool& wait);
void add_camera_option(CLI::App& app, SceneOptions& options);
void add_sun_option(CLI::App& app, SceneOptions& options);
void add_shaders_option(CLI::App& app, SceneOptions& options);
void add_season_option(CLI::App& app, SceneOptions& options);
/// --source, of commands that draw the ground.
void add_source_option(CLI::App& app, SceneOptions& options);

/// Reads the scene and lays the options over it.
Expected<Scene> make_scene(const SceneOptions& options);
/// Fails where frames are to wait for squares (--wait) and the ground is no world.
Expected<void> check_wait(const Scene& scene, bool wait);
/// Loads, generates or opens its terrain, with progress on a terminal.
Expected<std::unique_ptr<host::SceneTerrain>> make_terrain(const Scene& scene, const SceneOptions& options);
/// The shaders built in, below those of --shaders. Fails where that is no folder.
Expected<gl::ShaderLibrary> make_shaders(const SceneOptions& options);
/// A clear day with the scene's sun and haze.
gl::Lighting make_lighting(const Scene& scene);

}  // namespace sward::tool
