// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/scene_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "sward/arguments.h"
#include "sward/output/progress.h"

namespace sward::tool {

namespace {

Expected<Scene> read_scene(const std::string& name) {
  if (name.empty()) return builtin_scene("meadow");
  std::error_code ignored;
  // A bare word that is no file can only mean a built-in scene, and the error then lists those.
  const bool word = name.find_first_of("./") == std::string::npos;
  if (word && !std::filesystem::is_regular_file(name, ignored)) return builtin_scene(name);
  return load_scene(name);
}

// Paths on the command line are the caller's, not relative to the scene's folder.
std::string absolute(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::absolute(path, ignored).string();
}

// Puts the camera at eye level in the middle of ground that is not the scene's own.
void stand_in_the_middle(Scene& scene) {
  scene.camera = glm::dvec3(0, 0, 1.7);
  scene.camera_above_ground = scene.camera_from_middle = true;
}

Expected<void> override_world(const SceneOptions& options, Scene& scene) {
  if (!options.world.empty()) {
    if (!options.height.empty()) return fail("--world and --height contradict each other: name one of them");
    scene.generator.clear();
    scene.height_path.clear();
    scene.world_path = absolute(options.world);
    stand_in_the_middle(scene);
  }
  const bool over_world = !scene.world_path.empty() && options.height.empty();
  if (over_world && options.detail_given && options.detail == "on")
    return fail("--detail on: a world has no relief below its data; leave it out");
  if (!options.memory_mb) return {};
  if (scene.world_path.empty()) return fail("--memory is the cap of a world, and this scene has none; add --world");
  if (!(*options.memory_mb > 0 && *options.memory_mb <= 1e9)) return fail("--memory must be megabytes above 0");
  scene.world_memory_mb = *options.memory_mb;
  return {};
}

Expected<void> override_heights(const SceneOptions& options, Scene& scene) {
  if (!options.height.empty() && !scene.world_path.empty()) {
    scene.world_path.clear();
    stand_in_the_middle(scene);
  }
  if (!options.height.empty()) {
    if (!scene.generator.empty()) {
      scene.generator.clear();
      scene.camera = glm::dvec3(scene.origin.x, scene.origin.y, 1.7);
      scene.camera_above_ground = true;
    }
    scene.height_path = absolute(options.height);
  }
  const bool scaled = !options.spacing.empty() || options.height_scale || options.height_offset;
  if (scaled && !scene.world_path.empty())
    return fail("--spacing, --height-scale and --height-offset are those that a world was baked with; leave them out");
  if (scaled && scene.height_path.empty())
    return fail(
        "--spacing, --height-scale and --height-offset need a height map: this scene is generated; add --height");
  if (!options.spacing.empty()) {
    auto spacing = parse_numbers(options.spacing, 1, 2);
    if (!spacing) return tl::unexpected(spacing.error());
    scene.spacing = {spacing->front(), spacing->back()};
    if (!(scene.spacing.x > 0 && scene.spacing.y > 0) || !std::isfinite(scene.spacing.x + scene.spacing.y))
      return fail("--spacing must be metres above 0");
  }
  scene.height_scale = options.height_scale.value_or(scene.height_scale);
  scene.height_offset = options.height_offset.value_or(scene.height_offset);
  if (!std::isfinite(scene.height_scale) || !std::isfinite(scene.height_offset))
    return fail("--height-scale and --height-offset must be finite numbers");
  return {};
}

Expected<void> override_view(const SceneOptions& options, Scene& scene) {
  if (!options.camera.empty()) {
    auto camera = parse_camera(options.camera);
    if (!camera) return tl::unexpected(camera.error());
    scene.camera = camera->position;
    scene.camera_above_ground = camera->above_ground;
    scene.camera_from_middle = false;
    scene.camera_yaw = glm::radians(camera->yaw_degrees);
    scene.camera_pitch = glm::radians(camera->pitch_degrees);
  }
  if (!options.sun.empty()) {
    auto sun = parse_numbers(options.sun, 2, 2);
    if (!sun) return tl::unexpected(sun.error());
    if (!std::isfinite((*sun)[0]) || !(std::abs((*sun)[1]) <= 90))
      return fail("--sun takes a finite azimuth and an elevation from -90 to 90 degrees");
    scene.sun_azimuth = float(glm::radians((*sun)[0]));
    scene.sun_elevation = float(glm::radians((*sun)[1]));
  }
  return {};
}

}  // namespace

void add_scene_options(CLI::App& app, SceneOptions& options, bool detail_by_default) {
  options.detail = detail_by_default ? "on" : "off";
  app.add_option("scene", options.scene, "Scene file (TOML) or built-in scene; default: meadow")->type_name("SCENE");
  app.add_option("--height", options.height, "Height map instead of the scene's")->type_name("FILE");
  app.add_option("--spacing", options.spacing, "Metres between samples, east-west[,north-south]")
      ->type_name("M[,M]")
      ->check(as_check([](const std::string& text) { return parse_numbers(text, 1, 2); }));
  app.add_option("--height-scale", options.height_scale, "Metres a raw unit of the height map")->type_name("M");
  app.add_option("--height-offset", options.height_offset, "Metres added to every height")->type_name("M");
  app.add_option("--world", options.world, "World that bake made instead of the scene's ground")->type_name("FOLDER");
  app.add_option("--memory", options.memory_mb, "Most megabytes of a world's heights and bounds; default: 512")
      ->type_name("MB");
  app.add_option("--texture", options.texture, "Colour map instead of the scene's")->type_name("FILE");
  app.add_option("--triangles", options.triangles, "Terrain triangle budget instead of the scene's")->type_name("N");
  app.add_option("--detail", options.detail, "Relief below the data")
      ->check(CLI::IsMember({"on", "off"}))
      ->each([&options](const std::string&) { options.detail_given = true; })
      ->type_name("on|off")
      ->capture_default_str();
}

void add_wait_option(CLI::App& app, bool& wait) {
  app.add_flag("--wait", wait, "Every frame waits for the squares of a world that it wants: the same in every run");
}

void add_camera_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--camera", options.camera,
                 "Position in metres and angles in degrees instead of the scene's; z may be +1.7: above the ground")
      ->type_name("x,y,z,yaw,pitch")
      ->check(as_check(parse_camera));
}

