// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/generated_terrain.h>

#include <cmath>
#include <string>

#include "scene/generated_paint.h"
#include "scene/generated_relief.h"

namespace sward {

namespace {

constexpr int k_min_samples = 65, k_max_samples = 8193;
constexpr int k_min_texels = 64, k_max_texels = 8192;
constexpr double k_min_size = 64, k_max_size = 1.0e6;

std::string range_text(const std::string& low, const std::string& high) {
  return "; give " + low + " to " + high;
}

Expected<void> validate(const GeneratorOptions& options) {
  if (options.samples < k_min_samples || options.samples > k_max_samples)
    return fail("generated terrain: " + std::to_string(options.samples) + " samples a side" +
                range_text(std::to_string(k_min_samples), std::to_string(k_max_samples)));
  if (options.map_texels < k_min_texels || options.map_texels > k_max_texels)
    return fail("generated terrain: " + std::to_string(options.map_texels) + " base map texels a side" +
                range_text(std::to_string(k_min_texels), std::to_string(k_max_texels)));
  // Written so that NaN fails too.
  if (!(options.size_m >= k_min_size && options.size_m <= k_max_size))
    return fail("generated terrain: a size of " + std::to_string(options.size_m) + " m" + range_text("64", "1000000"));
  return {};
}

// Part of the whole that a stage takes, as a progress of its own.
Progress part_of(const Progress& progress, float from, float to) {
  if (!progress) return {};
  return [&progress, from, to](float done) { progress(from + (to - from) * done); };
}

ColorMap color_map(generated::Paint paint, int texels, double size) {
  ColorMap map;
  map.width = map.height = texels;
  map.texels = std::move(paint.texels);
  map.min_corner = glm::dvec2(-0.5 * size);
  map.size = glm::dvec2(size);
  map.bounds = bound_colors(map);
  return map;
}

}  // namespace

Expected<GeneratedTerrain> generate_meadow(const GeneratorOptions& options, const Progress& progress) {
  if (auto valid = validate(options); !valid) return tl::unexpected<Error>(valid.error());
  const generated::Relief relief = generated::make_relief(options.seed, part_of(progress, 0.0f, 0.5f));
  generated::Grid surface = generated::sample_surface(relief, options.samples, options.seed, 0);
  generated::Paint paint =
      generated::paint_ground(relief, surface, options.map_texels, options.seed, 0, part_of(progress, 0.55f, 1.0f));
  HeightFieldDesc desc;
  desc.columns = desc.rows = options.samples;
  desc.spacing = glm::dvec2(options.size_m / (options.samples - 1));
  // Everything keeps its shape at another size: heights grow with the width.
  desc.scale = options.size_m / generated::k_width;
  desc.relief = options.relief;
  auto field = HeightField::create(desc, std::move(surface.values));
  if (!field) return tl::unexpected<Error>(field.error());
  if (progress) progress(1);
  return GeneratedTerrain{std::move(*field), color_map(std::move(paint), options.map_texels, options.size_m)};
}

}  // namespace sward
