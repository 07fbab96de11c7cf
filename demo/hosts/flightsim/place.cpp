// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "flightsim/place.h"

#include <sward/image_io/image_io.h>
#include <sward/scene/generated_terrain.h>
#include <sward/terrain/bounds.h>
#include <sward/terrain/edits.h>
#include <sward/terrain/world_bake.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace flightsim {

namespace {

using sward::Expected;
using sward::fail;

constexpr int k_samples = 2049;
constexpr double k_spacing_m = 4;
constexpr int k_square_bits = 8;
constexpr double k_level_m = 40;  // level ground beside and before the strip
constexpr double k_ease_m = 160;  // over which it goes over into the hills

Strip bare_strip() {
  Strip strip;
  strip.threshold = {-350, -600};
  strip.length_m = 700;
  strip.width_m = 14;
  return strip;
}

// In step with bare_strip().
constexpr const char* k_scene =
    R"(# A grass strip among meadows, made by the flight simulator: a runway on which nothing stands, and tall grass beside it.
#   sward fly strip.toml --flight flight.csv

name = "strip"

[terrain]
world = "world"
max_triangles = 20000

[base_map]
texture = "ground.png"

[[terrain.material]]
species = "meadow_grass"
detail = "grass"

[[terrain.material]]
species = "straw_grass"
detail = "grass"

[[terrain.material]]
species = "soil"
detail = "soil"

[[terrain.material]]
species = "rock"
detail = "rock"
cliff_detail = "strata"
tile_m = 3.0
relief_m = 0.15

[[terrain.material]]
species = "snow"
detail = "snow"
tile_m = 4.0

[sun]
azimuth_deg = 205.0
elevation_deg = 30.0

[haze]
distance_m = 14000.0

[camera]
position_m = [-330.0, -606.0, 1.7]
above_ground = true
yaw_deg = 12.0
pitch_deg = -3.0
fov_deg = 55.0

[wind]
speed_m_s = 3.0
from_deg = 70.0

[[exclude]]
polygon = [[-350.0, -607.0], [350.0, -607.0], [350.0, -593.0], [-350.0, -593.0]]

[[layer]]
name = "ground_cover"
triangle_area_m2 = 1.6
horizon_m = 110.0
density = 500.0
full_distance_m = 5.0

[[layer.species]]
name = "meadow_grass"
hsv = [77.0, 0.46, 0.43]
weights = [3.0, 1.0, 0.3]
threshold = 0.4
height_m = [0.2, 0.45]
width_m = [0.004, 0.008]
stiffness = [0.4, 0.8]
age_share = 0.25

[[layer.species]]
name = "straw_grass"
hsv = [48.0, 0.42, 0.58]
weights = [3.0, 1.0, 0.5]
threshold = 0.35
height_m = [0.3, 0.6]
width_m = [0.003, 0.006]
stiffness = [0.55, 0.9]
lean_deg = 14.0
age_share = 0.6

[[layer.species]]
name = "soil"
kind = "none"
hsv = [31.0, 0.39, 0.43]
weights = [3.0, 1.0, 0.5]

# Rock and snow are nearly grey: their hue says nothing.
[[layer.species]]
name = "rock"
kind = "none"
hsv = [40.0, 0.08, 0.46]
weights = [0.0, 1.0, 0.3]

[[layer.species]]
name = "snow"
kind = "none"
hsv = [214.0, 0.03, 0.94]
weights = [0.0, 1.0, 0.5]
)";

Expected<void> level_ground(sward::HeightField& field) {
  const Strip strip = bare_strip();
  const double margin = k_level_m + k_ease_m;
  sward::Edit flat;
  flat.kind = sward::Edit::Kind::flatten;
  flat.region =
      sward::EditRegion::rectangle(strip.at(-margin, -margin), strip.at(strip.length_m + margin, margin), k_ease_m);
  flat.metres = field.height(strip.at(0.5 * strip.length_m, 0));
  sward::Bounds bounds = sward::Bounds::create(field);
  if (auto edited = sward::edit(field, bounds, flat); !edited) return tl::unexpected(edited.error());
  return {};
}

Expected<void> bake(const std::string& folder, const sward::HeightField& field, const sward::Progress& progress) {
  sward::BakeDesc desc;
  desc.world.columns = desc.world.rows = k_samples;
  desc.world.spacing = glm::dvec2(k_spacing_m);
  desc.world.floats = true;
  desc.world.root_bits = k_square_bits;
  desc.source = "flightsim strip 1";
  const auto read = [&](const sward::SampleBox& box, std::span<float> heights, std::span<uint8_t>) -> Expected<void> {
    for (int j = 0; j < box.size.y; ++j)
      for (int i = 0; i < box.size.x; ++i)
        heights[size_t(j) * size_t(box.size.x) + size_t(i)] = float(field.sample(box.first.x + i, box.first.y + j));
    return {};
  };
  if (auto baked = sward::bake_world(folder, desc, read, progress); !baked) return tl::unexpected(baked.error());
  return {};
}

// The base map with grass all over the levelled ground and a runway of bare soil.
Expected<void> paint(const std::string& path, const sward::ColorMap& map) {
  const Strip strip = bare_strip();
  std::vector<uint8_t> rgb;
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) {
      const glm::dvec2 place =
          map.min_corner + map.size * glm::dvec2((i + 0.5) / map.width, 1 - (j + 0.5) / map.height);
      const glm::dvec2 local = strip.local(place);
      const bool runway = local.x > 0 && local.x < strip.length_m && std::abs(local.y) < 0.5 * strip.width_m;
      const glm::u8vec4 texel =
          runway ? glm::u8vec4(110, 93, 67, 255) : map.texels[size_t(j) * size_t(map.width) + size_t(i)];
      rgb.insert(rgb.end(), {texel.r, texel.g, texel.b});
    }
  return sward::save_image(path, map.width, map.height, rgb);
}

}  // namespace

Expected<void> make_place(const std::string& folder, const sward::Progress& progress) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail(folder + ": cannot be made: " + error.message());
  // The scene is written last: where it is, everything is.
  const std::string scene = folder + "/strip.toml";
  if (fs::exists(scene)) return {};
  const auto part = [&progress](float from) -> sward::Progress {
    return [&progress, from](float done) {
      if (progress) progress(from + 0.5f * done);
    };
  };
  sward::GeneratorOptions options;
  options.samples = k_samples;
  options.size_m = (k_samples - 1) * k_spacing_m;
  auto made = sward::generate_meadow(options, part(0));
  if (!made) return tl::unexpected(made.error());
  if (auto level = level_ground(made->field); !level) return level;
  auto baked = bake(folder + "/world", made->field, part(0.5f));
  if (!baked) return baked;
  if (auto painted = paint(folder + "/ground.png", made->colors); !painted) return painted;
  std::ofstream file(scene);
  file << k_scene;
  file.close();
  return file ? Expected<void>{} : fail(scene + ": cannot be written");
}

Strip strip_of(const sward::Surface& ground) {
  Strip strip = bare_strip();
  strip.height_m = ground.height(strip.at(0.5 * strip.length_m, 0));
  return strip;
}

GroundBelow ground_below(const sward::Surface& ground) {
  return [&ground](glm::dvec2 xy) -> std::optional<Ground> {
    const double height = ground.height(xy);
    if (!std::isfinite(height)) return std::nullopt;
    const glm::dvec2 slope = ground.data_gradient(xy);
    return Ground{height, glm::normalize(glm::dvec3(-slope, 1))};
  };
}

}  // namespace flightsim