void add_sun_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--sun", options.sun, "Degrees: azimuth (0 east, counter-clockwise) and elevation")
      ->type_name("AZIMUTH,ELEVATION")
      ->check(as_check([](const std::string& text) { return parse_numbers(text, 2, 2); }));
}

void add_shaders_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--shaders", options.shaders, "Folder whose files replace shaders of the same name")->type_name("DIR");
}

Expected<gl::ShaderLibrary> make_shaders(const SceneOptions& options) {
  std::error_code ignored;
  if (!options.shaders.empty() && !std::filesystem::is_directory(options.shaders, ignored))
    return fail(options.shaders + ": there is no such folder of shaders");
  return gl::ShaderLibrary(options.shaders);
}

void add_season_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--season", options.season, "Time of the year, 0 to 1, instead of the scene's")->type_name("SEASON");
}

void add_source_option(CLI::App& app, SceneOptions& options) {
  app.add_option("--source", options.source, "What draws the ground and seeds plants on it, instead of the scene's")
      ->check(CLI::IsMember({"roam", "clipmap"}))
      ->type_name("roam|clipmap");
}

Expected<Scene> make_scene(const SceneOptions& options) {
  auto scene = read_scene(options.scene);
  if (!scene) return scene;
  if (auto done = override_world(options, *scene); !done) return tl::unexpected(done.error());
  if (auto done = override_heights(options, *scene); !done) return tl::unexpected(done.error());
  if (auto done = override_view(options, *scene); !done) return tl::unexpected(done.error());
  if (!options.texture.empty()) scene->texture_path = absolute(options.texture);
  if (!options.source.empty())
    scene->source = options.source == "clipmap" ? TerrainSource::clipmap : TerrainSource::roam;
  if (options.triangles && scene->source == TerrainSource::clipmap)
    return fail(
        "--triangles is the budget of a mesh, and a clipmap draws its rings whole; leave it out or take "
        "--source roam");
  scene->max_triangles = options.triangles.value_or(scene->max_triangles);
  if (options.season) {
    if (!(*options.season >= 0 && *options.season <= 1)) return fail("--season must be a number from 0 to 1");
    scene->season = *options.season;
    for (Layer& layer : scene->layers) layer.season = scene->season;
  }
  if (auto loaded = host::load_maps(*scene); !loaded) return tl::unexpected(loaded.error());
  return scene;
}

Expected<void> check_wait(const Scene& scene, bool wait) {
  if (!wait || !scene.world_path.empty()) return {};
  return fail("--wait is for worlds, and this scene has none; add --world");
}

Expected<std::unique_ptr<host::SceneTerrain>> make_terrain(const Scene& scene, const SceneOptions& options) {
  ProgressLine line("terrain");
  auto terrain = host::load_terrain(scene, options.detail == "on", line.callback());
  if (!terrain) return terrain;
  for (const std::string& warning : (*terrain)->warnings())
    std::fprintf(stderr, "sward: warning: %s\n", warning.c_str());
  return terrain;
}

gl::Lighting make_lighting(const Scene& scene) {
  gl::Lighting lighting = gl::Lighting::clear_day(scene.sun_azimuth, scene.sun_elevation);
  lighting.haze_distance_m = scene.haze_distance_m;
  lighting.ground_tint = ground_tint(scene.ground_seasons, scene.season);
  return lighting;
}

}  // namespace sward::tool
