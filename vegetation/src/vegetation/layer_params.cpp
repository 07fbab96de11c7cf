// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/layer_params.h"

#include <cmath>

namespace sward {

shared::LayerParams make_layer_params(const Layer& layer, const View& view, const MapGeometry& map, float sun_azimuth) {
  const float zoom = float(view.zoom());
  const glm::dvec2 texels_per_m = glm::dvec2(map.texels) / map.size;
  shared::LayerParams params;
  params.law = {float(layer.law), layer.density, layer.full_distance_m * zoom, layer.falloff};
  params.reach = {layer.horizon_m * zoom, float(layer.cluster_size), layer.plain ? 1.0f : 0.0f,
                  float(layer.species.size())};
  params.map = {float(texels_per_m.x), float(-texels_per_m.y), float(map.texels.x), float(map.texels.y)};
  params.detail = {layer.full_segments_m * zoom, layer.shadow_distance_m * zoom, float(layer.ceiling), sun_azimuth};
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
  } else if (s.kind == PlantKind::flower) {
    set_flower(s.flower, params);
  } else if (s.kind == PlantKind::custom) {
    glm::vec4* const rows[] = {&params.own_a, &params.own_b, &params.own_c, &params.own_d};
    for (size_t i = 0; i < s.custom.parameters.size(); ++i) (*rows[i / 4])[int(i % 4)] = s.custom.parameters[i];
  }
}

shared::SpeciesParams make_params(const Species& s) {
  shared::SpeciesParams params;
  params.reference = {s.reference_hsv, s.exponent};
  params.weights = {s.weights, least_score(s)};
  params.size = {s.height_m.min, s.height_m.max, s.width_m.min, s.width_m.max};
  params.posture = {s.stiffness.min, s.stiffness.max, s.lean, s.phototropism};
  params.tint = {s.tint, s.age_share};
  params.age_tint = {s.age_tint, s.root_shade};
  params.optics = {s.translucency, s.attenuation, s.specular, s.shininess};
  params.kind = {s.kind == PlantKind::none ? 0.0f : 1.0f, s.forbids ? 1.0f : 0.0f, float(s.max_segments), 0.0f};
  set_own(s, params);
  return params;
}

}  // namespace

std::vector<shared::SpeciesParams> make_species_params(const Layer& layer) {
  std::vector<shared::SpeciesParams> params;
  params.reserve(layer.species.size());
  for (const Species& species : layer.species) params.push_back(make_params(species));
  return params;
}

}  // namespace sward
