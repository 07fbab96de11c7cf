// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/scene.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/scene_keys.h"

namespace sward {

namespace {

constexpr uintmax_t k_largest_scene = 4 << 20;
constexpr int k_most_dots = 64;

/// toml++ bounds the nesting of values (TOML_MAX_NESTED_VALUES) but not the parts of a dotted key, for each of which it
/// recurses. A key stands on one line, so dots a line bound them.
Expected<void> check_dots(std::string_view text, const std::string& name) {
  int line = 1, dots = 0;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
    } else if (c == '.' && ++dots > k_most_dots) {
      return fail(name + ":" + std::to_string(line) + ": more than " + std::to_string(k_most_dots) +
                  " dots in a line, expected TOML with keys of few parts");
    }
  }
  return {};
}

Expected<Scene> parse(std::string_view text, const std::string& name) {
  const scene_file::Context context{name};
  if (auto checked = check_dots(text, name); !checked) return tl::unexpected(checked.error());
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    // The description quotes what was read, line breaks included; messages are one line.
    std::string description(parsed.error().description());
    std::replace_if(description.begin(), description.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return context.fail_at(parsed.error().source(), "expected TOML: " + description);
  }
  Scene scene;
  if (auto read = scene_file::read_fields(parsed.table(), scene_file::scene_schema(), scene, context); !read) {
    return tl::unexpected(read.error());
  }
  for (Layer& layer : scene.layers) layer.season = scene.season;
  if (auto taken = scene_file::take_species_colors(parsed.table(), scene, context); !taken) {
    return tl::unexpected(taken.error());
  }
  return scene;
}

Expected<std::string> read_text(const std::string& path) {
  std::error_code code;
  const std::string name = "scene \"" + path + "\"";
  const auto status = std::filesystem::status(path, code);
  if (path.empty() || !std::filesystem::exists(status)) return fail(name + " does not exist or cannot be reached");
  if (!std::filesystem::is_regular_file(status)) return fail(name + " is no file, expected a scene in TOML");
  if (std::filesystem::file_size(path, code) > k_largest_scene || code) {
    return fail(name + " is larger than 4 MiB, expected a scene in TOML");
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || (stream.peek() != std::ifstream::traits_type::eof() && !(text << stream.rdbuf()))) {
    return fail(name + " cannot be read");
  }
  return text.str();
}

}  // namespace

glm::vec3 ground_tint(std::span<const GroundSeason> frames, float season) {
  // The same ease as the plants have.
  Species carrier;
  for (const GroundSeason& frame : frames) {
    carrier.seasons.push_back({frame.at, {}});
    carrier.seasons.back().values.tint = frame.tint;
  }
  return frames.empty() ? glm::vec3(1.0f) : season_values(carrier, season).tint;
}

Expected<std::vector<GroundMaterial>> ground_materials(const Scene& scene) {
  if (!scene.splatting) return std::vector<GroundMaterial>();
  if (scene.materials.empty()) return default_ground_materials();
  std::vector<GroundMaterial> all;
  for (const SceneMaterial& each : scene.materials) {
    const GroundMaterial& m = each.material;
    const bool missing = (!each.detail_file.empty() && !m.texture) || (!each.cliff_file.empty() && !m.cliff_texture);
    if (missing) return fail(each.where + ": the images of material \"" + m.name + "\" are not loaded; load them");
    all.push_back(m);
  }
  const bool covered = std::any_of(all.begin(), all.end(), [](const GroundMaterial& m) { return !m.reference_hsv; });
  if (!covered && all.size() < size_t(k_max_materials)) {
    all.emplace_back();
    all.back().name = "soil";
  }
  return all;
}

std::string Scene::resolve(const std::string& path) const {
  const std::filesystem::path given(path);
  if (directory.empty() || path.empty() || given.is_absolute()) return path;
  return (std::filesystem::path(directory) / given).lexically_normal().string();
}

Expected<Scene> parse_scene(std::string_view text, const std::string& name) {
  try {
    return parse(text, name);
  } catch (const std::exception& error) {
    return fail(name + ":1: cannot be read: " + error.what());
  }
}

Expected<Scene> load_scene(const std::string& path) {
  try {
    const auto text = read_text(path);
    if (!text) return tl::unexpected(text.error());
    auto scene = parse_scene(*text, path);
    if (scene) scene->directory = std::filesystem::path(path).parent_path().string();
    return scene;
  } catch (const std::exception& error) {
    return fail("scene \"" + path + "\" cannot be read: " + error.what());
  }
}

Expected<Scene> builtin_scene(std::string_view name) {
  std::string known;
  for (const EmbeddedText& scene : embedded_scenes()) {
    const std::string_view stem = scene.name.substr(0, scene.name.rfind('.'));
    if (stem == name) return parse_scene(scene.text, std::string(scene.name));
    known += (known.empty() ? "\"" : ", \"") + std::string(stem) + "\"";
  }
  return fail("there is no built-in scene \"" + std::string(name) + "\", expected one of " + known);
}

}  // namespace sward
