// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/generated_terrain.h>
#include <algorithm>
#include <cmath>

#include "host/scene_renderer.h"

#ifdef SWARD_IMAGE_IO
#include <sward/image_io/image_io.h>
#endif

namespace sward::host {

namespace {

constexpr int k_painted_texels = 1024;

Progress share_of(const Progress& progress, float begin, float end) {
  if (!progress) return {};
  return [progress, begin, end](float done) { progress(begin + (end - begin) * done); };
}

Expected<HeightField> load_heights(const Scene& scene, const ReliefOptions& relief) {
#ifdef SWARD_IMAGE_IO
  HeightImport import;
  import.path = scene.resolve(scene.height_path);
  import.spacing = scene.spacing;
  import.scale = scene.height_scale;
  import.offset = scene.height_offset;
  if (scene.has_no_data) import.no_data = scene.no_data;
  import.origin = scene.origin;
  import.relief = relief;
  return load_height_field(import);
#else
  (void)relief;
  return fail(scene.height_path + ": this build reads no height maps; configure it with SWARD_IMAGE_IO=ON");
#endif
}

Expected<ColorMap> load_colors(const Scene& scene, const HeightField& field) {
#ifdef SWARD_IMAGE_IO
  return load_color_map(scene.resolve(scene.texture_path), field.min_corner(), field.max_corner() - field.min_corner());
#else
  (void)field;
  return fail(scene.texture_path + ": this build reads no colour maps; configure it with SWARD_IMAGE_IO=ON");
#endif
}

// The base map of a height map that comes without one: green where it is flat, soil and rock as it gets steeper.
ColorMap paint_by_slope(const HeightField& field) {
  const glm::dvec3 grass(88, 104, 46), soil(112, 92, 66), rock(120, 116, 110);
  ColorMap map;
  map.width = map.height = k_painted_texels;
  map.min_corner = field.min_corner();
  map.size = field.max_corner() - field.min_corner();
  map.texels.reserve(size_t(map.width) * size_t(map.height));
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const glm::dvec2 at((column + 0.5) / map.width, 1 - (row + 0.5) / map.height);
      const double slope = glm::length(field.data_gradient(map.min_corner + at * map.size));
      const glm::dvec3 color =
          glm::mix(glm::mix(grass, soil, glm::smoothstep(0.35, 0.6, slope)), rock, glm::smoothstep(0.6, 0.9, slope));
      map.texels.emplace_back(glm::u8vec3(color + 0.5), 255);
    }
  return map;
}

struct Ground {
  HeightField field;
  ColorMap colors;
};

Expected<Ground> generate_ground(const Scene& scene, const ReliefOptions& relief, const Progress& progress) {
  GeneratorOptions options;
  options.seed = scene.generator_seed;
  options.samples = scene.generator_samples;
  options.size_m = scene.generator_size_m;
  options.relief = relief;
  auto generated = generate_meadow(options, progress);
  if (!generated) return tl::unexpected(generated.error());
  Ground ground{std::move(generated->field), std::move(generated->colors)};
  if (scene.texture_path.empty()) return ground;
  auto colors = load_colors(scene, ground.field);
  if (!colors) return tl::unexpected(colors.error());
  ground.colors = std::move(*colors);
  return ground;
}

Expected<Ground> load_ground(const Scene& scene, const ReliefOptions& relief) {
  auto field = load_heights(scene, relief);
  if (!field) return tl::unexpected(field.error());
  auto colors = scene.texture_path.empty() ? Expected<ColorMap>(paint_by_slope(*field)) : load_colors(scene, *field);
  if (!colors) return tl::unexpected(colors.error());
#ifdef SWARD_IMAGE_IO
  mask_holes(*colors, *field);
#endif
  return Ground{std::move(*field), std::move(*colors)};
}

Expected<void> check_camera(const Scene& scene, const HeightField& field) {
  const glm::dvec3 camera = scene.camera;
  if (!std::isfinite(camera.x) || !std::isfinite(camera.y) || !std::isfinite(camera.z) ||
      !std::isfinite(scene.camera_yaw) || !std::isfinite(scene.camera_pitch))
    return fail("the camera's position and angles must be finite numbers");
  if (!scene.camera_above_ground || std::isfinite(field.height(glm::dvec2(camera)))) return {};
  const auto range = [](double low, double high) {
    return std::to_string(std::lround(low)) + " to " + std::to_string(std::lround(high));
  };
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  return fail("the camera stands above no ground; the terrain spans x " + range(low.x, high.x) + ", y " +
              range(low.y, high.y) + " metres");
}

}  // namespace

Expected<std::unique_ptr<SceneTerrain>> load_terrain(const Scene& scene, bool detail, const Progress& progress) {
  ReliefOptions relief = scene.relief;
  relief.enabled = relief.enabled && detail;
  auto ground = scene.height_path.empty() ? generate_ground(scene, relief, share_of(progress, 0, 0.7f))
                                          : load_ground(scene, relief);
  if (!ground) return tl::unexpected(ground.error());
  if (auto checked = check_camera(scene, ground->field); !checked) return tl::unexpected(checked.error());
  std::unique_ptr<SceneTerrain> terrain(
      new SceneTerrain{std::move(ground->field), Bounds(), std::move(ground->colors)});
  terrain->bounds = Bounds::create(terrain->field, 0, share_of(progress, 0.7f, 1));
  return terrain;
}

double far_plane_m(const HeightField& field) {
  const glm::dvec2 extent = field.max_corner() - field.min_corner();
  const glm::dvec2 heights = field.height_range();
  return 1000 + 2 * (glm::length(extent) + heights.y - heights.x);
}

View scene_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport) {
  glm::dvec3 eye = scene.camera;
  if (scene.camera_above_ground) eye.z += terrain.field.height(glm::dvec2(eye));
  return View::look(eye, scene.camera_yaw, scene.camera_pitch, scene.fov_y, viewport, k_near_plane_m,
                    far_plane_m(terrain.field));
}

}  // namespace sward::host
