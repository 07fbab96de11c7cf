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
  params.habit = {s.trunk_share, s.taper, float(s.leaves), 0.0f};
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
