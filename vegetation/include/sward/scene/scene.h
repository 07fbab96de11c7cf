// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/scene/scene_wind.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/ground_material.h>
#include <sward/terrain/height_field.h>
#include <sward/vegetation/species.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward {

/// What a time of the year makes of green ground: a factor on its linear colour.
struct GroundSeason {
  float at = 0;  ///< [0, 1); rising from one to the next.
  glm::vec3 tint{1.0f};
};

/// The factor at a time of the year, between frames as season_values(); 1 without frames.
SWARD_API glm::vec3 ground_tint(std::span<const GroundSeason> frames, float season);

/// A body that a layer with Layer::on_mesh covers: a file's mesh or a generated one (generate_mesh_shape).
struct SceneSurface {
  std::string layer;         ///< Name of the layer that covers it.
  std::string shape;         ///< "box_hedge", "topiary"; or empty, and
  std::string mesh_path;     ///< an OBJ, PLY or OFF file.
  glm::vec3 size_m{1.0f};    ///< Of a shape.
  uint32_t seed = 1;         ///< Of a shape.
  glm::dvec3 position{0.0};  ///< Of the mesh's origin.
  bool above_ground = true;  ///< position.z counts from the ground below the origin.
  bool drape = false;        ///< It counts from the ground below each vertex.
  double yaw = 0;            ///< Radians, counter-clockwise.
  double scale = 1;
  std::optional<glm::vec3> color;  ///< sRGB, 0..1, in place of the vertex colours.
};

/// What draws the ground, and cuts the triangles that plants are seeded on.
enum class TerrainSource {
  roam,     ///< RoamMesh and TerrainRenderer; seeding on the CPU.
  clipmap,  ///< gl::Clipmap and ClipmapRenderer; seeding on the GPU.
};

/// A material of the ground as a scene file names it.
struct SceneMaterial {
  GroundMaterial material;
  std::string species;      ///< Whose reference colour and weights it has; empty: its own.
  std::string detail_file;  ///< An image in place of the generated detail; empty: none. As all paths, not loaded.
  std::string cliff_file;
  std::string where;  ///< "FILE:LINE", for errors of the images.
};

/// Something that goes along a path and presses the plants: a person, a vehicle.
struct SceneWalker {
  bool wheels = false;           ///< Two unbroken tracks instead of steps.
  float radius_m = 0.14f;        ///< Of a foot, half the width of a wheel's track.
  float weight = 0.9f;           ///< How far plants are laid down, 0..1.
  float track_m = 0.22f;         ///< Between left and right.
  float step_m = 0.7f;           ///< From a foot to the other.
  std::vector<glm::dvec3> path;  ///< Time (s), world x, y (m): times rise; straight and at one speed in between.
};

/// Something that happens to the ground once.
struct SceneEvent {
  enum class Kind { explosion, cut, burn, wet, paint, rotor };
  Kind kind = Kind::explosion;
  double time_s = 0;
  glm::dvec2 position{0};        ///< World x, y.
  std::optional<glm::dvec2> to;  ///< The other end of a strip; not for explosion and rotor.
  double radius_m = 3;
  float amount = 1;                   ///< Of burn, wet, paint, rotor, 0..1.
  float height_m = 0.05f;             ///< That a cut leaves.
  glm::vec3 color{0.8f, 0.1f, 0.1f};  ///< Of paint, sRGB.
};

/// What has touched the ground before and what touches it as time goes on.
struct SceneDisturbance {
  std::string file;                                      ///< That Disturbance::save() wrote; empty: none.
  float press_half_life_s = 300, wet_half_life_s = 900;  ///< As DisturbanceOptions.
  double memory_mb = 64;                                 ///< DisturbanceOptions::memory_limit in 2^20 bytes.
  std::vector<SceneWalker> walkers;
  std::vector<SceneEvent> events;
};

/// A scene as a TOML file names it. Paths are kept as written; resolve() makes them relative to the file's folder.
struct SWARD_API Scene {
  std::string name;
  std::string directory;  ///< Folder of the file, for relative paths; empty for built-in scenes.

  // [terrain]
  // The ground is one of generator, height_path and world_path; the other two are empty.
  std::string generator;  ///< "meadow".
  uint32_t generator_seed = 1;
  int generator_samples = 1025;  ///< Along each side.
  double generator_size_m = 4096;
  std::string height_path;
  glm::dvec2 spacing{1.0, 1.0};
  double height_scale = 1.0, height_offset = 0.0;
  bool has_no_data = false;
  double no_data = 0;
  glm::dvec3 origin{0.0};
  std::string world_path;        ///< Folder of a baked world.
  double world_memory_mb = 512;  ///< WorldOptions::memory_bytes, in 2^20 bytes.
  float world_worth_px = 0.5f;   ///< WorldOptions::worth_px.
  ReliefOptions relief;
  TerrainSource source = TerrainSource::roam;
  uint32_t max_triangles = 20000;
  float target_px = 0;

  bool splatting = true;  ///< Detail textures on the ground.

  // [[terrain.material]]
  std::vector<SceneMaterial> materials;  ///< Empty: default_ground_materials().

  // [base_map]
  std::string texture_path;  ///< Empty: the generator's, or none.

  // [sun], [haze], [camera]
  float sun_azimuth = 2.4f, sun_elevation = 0.6f;  ///< Radians.
  float haze_distance_m = 12000;
  glm::dvec3 camera{0.0, 0.0, 1.7};
  bool camera_above_ground = true;                             ///< camera.z counts from the ground.
  bool camera_from_middle = false;                             ///< camera.x, y count from the middle of the ground.
  double camera_yaw = 0, camera_pitch = 0, fov_y = 0.8726646;  ///< Radians.

  // [season]
  float season = 0;  ///< Time of the year, 0..1; every layer's Layer::season.
  std::vector<GroundSeason> ground_seasons;

  // [[layer]] with [[layer.species]]. Masks and distribution maps are named, not loaded.
  std::vector<Layer> layers;

  // [[surface]]
  std::vector<SceneSurface> surfaces;

  // [disturbance]
  SceneDisturbance disturbance;

  // [[exclude]]
  std::vector<ExclusionShape> exclusions;

  // [wind]
  std::optional<SceneWind> wind;  ///< Empty: the air is dead.

  std::string resolve(const std::string& path) const;
};

/// What the ground of a scene is made of, for GroundTextures::set_materials: none without splatting; soil is added to a
/// list of which nothing is everywhere. Fails where an
/// image is named that has not been put into Scene::materials.
SWARD_API Expected<std::vector<GroundMaterial>> ground_materials(const Scene& scene);

/// Reads and checks a scene. Errors read "FILE:LINE: what is wrong, what was expected"; unknown keys, wrong types,
/// values out of range and contradictions (a generator and a height file, say) are errors.
SWARD_API Expected<Scene> load_scene(const std::string& path);
/// The same from text; `name` stands for the file in messages.
SWARD_API Expected<Scene> parse_scene(std::string_view text, const std::string& name);
/// The files of demo/scenes, embedded at build time.
SWARD_API std::span<const EmbeddedText> embedded_scenes();
/// Built-in scenes, embedded from demo/scenes: "meadow". Fails naming what there is.
SWARD_API Expected<Scene> builtin_scene(std::string_view name);

}  // namespace sward
