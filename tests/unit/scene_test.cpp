// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/scene/scene.h>
#include <sward/terrain/world.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "scene/scene_keys.h"

namespace {

using namespace sward;

constexpr double k_degree = std::numbers::pi / 180.0;

/// Lines of a sound scene; the number of a line in it is its index plus one.
const std::vector<std::string> k_lines{
    "name = \"test\"",         // 1
    "[terrain]",               // 2
    "generator = \"meadow\"",  // 3
    "samples = 257",           // 4
    "[[layer]]",               // 5
    "name = \"cover\"",        // 6
    "[[layer.species]]",       // 7
    "name = \"grass\"",        // 8
    "color = \"#6a8f3c\"",     // 9
    "[[layer.species]]",       // 10
    "name = \"soil\"",         // 11
    "kind = \"none\"",         // 12
    "hsv = [30, 0.4, 0.4]",    // 13
};

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// The sound scene with another line in the place of one; empty: without it.
std::string with_line(int line, const std::string& text) {
  std::vector<std::string> lines = k_lines;
  lines[size_t(line - 1)] = text;
  return joined(lines);
}

/// The sound scene with a further line after one.
std::string with_added(int line, const std::string& text) {
  std::vector<std::string> lines = k_lines;
  lines.insert(lines.begin() + line, text);
  return joined(lines);
}

void expect_error(const std::string& text, int line, const std::string& words) {
  const auto scene = parse_scene(text, "t.toml");
  ASSERT_FALSE(scene) << "expected an error with: " << words << "\n" << text;
  const std::string& message = scene.error().message;
  const std::string place = "t.toml:" + std::to_string(line) + ": ";
  EXPECT_EQ(message.substr(0, place.size()), place) << message << "\n" << text;
  EXPECT_NE(message.find(words), std::string::npos) << message << "\nexpected: " << words;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Scene, ReadsEveryKey) {
  const auto parsed = parse_scene(R"(
name = "all"
[terrain]
height = "maps/h.tif"
spacing_m = [63.5, 92.6]
height_scale_m = 0.1
height_offset_m = -12.5
no_data = -9999
origin_m = [1000.0, -2000, 3.5]
max_triangles = 12345
target_px = 1.5
[terrain.relief]
enabled = false
roughness = 0.1
flat_share = 0.5
full_slope = 1.25
finest_edge_m = 2
seed = 4294967295
[base_map]
texture = "maps/c.png"
[sun]
azimuth_deg = 90
elevation_deg = 30
[haze]
distance_m = 5000
[camera]
position_m = [1, 2, 3]
above_ground = false
yaw_deg = -45
pitch_deg = -10
fov_deg = 60
[[layer]]
name = "low"
triangle_area_m2 = 2.5
horizon_m = 80
cluster_size = 4
law = "screen_area"
density = 50000
falloff = 0.5
ceiling = 1000
plain = true
full_segments_m = 9
shadows = true
shadow_distance_m = 33
[[layer.species]]
name = "grass"
kind = "blade"
color = "#00ff80"
weights = [3, 2, 1]
exponent = 1.5
threshold = 0.25
height_m = [0.1, 0.2]
width_m = [0.01, 0.02]
stiffness = [0.25, 0.75]
lean_deg = 45
phototropism = 0.5
segments = 16
tint = [1, 2, 3]
age_tint = [4, 5, 6]
age_share = 0.125
root_shade = 0.25
translucency = 0.75
attenuation = 0.625
specular = 0.375
shininess = 7
detail = "fibres"
detail_strength = 0.25
detail_repeat = 3
cutout = "maps/cut.png"
[[layer.species]]
name = "water"
kind = "none"
hsv = [180, 0.5, 0.25]
forbids = true
threshold = inf
[[layer]]
name = "high"
law = "distance"
full_distance_m = 7
shadows = false
[[layer.species]]
name = "tall"
hsv = [0, 1, 1]
)",
                                  "all.toml");
  ASSERT_TRUE(parsed) << parsed.error().message;
  const Scene& s = *parsed;
  EXPECT_EQ(s.name, "all");
  EXPECT_EQ(s.generator, "");
  EXPECT_EQ(s.height_path, "maps/h.tif");
  EXPECT_EQ(s.spacing, glm::dvec2(63.5, 92.6));
  EXPECT_EQ(s.height_scale, 0.1);
  EXPECT_EQ(s.height_offset, -12.5);
  EXPECT_TRUE(s.has_no_data);
  EXPECT_EQ(s.no_data, -9999.0);
  EXPECT_EQ(s.origin, glm::dvec3(1000, -2000, 3.5));
  EXPECT_EQ(s.max_triangles, 12345u);
  EXPECT_EQ(s.target_px, 1.5f);
  EXPECT_FALSE(s.relief.enabled);
  EXPECT_EQ(s.relief.roughness, 0.1f);
  EXPECT_EQ(s.relief.flat_share, 0.5f);
  EXPECT_EQ(s.relief.full_slope, 1.25f);
  EXPECT_EQ(s.relief.finest_edge_m, 2.0f);
  EXPECT_EQ(s.relief.seed, 4294967295u);
  EXPECT_EQ(s.texture_path, "maps/c.png");
  EXPECT_FLOAT_EQ(s.sun_azimuth, float(90 * k_degree));
  EXPECT_FLOAT_EQ(s.sun_elevation, float(30 * k_degree));
  EXPECT_EQ(s.haze_distance_m, 5000.0f);
  EXPECT_EQ(s.camera, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(s.camera_above_ground);
  EXPECT_DOUBLE_EQ(s.camera_yaw, -45 * k_degree);
  EXPECT_DOUBLE_EQ(s.camera_pitch, -10 * k_degree);
  EXPECT_DOUBLE_EQ(s.fov_y, 60 * k_degree);

  ASSERT_EQ(s.layers.size(), 2u);
  const Layer& low = s.layers[0];
  EXPECT_EQ(low.name, "low");
  EXPECT_EQ(low.triangle_area_m2, 2.5f);
  EXPECT_EQ(low.horizon_m, 80.0f);
  EXPECT_EQ(low.cluster_size, 4);
  EXPECT_EQ(low.law, DensityLaw::screen_area);
  EXPECT_EQ(low.density, 50000.0f);
  EXPECT_EQ(low.falloff, 0.5f);
  EXPECT_EQ(low.ceiling, 1000);
  EXPECT_TRUE(low.plain);
  EXPECT_EQ(low.full_segments_m, 9.0f);
  EXPECT_TRUE(low.shadows);
  EXPECT_EQ(low.shadow_distance_m, 33.0f);
  EXPECT_EQ(s.layers[1].law, DensityLaw::distance);
  EXPECT_EQ(s.layers[1].full_distance_m, 7.0f);
  EXPECT_FALSE(s.layers[1].shadows);

  ASSERT_EQ(low.species.size(), 2u);
  const Species& grass = low.species[0];
  EXPECT_EQ(grass.name, "grass");
  EXPECT_EQ(grass.kind, PlantKind::blade);
  // #00ff80: green leads, blue follows by 128 of 255: hue (2 + 128/255) / 6 turns.
  EXPECT_FLOAT_EQ(grass.reference_hsv.x, float((2.0 + 128.0 / 255.0) / 6.0));
  EXPECT_FLOAT_EQ(grass.reference_hsv.y, 1.0f);
  EXPECT_FLOAT_EQ(grass.reference_hsv.z, 1.0f);
  EXPECT_EQ(grass.weights, glm::vec3(3, 2, 1));
  EXPECT_EQ(grass.exponent, 1.5f);
  EXPECT_EQ(grass.max_distance, 0.25f);
  EXPECT_EQ(grass.height_m.min, 0.1f);
  EXPECT_EQ(grass.height_m.max, 0.2f);
  EXPECT_EQ(grass.width_m.min, 0.01f);
  EXPECT_EQ(grass.width_m.max, 0.02f);
  EXPECT_EQ(grass.stiffness.min, 0.25f);
  EXPECT_EQ(grass.stiffness.max, 0.75f);
  EXPECT_FLOAT_EQ(grass.lean, float(45 * k_degree));
  EXPECT_EQ(grass.phototropism, 0.5f);
  EXPECT_EQ(grass.max_segments, 16);
  EXPECT_EQ(grass.tint, glm::vec3(1, 2, 3));
  EXPECT_EQ(grass.age_tint, glm::vec3(4, 5, 6));
  EXPECT_EQ(grass.age_share, 0.125f);
  EXPECT_EQ(grass.root_shade, 0.25f);
  EXPECT_EQ(grass.translucency, 0.75f);
  EXPECT_EQ(grass.attenuation, 0.625f);
  EXPECT_EQ(grass.specular, 0.375f);
  EXPECT_EQ(grass.shininess, 7.0f);
  EXPECT_EQ(grass.detail_file.path, "fibres");
  EXPECT_TRUE(grass.detail_file.place.starts_with("all.toml:")) << grass.detail_file.place;
  EXPECT_EQ(grass.detail_strength, 0.25f);
  EXPECT_EQ(grass.detail_repeat, 3.0f);
  EXPECT_EQ(grass.cutout_file.path, "maps/cut.png");
  const Species& water = low.species[1];
  EXPECT_EQ(water.kind, PlantKind::none);
  EXPECT_TRUE(water.forbids);
  EXPECT_EQ(water.reference_hsv, glm::vec3(0.5f, 0.5f, 0.25f));
  EXPECT_TRUE(std::isinf(water.max_distance));
}

TEST(Scene, ColorsAsAPickerShowsThem) {
  const std::vector<std::pair<std::string, glm::vec3>> known{
      {"#ff0000", {0, 1, 1}},
      {"#ffff00", {60, 1, 1}},
      {"#00FF00", {120, 1, 1}},
      {"#0000ff", {240, 1, 1}},
      {"#ff00ff", {300, 1, 1}},
      {"#800000", {0, 1, 128 / 255.0f}},
      {"#808080", {0, 0, 128 / 255.0f}},
      {"#000000", {0, 0, 0}},
      {"#ffffff", {0, 0, 1}},
      {"#bf8040", {30.236f, 0.6649f, 0.749f}},
  };
  for (const auto& [text, hsv] : known) {
    const auto scene = parse_scene(with_line(9, "color = \"" + text + "\""), "t.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    const glm::vec3 read = scene->layers[0].species[0].reference_hsv;
    EXPECT_NEAR(read.x * 360, hsv.x, 1e-2) << text;
    EXPECT_NEAR(read.y, hsv.y, 1e-4) << text;
    EXPECT_NEAR(read.z, hsv.z, 1e-4) << text;
  }
}

TEST(Scene, WhatIsNotWrittenHasTheHeadersDefault) {
  const auto scene = parse_scene(joined(k_lines), "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->generator, "meadow");
  EXPECT_EQ(scene->generator_samples, 257);
  EXPECT_EQ(scene->generator_size_m, Scene().generator_size_m);
  EXPECT_FALSE(scene->has_no_data);
  EXPECT_EQ(scene->fov_y, Scene().fov_y);
  EXPECT_EQ(scene->layers[0].density, Layer().density);
  EXPECT_EQ(scene->layers[0].species[0].weights, Species().weights);
  EXPECT_EQ(scene->layers[0].species[0].max_distance, Species().max_distance);
}

TEST(Scene, OneSpacingServesBothAxes) {
  const auto scene = parse_scene("[terrain]\nheight = \"a.png\"\nspacing_m = 160\n", "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->spacing, glm::dvec2(160, 160));
}

TEST(Scene, UnknownKeysNameTheNearest) {
  expect_error(with_added(4, "size = 3"), 5, "unknown key \"size\" in [terrain], expected \"size_m\"");
  expect_error(with_added(6, "horizont_m = 3"), 7, "expected \"horizon_m\"");
  expect_error(with_added(9, "heigth_m = [1, 2]"), 10, "expected \"height_m\"");
  expect_error(with_line(9, "colour = \"#112233\""), 9, "expected \"color\"");
  expect_error("terain = 1\n" + joined(k_lines), 1, "expected \"terrain\"");
  expect_error(with_added(9, "bananas = 3"), 10,
               "unknown key \"bananas\" in [[layer.species]], expected one of name, kind, color");
  expect_error(joined(k_lines) + "[suns]\nx = 1\n", 14, "expected \"sun\"");
  expect_error(joined(k_lines) + "[terrain.releif]\nseed = 1\n", 14, "expected \"relief\"");
  expect_error(joined(k_lines) + "[camera]\nyaw = 1\n", 15, "expected \"yaw_deg\"");
}

TEST(Scene, TheFirstFaultIsReported) {
  expect_error(with_line(3, "zebra = 1\ngenerator = \"meadow\"\naardvark = 2"), 3, "zebra");
}

TEST(Scene, WrongTypes) {
  expect_error(with_line(1, "name = 3"), 1, "name = 3 in the scene: expected a word");
  expect_error(with_line(3, "generator = true"), 3, "generator = true in [terrain]: expected \"meadow\"");
  expect_error(with_line(4, "samples = \"many\""), 4,
               "samples = \"many\" in [terrain]: expected a whole number in [65, 8193]");
  expect_error(with_line(4, "samples = 257.0"), 4, "expected a whole number");
  expect_error(with_added(6, "plain = 1"), 7, "plain = 1 in [[layer]]: expected true or false");
  expect_error(with_added(6, "horizon_m = [1, 2]"), 7, "horizon_m = [1, 2]");
  expect_error(with_added(6, "horizon_m = 2024-01-01"), 7, "a date or time");
  expect_error(with_added(6, "horizon_m = { a = 1 }"), 7, "a table");
  expect_error(with_added(9, "height_m = 3"), 10, "expected [min, max]");
  expect_error(with_added(9, "height_m = [1]"), 10, "expected [min, max]");
  expect_error(with_added(9, "height_m = [0.1, 0.2, 0.3]"), 10, "expected [min, max]");
  expect_error(with_added(9, "tint = [1, \"a\", 3]"), 10, "expected three numbers");
  expect_error(with_line(9, "color = [1, 2, 3]"), 9, "expected \"#rrggbb\"");
  expect_error(with_line(12, "kind = \"nothing\""), 12, "expected \"blade\" or \"none\"");
  expect_error("terrain = 3\n", 1, "expected a table [terrain]");
  expect_error("name = \"x\"\n[terrain]\ngenerator = \"meadow\"\n[layer]\nname = \"x\"\n", 4, "[[layer]]");
  expect_error("layer = [1, 2]\n[terrain]\ngenerator = \"meadow\"\n", 1, "[[layer]]");
  expect_error("[terrain]\nheight = \"a\"\nspacing_m = [1, 2, 3]\n", 3, "spacing_m = [1, 2, 3]");
}

TEST(Scene, ValuesOutOfRange) {
  const std::vector<std::pair<std::string, std::string>> layer_lines{
      {"horizon_m = 0", "> 0"},        {"horizon_m = -5", "> 0"},          {"horizon_m = nan", "> 0"},
      {"horizon_m = inf", "> 0"},      {"horizon_m = 1e300", "> 0"},       {"horizon_m = 1e-300", "> 0"},
      {"cluster_size = 0", "[1, 32]"}, {"cluster_size = 33", "[1, 32]"},   {"density = 0", "> 0"},
      {"falloff = 0", "(0, 16]"},      {"shadow_distance_m = -1", ">= 0"}, {"triangle_area_m2 = 0.0", "> 0"},
      {"full_segments_m = 0", "> 0"},  {"name = \"\"", "a word"}};
  for (const auto& [line, words] : layer_lines) {
    if (line.starts_with("name"))
      expect_error(with_line(6, line), 6, words);
    else
      expect_error(with_added(6, line), 7, words);
  }
  for (const std::string line :
       {"exponent = 0",           "exponent = 9",           "threshold = 0",           "threshold = -1",
        "threshold = nan",        "weights = [0, 0, 0]",    "weights = [-1, 0, 1]",    "weights = [1, 1, 101]",
        "height_m = [0, 1]",      "height_m = [2, 1]",      "height_m = [1, 201]",     "height_m = [nan, 1]",
        "width_m = [0.0, 0.1]",   "stiffness = [0.5, 1.5]", "stiffness = [-0.1, 0.5]", "lean_deg = 91",
        "phototropism = 2",       "segments = 0",           "segments = 65",           "tint = [-1, 1, 1]",
        "age_tint = [1, inf, 1]", "age_share = 1.1",        "root_shade = -0.1",       "translucency = -1",
        "attenuation = -1",       "specular = -1",          "shininess = 0.5",         "detail = 1",
        "detail_strength = 1.5",  "detail_repeat = 0",      "cutout = \"\""}) {
    expect_error(with_added(9, line), 10, line.substr(0, line.find(' ')) + " = ");
  }
  for (const std::string line : {"samples = 64", "samples = 8194", "size_m = 0", "seed = -1", "seed = 4294967296",
                                 "max_triangles = 0", "max_triangles = 99999999999", "target_px = -1"}) {
    expect_error("[terrain]\ngenerator = \"meadow\"\n" + line + "\n", 3, line.substr(0, line.find(' ')) + " = ");
  }
  for (const std::string line :
       {"spacing_m = 0", "spacing_m = [1, 0]", "spacing_m = nan", "height_scale_m = 0", "height_scale_m = inf",
        "height_offset_m = nan", "no_data = nan", "origin_m = [0, nan, 0]"}) {
    expect_error("[terrain]\nheight = \"a.png\"\n" + line + "\n", 3, line.substr(0, line.find(' ')) + " = ");
  }
  for (const std::string line :
       {"hsv = [360, 1, 1]", "hsv = [-1, 1, 1]", "hsv = [1, 1.5, 1]", "hsv = [1, 1, -0.5]", "hsv = [1, 1]",
        "color = \"6a8f3c\"", "color = \"#6a8f3\"", "color = \"#6a8f3g\"", "color = \"#6a8f3c00\""}) {
    expect_error(with_line(9, line), 9, line.substr(0, line.find(' ')) + " = ");
  }
  for (const std::string line :
       {"[camera]\nfov_deg = 0", "[camera]\nfov_deg = 180", "[camera]\npitch_deg = 91",
        "[camera]\nposition_m = [0, 0, nan]", "[sun]\nelevation_deg = 91", "[haze]\ndistance_m = 0"}) {
    expect_error(joined(k_lines) + line + "\n", 15, "expected");
  }
}

TEST(Scene, LargestHueStaysBelowAFullTurn) {
  const auto scene = parse_scene(with_line(9, "hsv = [359.99999999, 1, 1]"), "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(scene->layers[0].species[0].reference_hsv.x, 1.0f);
}

TEST(Scene, SourcesOfTerrain) {
  const std::string meadow = "[terrain]\ngenerator = \"meadow\"\n";
  EXPECT_EQ(parse_scene(meadow, "t.toml")->source, TerrainSource::roam);
  EXPECT_EQ(parse_scene(meadow + "source = \"roam\"\n", "t.toml")->source, TerrainSource::roam);
  EXPECT_EQ(parse_scene(meadow + "source = \"clipmap\"\n", "t.toml")->source, TerrainSource::clipmap);
  EXPECT_TRUE(parse_scene("[terrain]\nworld = \"w\"\nsource = \"clipmap\"\n", "t.toml"));
  for (const char* line : {"source = \"clipmaps\"", "source = \"\"", "source = 1", "source = true"})
    expect_error(meadow + line + "\n", 3, "expected \"roam\" or \"clipmap\"");
  for (const std::string key : {"max_triangles", "target_px"})
    expect_error(meadow + "source = \"clipmap\"\n" + key + " = 100\n", 4, key + " has no effect on a clipmap");
}

TEST(Scene, Worlds) {
  const auto scene = parse_scene("[terrain]\nworld = \"tiles/w\"\nmemory_mb = 1500.5\nworth_px = 2\n", "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->world_path, "tiles/w");
  EXPECT_EQ(scene->world_memory_mb, 1500.5);
  EXPECT_EQ(scene->world_worth_px, 2.0f);
  EXPECT_EQ(scene->generator + scene->height_path, "");
  EXPECT_FALSE(scene->camera_from_middle);
  // Defaults are the library's.
  EXPECT_EQ(size_t(Scene().world_memory_mb * (1 << 20)), WorldOptions().memory_bytes);
  EXPECT_EQ(Scene().world_worth_px, WorldOptions().worth_px);

  const std::string world = "[terrain]\nworld = \"w\"\n";
  for (const char* line : {"memory_mb = 0", "memory_mb = -1", "memory_mb = inf", "memory_mb = 1e10",
                           "memory_mb = \"512\"", "worth_px = -0.5", "worth_px = nan", "worth_px = true"})
    expect_error(world + line + "\n", 3, std::string(line).substr(0, std::string(line).find(' ')) + " = ");
  for (const char* line : {"seed = 1", "samples = 257", "size_m = 9"})
    expect_error(world + line + "\n", 3, "has no effect on a world");
  for (const char* line : {"spacing_m = 2", "height_scale_m = 2", "height_offset_m = 1", "no_data = 0",
                           "origin_m = [0, 0, 0]", "relief = { smooth = false }"})
    expect_error(world + line + "\n", 3, "has no effect on a world, which was baked with its own");
  expect_error("[terrain]\nworld = 3\n", 2, "world = 3 in [terrain]: expected the path of a folder");
  expect_error("[terrain]\nworld = \"\"\n", 2, "world = ");
  expect_error("[terrain]\nwrold = \"w\"\n", 2, "expected \"world\"");
  expect_error("[terrain]\nheight = \"a.png\"\nworld = \"w\"\n", 3, "height and world contradict");
  expect_error("[terrain]\nworld = \"w\"\ngenerator = \"meadow\"\n", 2, "generator and world contradict");
  expect_error("[terrain]\nheight = \"a.png\"\nmemory_mb = 9\n", 3, "memory_mb has no effect on ground that is no");
  expect_error("[terrain]\nworth_px = 1\ngenerator = \"meadow\"\n", 2, "worth_px has no effect");
}

TEST(Scene, Contradictions) {
  expect_error("[terrain]\ngenerator = \"meadow\"\nheight = \"a.png\"\n", 3, "contradict");
  expect_error("[terrain]\nmax_triangles = 100\n", 1, "expected generator = \"meadow\", height = \"FILE\" or world");
  expect_error("name = \"x\"\n", 1, "no [terrain]");
  expect_error("", 1, "no [terrain]");
  expect_error("[terrain]\ngenerator = \"meadow\"\nspacing_m = 2\n", 3, "spacing_m has no effect on generated terrain");
  expect_error("[terrain]\nno_data = 0\ngenerator = \"meadow\"\n", 2, "no_data has no effect");
  expect_error("[terrain]\nheight = \"a.png\"\nsamples = 257\n", 3, "samples has no effect on a height file");
  expect_error(with_added(9, "hsv = [1, 1, 1]"), 10, "color and hsv contradict");
  expect_error(with_line(9, ""), 7, "species \"grass\" has no colour");
  expect_error(with_line(8, ""), 7, "no name");
  expect_error(with_line(11, "name = \"grass\""), 11, "a second species is named \"grass\"");
  expect_error(joined(k_lines) + "[[layer]]\nname = \"cover\"\n[[layer.species]]\nname = \"a\"\ncolor = \"#112233\"\n",
               15, "a second layer is named \"cover\"");
  expect_error(with_added(12, "height_m = [1, 2]"), 13, "height_m has no effect where nothing grows");
  expect_error(with_added(9, "forbids = true"), 10, "forbids has no effect on what grows");
  for (const char* key : {"stiffness = [0, 1]", "lean_deg = 3", "phototropism = 1", "attenuation = 1", "leaves = 4",
                          "trunk_share = 0.1"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(' '));
    expect_error(with_added(9, "kind = \"gravel\"\n" + std::string(key)), 11, name + " has no effect");
  }
  expect_error(with_added(9, "kind = \"litter\"\nlean_deg = 3"), 11, "lean_deg has no effect");
  expect_error(with_added(9, "kind = \"billboard\"\nstiffness = [0, 1]"), 11, "stiffness has no effect");
  expect_error(with_added(9, "kind = \"billboard\"\nleaves = 3"), 11, "leaves has no effect");
  expect_error(with_added(9, "kind = \"fern\"\ntaper = 1"), 11, "taper has no effect");
  expect_error(with_added(9, "kind = \"fern\"\nleaves = 9"), 11, "leaves = 9");
  expect_error(with_added(9, "kind = \"billboard\"\ntrunk_share = 0.95"), 11, "trunk_share = 0.95");
  expect_error(with_added(9, "kind = \"bush\""), 10, "kind = \"bush\"");
  expect_error(with_added(6, "ceiling = 5"), 7, "ceiling has no effect under law = \"distance\"");
  expect_error(with_added(6, "law = \"screen_area\"\nplain = true\nfull_distance_m = 5"), 9,
               "full_distance_m has no effect");
  expect_error(with_added(6, "law = \"world_area\"\nfalloff = 2"), 8, "falloff has no effect");
  expect_error(with_added(6, "shadows = false\nshadow_distance_m = 2"), 8, "shadow_distance_m has no effect");
  expect_error("[terrain]\ngenerator = \"meadow\"\n[[layer]]\nname = \"bare\"\n", 3, "layer \"bare\" has no species");
  // Found by the layer's own check: two million seeds a triangle.
  expect_error(with_added(6, "triangle_area_m2 = 2000\ndensity = 1000"), 5, "seeds a triangle");
}

/// The sound scene with another kind of grass, and a line after that.
std::string with_kind(const std::string& kind, const std::string& table) {
  return with_added(9, "kind = \"" + kind + "\"" + (table.empty() ? "" : "\n" + table));
}

TEST(Scene, KindsOfPlants) {
  const auto scene =
      parse_scene(with_kind("flower",
                            "flower = { petals = 5, petal_colors = [\"#ff0000\", \"#0000ff\"], petal_shares = [2, 1], "
                            "petal_width = 0.5, cup = -0.25, head_m = [0.01, 0.02], centre_color = \"#00ff00\", "
                            "centre_share = 0.5, stem_color = \"#ffffff\", leaves = 3 }"),
                  "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  const Species& flower = scene->layers[0].species[0];
  EXPECT_EQ(flower.kind, PlantKind::flower);
  EXPECT_EQ(flower.flower.petals, 5);
  ASSERT_EQ(flower.flower.petal_colors.size(), 2u);
  EXPECT_EQ(flower.flower.petal_colors[1], glm::vec3(0, 0, 1));
  EXPECT_EQ(flower.flower.petal_shares, (std::vector<float>{2, 1}));
  EXPECT_EQ(flower.flower.petal_width, 0.5f);
  EXPECT_EQ(flower.flower.cup, -0.25f);
  EXPECT_EQ(flower.flower.head_m.min, 0.01f);
  EXPECT_EQ(flower.flower.head_m.max, 0.02f);
  EXPECT_EQ(flower.flower.centre_color, glm::vec3(0, 1, 0));
  EXPECT_EQ(flower.flower.centre_share, 0.5f);
  EXPECT_TRUE(flower.flower.own_stem);
  EXPECT_EQ(flower.flower.stem_color, glm::vec3(1));
  EXPECT_EQ(flower.flower.leaves, 3);

  const auto tuft = parse_scene(with_kind("tuft", "tuft = { blades = [3, 9], spread_deg = 45 }"), "t.toml");
  ASSERT_TRUE(tuft) << tuft.error().message;
  EXPECT_EQ(tuft->layers[0].species[0].kind, PlantKind::tuft);
  EXPECT_EQ(tuft->layers[0].species[0].tuft.blades.min, 3);
  EXPECT_EQ(tuft->layers[0].species[0].tuft.blades.max, 9);
  EXPECT_FLOAT_EQ(tuft->layers[0].species[0].tuft.spread, float(45 * k_degree));

  const auto custom = parse_scene(
      with_kind("custom", "custom = { functions = \"a/reed.glsl\", shoots = 4, parameters = [1.5, -2] }"), "t.toml");
  ASSERT_TRUE(custom) << custom.error().message;
  EXPECT_EQ(custom->layers[0].species[0].kind, PlantKind::custom);
  EXPECT_EQ(custom->layers[0].species[0].custom.functions, "a/reed.glsl");
  EXPECT_EQ(custom->layers[0].species[0].custom.shoots, 4);
  EXPECT_EQ(custom->layers[0].species[0].custom.parameters, (std::vector<float>{1.5f, -2}));
}

TEST(Scene, KindsOfPlantsOutOfRange) {
  for (const std::string entry : {"petals = 2",
                                  "petals = 33",
                                  "petals = 5.5",
                                  "petal_colors = []",
                                  "petal_colors = [\"red\"]",
                                  "petal_colors = \"#ff0000\"",
                                  "petal_colors = [\"#1\", \"#2\"]",
                                  "petal_colors = [\"#111111\", \"#111111\", \"#111111\", \"#111111\", \"#111111\"]",
                                  "petal_shares = [-1]",
                                  "petal_shares = [nan]",
                                  "petal_shares = [0]",
                                  "petal_shares = [1, 1]",
                                  "petal_width = 0",
                                  "petal_width = 2.1",
                                  "cup = 2",
                                  "cup = -1.1",
                                  "head_m = [0, 1]",
                                  "head_m = [0.2, 0.1]",
                                  "head_m = 0.2",
                                  "centre_color = 3",
                                  "centre_share = 0.95",
                                  "stem_color = \"#12345\"",
                                  "leaves = -1",
                                  "leaves = 9",
                                  "petal = 5"}) {
    expect_error(with_kind("flower", "flower = { " + entry + " }"), 11, entry.substr(0, entry.find(' ')));
  }
  for (const std::string entry : {"blades = [0, 3]", "blades = [3, 10]", "blades = [5, 4]", "blades = 5",
                                  "blades = [1.5, 2]", "spread_deg = 91", "spread_deg = -1"}) {
    expect_error(with_kind("tuft", "tuft = { " + entry + " }"), 11, entry.substr(0, entry.find(' ')) + " = ");
  }
  for (const std::string entry : {"functions = \"\"", "functions = 3", "functions = \"a\", shoots = 13",
                                  "functions = \"a\", shoots = 0", "functions = \"a\", parameters = [nan]",
                                  "functions = \"a\", parameters = [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17]"}) {
    expect_error(with_kind("custom", "custom = { " + entry + " }"), 11, "expected");
  }
  expect_error(with_kind("custom", "custom = { shoots = 2 }"), 11, "no functions, expected functions = \"FILE\"");
  expect_error(with_kind("custom", ""), 7, "species \"grass\" has no functions");
  expect_error(with_kind("blade", "tuft = { }"), 11, "tuft has no effect on another kind");
  expect_error(with_kind("tuft", "flower = { }"), 11, "flower has no effect on another kind");
  expect_error(with_kind("flower", "custom = { functions = \"a\" }"), 11, "custom has no effect on another kind");
}

TEST(Scene, BrokenToml) {
  expect_error("[terrain\n", 1, "expected TOML");
  expect_error(with_added(1, "a" + std::string(65, '.')), 2, "more than 64 dots");
  expect_error(with_line(4, "samples = = 3"), 4, "expected TOML");
  expect_error(with_added(4, "samples = 300"), 5, "expected TOML");
  expect_error(with_line(6, "name = \"open"), 6, "expected TOML");
  const auto cut = parse_scene("[terrain]\nenabled = tru\n", "t.toml");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().message.find('\n'), std::string::npos) << cut.error().message;
  expect_error(with_line(6, "name = \"\xff\xfe\""), 6, "expected TOML");
  expect_error(std::string("name = \"x\"\n\0\0\0", 14), 2, "expected TOML");
}

TEST(Scene, PathsAreRelativeToTheFile) {
  Scene scene;
  EXPECT_EQ(scene.resolve("a/b.png"), "a/b.png");
  scene.directory = "/maps/puget";
  EXPECT_EQ(scene.resolve("h.png"), "/maps/puget/h.png");
  EXPECT_EQ(scene.resolve("../h.png"), "/maps/h.png");
  EXPECT_EQ(scene.resolve("/other/h.png"), "/other/h.png");
  EXPECT_EQ(scene.resolve(""), "");
}

TEST(Scene, LoadsFilesAndNamesBadOnes) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "sward_scene_test";
  fs::create_directories(folder);
  const std::string path = (folder / "s.toml").string();
  std::ofstream(path) << joined(k_lines);
  const auto scene = load_scene(path);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->directory, folder.string());
  std::ofstream(path) << with_line(4, "samples = 1");
  EXPECT_EQ(load_scene(path).error().message.substr(0, path.size() + 3), path + ":4:");
  std::ofstream(path, std::ios::trunc).close();
  EXPECT_NE(load_scene(path).error().message.find("no [terrain]"), std::string::npos);
  EXPECT_NE(load_scene((folder / "none.toml").string()).error().message.find("does not exist"), std::string::npos);
  EXPECT_NE(load_scene(folder.string()).error().message.find("no file"), std::string::npos);
  EXPECT_NE(load_scene("").error().message.find("does not exist"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Scene, BuiltInScenesAreSound) {
  ASSERT_GE(embedded_scenes().size(), 2u);
  for (const EmbeddedText& text : embedded_scenes()) {
    const auto scene = parse_scene(text.text, std::string(text.name));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name + ".toml", text.name);
    EXPECT_FALSE(scene->layers.empty());
  }
  const auto meadow = builtin_scene("meadow");
  ASSERT_TRUE(meadow) << meadow.error().message;
  EXPECT_EQ(meadow->generator, "meadow");
  EXPECT_EQ(meadow->directory, "");
  int grasses = 0;
  for (const Species& species : meadow->layers[0].species) grasses += species.kind == PlantKind::blade ? 1 : 0;
  EXPECT_GE(grasses, 2);
  const auto puget = builtin_scene("puget");
  ASSERT_TRUE(puget) << puget.error().message;
  EXPECT_EQ(puget->spacing, glm::dvec2(160, 160));
  EXPECT_EQ(puget->height_scale, 0.1);
  const auto missing = builtin_scene("moon");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("\"moon\", expected one of \"border\", \"flowers\", \"garden\", "),
            std::string::npos)
      << missing.error().message;
}

// ---- The reader's own table, and the page that describes it ----

template <class T>
void expect_described(const scene_file::Schema<T>& schema, const std::string& page) {
  const size_t begin = page.find("\n## `" + schema.title + "`");
  ASSERT_NE(begin, std::string::npos) << "docs/scene_format.md has no section " << schema.title;
  const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
  std::set<std::string> known;
  for (const auto& key : schema.keys) {
    known.insert(key.name);
    if (key.read_table) continue;
    EXPECT_NE(section.find("| `" + key.name + "` | " + key.expected + " |"), std::string::npos)
        << "docs/scene_format.md, " << schema.title << ": no row | `" << key.name << "` | " << key.expected << " |";
  }
  for (size_t at = section.find("\n| `"); at != std::string::npos; at = section.find("\n| `", at + 1)) {
    const std::string name = section.substr(at + 4, section.find('`', at + 4) - at - 4);
    EXPECT_TRUE(known.contains(name)) << "docs/scene_format.md, " << schema.title << " describes " << name
                                      << ", which is no key";
  }
}

TEST(Scene, ThePageDescribesEveryKey) {
  std::ifstream stream(std::filesystem::path(SWARD_TEST_DATA).parent_path().parent_path() / "docs" / "scene_format.md");
  ASSERT_TRUE(stream);
  const std::string page((std::istreambuf_iterator<char>(stream)), {});
  expect_described(scene_file::terrain_schema(), page);
  expect_described(scene_file::relief_schema(), page);
  expect_described(scene_file::material_schema(), page);
  expect_described(scene_file::base_map_schema(), page);
  expect_described(scene_file::sun_schema(), page);
  expect_described(scene_file::haze_schema(), page);
  expect_described(scene_file::camera_schema(), page);
  expect_described(scene_file::surface_schema(), page);
  expect_described(scene_file::plant_mesh_schema(), page);
  expect_described(scene_file::layer_schema(), page);
  expect_described(scene_file::species_schema(), page);
  expect_described(scene_file::tuft_schema(), page);
  expect_described(scene_file::flower_schema(), page);
  expect_described(scene_file::custom_schema(), page);
  expect_described(scene_file::species_season_schema(), page);
  expect_described(scene_file::season_schema(), page);
  expect_described(scene_file::ground_season_schema(), page);
  expect_described(scene_file::exclude_schema(), page);
  expect_described(scene_file::wind_schema(), page);
  expect_described(scene_file::wind_source_schema(), page);
  expect_described(scene_file::wind_mover_schema(), page);
  expect_described(scene_file::disturbance_schema(), page);
  expect_described(scene_file::walker_schema(), page);
  expect_described(scene_file::event_schema(), page);
}

}  // namespace
