// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/layer_params.h"

#include <algorithm>
#include <cmath>

#include "vegetation/plant_mesh.h"

namespace sward {

namespace {

/// Reference colours move in steps: between two of them plants are chosen by both (common_placement.glsl).
constexpr double k_season_steps = 24;

struct SeasonStep {
  float now, next, way;
};
SeasonStep season_step(float season) {
  const double place = (double(season) - std::floor(double(season))) * k_season_steps;
  const double step = std::floor(place);
  return {float(step / k_season_steps), float((step + 1) / k_season_steps), float(place - step)};
}

bool references_move(const Layer& layer, const SeasonStep& step) {
  return std::any_of(layer.species.begin(), layer.species.end(), [&](const Species& s) {
    return season_values(s, step.now).reference_hsv != season_values(s, step.next).reference_hsv;
  });
}

float mask_number(const std::vector<const GrayMap*>& masks, const GrayMap* mask) {
  const auto found = std::find(masks.begin(), masks.end(), mask);
  return found == masks.end() ? 0.0f : float(found - masks.begin() + 1);
}

}  // namespace

MapGeometry classification_map(const Layer& layer, const MapGeometry& base) {
  return layer.distribution ? MapGeometry{base.size, {layer.distribution->width, layer.distribution->height}} : base;
}

std::vector<const GrayMap*> masks_of(const Layer& layer) {
  std::vector<const GrayMap*> masks;
  const auto add = [&](const GrayMap* mask) {
    if (mask != nullptr && mask_number(masks, mask) == 0.0f) masks.push_back(mask);
  };
  add(layer.mask.get());
  for (const Species& species : layer.species) add(species.mask.get());
  if (layer.height_map) masks.push_back(layer.height_map.get());
  return masks;
}

glm::vec4 mask_header(const Layer& layer, size_t i, const MapGeometry& map) {
  const std::vector<const GrayMap*> masks = masks_of(layer);
  if (layer.height_map && i + 1 == masks.size()) {
    const glm::dvec2 tiles = map.size / (glm::dvec2(map.texels) * double(layer.height_tile_m));
    return {glm::vec2(tiles), layer.height_least, 0.0f};
  }
  return {glm::vec2(glm::dvec2(masks[i]->width, masks[i]->height) / glm::dvec2(map.texels)), 0.0f, 0.0f};
}

shared::LayerParams make_layer_params(const Layer& layer, const View& view, const MapGeometry& map, float sun_azimuth) {
  const float zoom = float(view.zoom());
  const glm::dvec2 texels_per_m = glm::dvec2(map.texels) / map.size;
  shared::LayerParams params;
  params.law = {float(layer.law), layer.density, layer.full_distance_m * zoom, layer.falloff};
  params.reach = {layer.horizon_m * zoom, float(layer.cluster_size), layer.plain ? 1.0f : 0.0f,
                  float(layer.species.size())};
  params.map = {float(texels_per_m.x), float(-texels_per_m.y), float(map.texels.x), float(map.texels.y)};
  params.detail = {layer.full_segments_m * zoom, layer.shadow_distance_m * zoom, float(layer.ceiling), sun_azimuth};
  const SeasonStep step = season_step(layer.season);
  params.place = {mask_number(masks_of(layer), layer.mask.get()), step.way, references_move(layer, step) ? 1.0f : 0.0f,
                  layer.height_map ? float(masks_of(layer).size()) : 0.0f};
  return params;
}

namespace {

/// Least score of a species: distance^-p falls with distance; a hair less, so that rounding cannot refuse the limit
/// itself. Infinitely far is score 0, which every score passes but which is no score: nothing competes with 0.
float least_score(const Species& species) {
  return float(0.99999 * std::pow(double(species.max_distance), -double(species.exponent)));
}

/// Three bytes as one whole number, exact in a float: red * 65536 + green * 256 + blue.
float pack_color(glm::vec3 srgb) {
  const glm::vec3 bytes = glm::round(srgb * 255.0f);
  return bytes.x * 65536.0f + bytes.y * 256.0f + bytes.z;
}

void set_flower(const FlowerShape& flower, shared::SpeciesParams& params) {
  const size_t colors = flower.petal_colors.size();
  float total = 0.0f;
  for (const float share : flower.petal_shares) total += share;
  float sum = 0.0f;
  glm::vec4 cumulative(1.0f);
  for (size_t i = 0; i < colors; ++i) {
    params.own_a[int(i)] = pack_color(flower.petal_colors[i]);
    sum += flower.petal_shares.empty() ? 1.0f / float(colors) : flower.petal_shares[i] / total;
    // Rounding must not leave a rest to a colour that is not there.
    cumulative[int(i)] = i + 1 == colors ? 1.0f : sum;
  }
  params.own_b = {cumulative.x, cumulative.y, cumulative.z, flower.cup};
  params.own_c = {flower.head_m.min, flower.head_m.max, float(flower.petals), flower.centre_share};
  params.own_d = {pack_color(flower.centre_color), flower.own_stem ? pack_color(flower.stem_color) : -1.0f,
                  float(flower.leaves), flower.petal_width};
}

/// Layouts: shaders/common_kinds.glsl.
void set_own(const Species& s, shared::SpeciesParams& params) {
  params.own_a = params.own_b = params.own_c = params.own_d = glm::vec4(0.0f);
  if (s.kind == PlantKind::tuft) {
    params.own_a = {float(s.tuft.blades.min), float(s.tuft.blades.max), s.tuft.spread, 0.0f};
  } else if (s.kind == PlantKind::leaf || s.kind == PlantKind::fern) {
    params.own_a = {float(s.leaves), 0.0f, 0.0f, 0.0f};
  } else if (s.kind == PlantKind::billboard) {
    params.own_a = {s.trunk_share, s.taper, 0.0f, 0.0f};
  } else if (s.kind == PlantKind::mesh) {
    params.own_a = {float(face_count(s.mesh)), 0.0f, 0.0f, 0.0f};
  } else if (s.kind == PlantKind::flower) {
    set_flower(s.flower, params);
  } else if (s.kind == PlantKind::custom) {
    glm::vec4* const rows[] = {&params.own_a, &params.own_b, &params.own_c, &params.own_d};
    for (size_t i = 0; i < s.custom.parameters.size(); ++i) (*rows[i / 4])[int(i % 4)] = s.custom.parameters[i];
  }
}

/// Bounds that shaders can compute with, beyond all altitudes and slopes.
constexpr float k_no_bound = 2.0e30f, k_no_altitude_bound = 1.0e29f;

/// Altitudes that do not exist (-1e30, triangle_record.cpp) lie outside of every rule's range.
glm::vec4 altitude_rule(const Species& s, float water_level) {
  const bool rule = s.altitude_m.min > -k_unbounded || s.altitude_m.max < k_unbounded;
  const float least = rule ? std::max(s.altitude_m.min, -k_no_altitude_bound) : -k_no_bound;
  const float shore = s.above_water_m > -k_unbounded ? water_level + s.above_water_m : -k_no_bound;
  return {least, std::min(s.altitude_m.max, k_no_bound), s.altitude_soft_m, shore};
}

shared::SpeciesParams make_params(const Species& base, const Layer& layer, const std::vector<const GrayMap*>& masks) {
  const SeasonValues season = season_values(base, layer.season);
  const SeasonStep step = season_step(layer.season);
  Species s = base;
  s.reference_hsv = season_values(base, step.now).reference_hsv;
  s.tint = season.tint;
  s.age_tint = season.age_tint;
  s.age_share = season.age_share;
  s.height_m = {base.height_m.min * season.height, base.height_m.max * season.height};
  shared::SpeciesParams params;
  params.reference = {s.reference_hsv, s.exponent};
  params.weights = {s.weights, least_score(s)};
  params.size = {s.height_m.min, s.height_m.max, s.width_m.min, s.width_m.max};
  params.posture = {s.stiffness.min, s.stiffness.max, s.lean, s.phototropism};
  params.tint = {s.tint, s.age_share};
  params.age_tint = {s.age_tint, s.root_shade};
  params.optics = {s.translucency, s.attenuation, s.specular, s.shininess};
  params.kind = {s.kind == PlantKind::none ? 0.0f : 1.0f, s.forbids ? 1.0f : 0.0f, float(s.max_segments), 0.0f};
  if (s.kind != PlantKind::none) params.kind.y = resistance_of(base) - 1.0f;
  set_own(s, params);
  params.altitude = altitude_rule(s, layer.water_level_m);
  params.slope = {s.slope.min, std::min(s.slope.max, k_no_bound), s.slope_soft, mask_number(masks, s.mask.get())};
  params.next = {season_values(base, step.next).reference_hsv, season.density};
  return params;
}

}  // namespace

std::vector<shared::SpeciesParams> make_species_params(const Layer& layer) {
  std::vector<shared::SpeciesParams> params;
  params.reserve(layer.species.size());
  const std::vector<const GrayMap*> masks = masks_of(layer);
  for (const Species& species : layer.species) params.push_back(make_params(species, layer, masks));
  return params;
}

}  // namespace sward
