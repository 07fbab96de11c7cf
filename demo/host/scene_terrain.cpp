// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_terrain.h"

#include <sward/scene/generated_terrain.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

#ifdef SWARD_IMAGE_IO
#include <sward/image_io/image_io.h>
#endif

namespace sward::host {

namespace {

constexpr int k_painted_texels = 1024, k_most_painted_texels = 2048;

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

Expected<ColorMap> load_colors(const Scene& scene, const Lattice& lattice) {
#ifdef SWARD_IMAGE_IO
  const glm::dvec2 low = lattice.min_corner();
  return load_color_map(scene.resolve(scene.texture_path), low, lattice.max_corner() - low);
#else
  (void)lattice;
  return fail(scene.texture_path + ": this build reads no colour maps; configure it with SWARD_IMAGE_IO=ON");
#endif
}

// -0.5..0.5, for the edges of zones.
double jitter(int column, int row) {
  uint32_t h = uint32_t(column) * 0x9E3779B1u ^ uint32_t(row) * 0x85EBCA77u;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  return double((h ^ h >> 13) & 0xffff) / 65536 - 0.5;
}

struct Paint {
  glm::dvec3 color{0};  // sRGB, 0..255
  bool plants = true;
};

Paint paint_by_slope(double slope) {
  const glm::dvec3 grass(88, 104, 46), soil(112, 92, 66), rock(120, 116, 110);
  return {glm::mix(glm::mix(grass, soil, glm::smoothstep(0.35, 0.6, slope)), rock, glm::smoothstep(0.6, 0.9, slope))};
}

// Heights of zones as at 45 degrees of latitude. Only what is level and not above the sea is water.
Paint paint_by_height(double slope, double height, double fray) {
  const glm::dvec3 water(46, 72, 88), wood(68, 86, 42), dry(126, 118, 76), rock(118, 114, 108), snow(232, 236, 240);
  if (height <= 0 && slope < 1e-3) return {water, false};
  const double z = height + 120 * fray;
  glm::dvec3 color = paint_by_slope(0.8 * slope + 0.05 * fray).color;
  const double steep = glm::smoothstep(0.35, 0.8, slope);
  color = glm::mix(color, wood, (1 - steep) * glm::smoothstep(250.0, 700.0, z));
  color = glm::mix(color, dry, (1 - steep) * glm::smoothstep(1400.0, 1900.0, z));
  color = glm::mix(color, rock, glm::smoothstep(1800.0, 2400.0, z));
  color = glm::mix(color, snow, (1 - glm::smoothstep(0.8, 1.4, slope)) * glm::smoothstep(2150.0, 2750.0, z));
  return {color * (1 + 0.06 * fray)};
}

// paint_at(x, y, column, row) for every texel.
template <class PaintAt>
ColorMap paint_map(const Lattice& lattice, glm::ivec2 texels, PaintAt&& paint_at) {
  ColorMap map;
  map.width = texels.x;
  map.height = texels.y;
  map.min_corner = lattice.min_corner();
  map.size = lattice.max_corner() - map.min_corner;
  map.texels.reserve(size_t(map.width) * size_t(map.height));
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const glm::dvec2 at((column + 0.5) / map.width, 1 - (row + 0.5) / map.height);
      const Paint paint = paint_at(map.min_corner + at * map.size, column, row);
      map.texels.emplace_back(glm::u8vec3(glm::clamp(paint.color + 0.5, 0.0, 255.0)), paint.plants ? 255 : 0);
    }
  map.bounds = bound_colors(map);
  return map;
}

// The base map of a height map that comes without one: green where it is flat, soil and rock as it gets steeper.
ColorMap paint_field(const HeightField& field) {
  return paint_map(field.lattice(), glm::ivec2(k_painted_texels),
                   [&field](glm::dvec2 at, int, int) { return paint_by_slope(glm::length(field.data_gradient(at))); });
}

// By slope and height of what is resident.
ColorMap paint_world(const World& world, glm::ivec2 texels) {
  return paint_map(world.lattice(), texels, [&world](glm::dvec2 at, int column, int row) {
    return paint_by_height(glm::length(world.data_gradient(at)), world.height(at), jitter(column, row));
  });
}

glm::dvec2 camera_xy(const Scene& scene, const SceneTerrain& terrain) {
  const Lattice& lattice = terrain.surface().lattice();
  return glm::dvec2(scene.camera) + (scene.camera_from_middle ? glm::dvec2(lattice.origin) : glm::dvec2(0));
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
  auto colors = load_colors(scene, ground.field.lattice());
  if (!colors) return tl::unexpected(colors.error());
  ground.colors = std::move(*colors);
  return ground;
}

Expected<Ground> load_ground(const Scene& scene, const ReliefOptions& relief) {
  auto field = load_heights(scene, relief);
  if (!field) return tl::unexpected(field.error());
  auto colors =
      scene.texture_path.empty() ? Expected<ColorMap>(paint_field(*field)) : load_colors(scene, field->lattice());
  if (!colors) return tl::unexpected(colors.error());
#ifdef SWARD_IMAGE_IO
  mask_holes(*colors, *field);
#endif
  return Ground{std::move(*field), std::move(*colors)};
}

Expected<void> check_camera(const Scene& scene, const SceneTerrain& terrain) {
  const glm::dvec3 camera = scene.camera;
  if (!std::isfinite(camera.x) || !std::isfinite(camera.y) || !std::isfinite(camera.z) ||
      !std::isfinite(scene.camera_yaw) || !std::isfinite(scene.camera_pitch))
    return fail("the camera's position and angles must be finite numbers");
  if (!scene.camera_above_ground || std::isfinite(terrain.surface().height(camera_xy(scene, terrain)))) return {};
  const auto range = [](double low, double high) {
    return std::to_string(std::lround(low)) + " to " + std::to_string(std::lround(high));
  };
  const Lattice& lattice = terrain.surface().lattice();
  const glm::dvec2 low = lattice.min_corner(), high = lattice.max_corner();
  return fail("the camera stands above no ground; the terrain spans x " + range(low.x, high.x) + ", y " +
              range(low.y, high.y) + " metres");
}

Expected<std::unique_ptr<SceneTerrain>> open_world(const Scene& scene) {
  WorldOptions options;
  options.memory_bytes = size_t(scene.world_memory_mb * (1 << 20));
  options.worth_px = scene.world_worth_px;
  auto world = World::open(scene.resolve(scene.world_path), options);
  if (!world) return tl::unexpected(world.error());
  // Nothing is resident yet: what is painted is the coarse data.
  const WorldDesc& desc = (*world)->desc();
  const glm::ivec2 coarse = desc.squares() << desc.coarse_bits;
  const glm::ivec2 texels = glm::clamp(coarse, glm::ivec2(k_painted_texels), glm::ivec2(k_most_painted_texels));
  auto colors = scene.texture_path.empty() ? Expected<ColorMap>(paint_world(**world, texels))
                                           : load_colors(scene, (*world)->lattice());
  if (!colors) return tl::unexpected(colors.error());
  return std::make_unique<SceneTerrain>(std::move(*world), std::move(*colors));
}

Expected<std::unique_ptr<SceneTerrain>> make_field(const Scene& scene, bool detail, const Progress& progress) {
  ReliefOptions relief = scene.relief;
  relief.enabled = relief.enabled && detail;
  auto ground = scene.height_path.empty() ? generate_ground(scene, relief, share_of(progress, 0, 0.7f))
                                          : load_ground(scene, relief);
  if (!ground) return tl::unexpected(ground.error());
  return std::make_unique<SceneTerrain>(std::move(ground->field), std::move(ground->colors),
                                        share_of(progress, 0.7f, 1));
}

}  // namespace

SceneTerrain::SceneTerrain(HeightField field, ColorMap colors, const Progress& progress)
    : field_(new Field{std::move(field), Bounds()}), colors_(std::move(colors)) {
  field_->bounds = Bounds::create(field_->field, 0, progress);
  field_surface_ = std::make_unique<FieldSurface>(field_->bounds);
  surface_ = field_surface_.get();
}

SceneTerrain::SceneTerrain(std::unique_ptr<World> world, ColorMap colors)
    : world_(std::move(world)), surface_(world_.get()), colors_(std::move(colors)) {}

std::shared_ptr<const MeshSurface> SceneTerrain::mesh_of(const std::string& layer) const {
  const auto found = surfaces_.by_layer.find(layer);
  return found == surfaces_.by_layer.end() ? nullptr : found->second;
}

Expected<void> SceneTerrain::add_surfaces(const Scene& scene) {
  auto built = build_surfaces(scene, surface());
  if (!built) return tl::unexpected(built.error());
  surfaces_ = std::move(*built);
  return {};
}

Expected<gl::GroundTextures> SceneTerrain::make_textures() const {
  return field_ ? gl::GroundTextures::create(field_->field, colors_) : gl::GroundTextures::create(*surface_, colors_);
}

Expected<std::unique_ptr<SceneTerrain>> load_terrain(const Scene& scene, bool detail, const Progress& progress) {
  auto terrain = scene.world_path.empty() ? make_field(scene, detail, progress) : open_world(scene);
  if (!terrain) return terrain;
  if (auto checked = check_camera(scene, **terrain); !checked) return tl::unexpected(checked.error());
  if (auto added = (*terrain)->add_surfaces(scene); !added) return tl::unexpected(added.error());
  return terrain;
}

double far_plane_m(const Surface& surface) {
  const Lattice& lattice = surface.lattice();
  const glm::dvec2 heights = surface.height_range();
  return 1000 + 2 * (glm::length(lattice.max_corner() - lattice.min_corner()) + heights.y - heights.x);
}

View scene_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport) {
  glm::dvec3 eye(camera_xy(scene, terrain), scene.camera.z);
  if (scene.camera_above_ground) eye.z += terrain.surface().height(glm::dvec2(eye));
  return View::look(eye, scene.camera_yaw, scene.camera_pitch, scene.fov_y, viewport, k_near_plane_m,
                    far_plane_m(terrain.surface()));
}

}  // namespace sward::host
