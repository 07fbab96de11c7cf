// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/ground_material.h>

#include <algorithm>
#include <cmath>

#include "terrain/material_params.h"

namespace sward {

namespace {

std::string number_text(float value) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find_last_not_of('0') + 1);
}

/// Whole tiles in the period, so that the ground does not jump where it begins anew.
float tiles_of(float tile_m) {
  return float(std::max(std::round(k_ground_period_m / double(tile_m)), 1.0));
}

/// Heights a tile to metres a metre.
float slope_of_code(float relief_m, float tiles) {
  return relief_m * tiles / float(k_ground_period_m) * DetailTexture::k_steepest;
}

Expected<void> check_range(const std::string& who, const char* field, float value, float low, float high) {
  if (value >= low && value <= high) return {};
  return fail(who + ": " + field + " is " + number_text(value) + ", expected " + number_text(low) + " to " +
              number_text(high));
}

Expected<void> check_detail(const std::string& who, const std::string& name) {
  const auto known = generated_details();
  if (std::find(known.begin(), known.end(), name) != known.end()) return {};
  std::string all;
  for (const std::string_view each : known) all += (all.empty() ? "" : ", ") + std::string(each);
  return fail(who + ": there is no generated detail \"" + name + "\", expected one of " + all);
}

Expected<void> check_color(const std::string& who, const GroundMaterial& m) {
  if (!m.reference_hsv) {
    if (std::isfinite(m.max_distance)) return {};
    return fail(who + ": max_distance must be finite where there is no reference colour");
  }
  const glm::vec3 hsv = *m.reference_hsv;
  if (!(hsv.x >= 0 && hsv.x < 1 && hsv.y >= 0 && hsv.y <= 1 && hsv.z >= 0 && hsv.z <= 1))
    return fail(who + ": the reference colour's hue must be in [0, 1), its saturation and value in [0, 1]");
  for (int i = 0; i < 3; ++i)
    if (!(m.weights[i] >= 0) || !std::isfinite(m.weights[i])) return fail(who + ": weights must be >= 0 and finite");
  if (m.weights == glm::vec3(0)) return fail(who + ": weights must not all be 0");
  return {};
}

Expected<void> check(const GroundMaterial& m) {
  const std::string who = "ground material \"" + m.name + "\"";
  if (auto fits = check_color(who, m); !fits) return fits;
  if (!(m.max_distance >= 1.0e-4f)) return fail(who + ": max_distance must be at least 0.0001");
  if (!(m.exponent > 0)) return fail(who + ": exponent must be above 0");
  struct Range {
    const char* field;
    float value, low, high;
  };
  for (const Range& r : {Range{"exponent", m.exponent, 0, 8}, Range{"tile_m", m.tile_m, 0.05f, 64},
                         Range{"cliff_tile_m", m.cliff_tile_m, 0.05f, 64}, Range{"strength", m.strength, 0, 1},
                         Range{"relief_m", m.relief_m, 0, 2}, Range{"cliff_relief_m", m.cliff_relief_m, 0, 2},
                         Range{"sharpness", m.sharpness, 0, 32}})
    if (auto fits = check_range(who, r.field, r.value, r.low, r.high); !fits) return fits;
  if (!m.texture)
    if (auto known = check_detail(who, m.detail); !known) return known;
  if (!m.broad_detail.empty())
    if (auto known = check_detail(who, m.broad_detail); !known) return known;
  if (!m.cliff_texture && !m.cliff_detail.empty()) return check_detail(who, m.cliff_detail);
  return {};
}

GroundMaterial material(const char* name, glm::vec3 hsv, glm::vec3 weights, float max_distance) {
  GroundMaterial m;
  m.name = m.detail = name;
  m.reference_hsv = hsv;
  m.weights = weights;
  m.max_distance = max_distance;
  return m;
}

}  // namespace

material_glsl::MaterialParams make_material_params(const GroundMaterial& m, const MaterialLayers& layers) {
  const float tiles = tiles_of(m.tile_m), cliff_tiles = tiles_of(m.cliff_tile_m);
  // As species have it: a hair less, so that rounding cannot refuse the limit itself.
  const float least = float(0.99999 * std::pow(double(m.max_distance), -double(m.exponent)));
  material_glsl::MaterialParams p;
  p.reference = glm::vec4(m.reference_hsv.value_or(glm::vec3(0)), m.exponent);
  p.weights = glm::vec4(m.weights, least);
  p.look = {tiles, cliff_tiles, m.strength, m.sharpness};
  p.layers = {float(layers.flat), float(layers.cliff), m.reference_hsv ? 0.0f : least, 0.0f};
  p.relief = {m.strength * slope_of_code(m.relief_m, tiles), m.strength * slope_of_code(m.cliff_relief_m, cliff_tiles),
              float(layers.flat_broad), float(layers.cliff_broad)};
  return p;
}

std::string broad_detail_of(const GroundMaterial& m, bool cliff) {
  if (!m.broad_detail.empty()) return m.broad_detail;
  const bool own_cliff = cliff && (m.cliff_texture || !m.cliff_detail.empty());
  if (own_cliff ? bool(m.cliff_texture) : bool(m.texture)) return "mottle";
  const std::string& name = own_cliff ? m.cliff_detail : m.detail;
  for (const char* sized : {"grass", "gravel", "litter"})
    if (name == sized) return "mottle";
  return {};
}

Expected<void> validate(std::span<const GroundMaterial> materials) {
  if (materials.size() > size_t(k_max_materials)) {
    return fail("there are " + std::to_string(materials.size()) + " ground materials; at most " +
                std::to_string(k_max_materials) + " are allowed");
  }
  const GroundMaterial* everywhere = nullptr;
  for (const GroundMaterial& m : materials) {
    if (auto fits = check(m); !fits) return fits;
    if (m.reference_hsv) continue;
    if (everywhere != nullptr) {
      return fail("ground materials \"" + everywhere->name + "\" and \"" + m.name +
                  "\" are both everywhere; give one of them a reference colour");
    }
    everywhere = &m;
  }
  return {};
}

void material_shares(std::span<const GroundMaterial> materials, glm::vec3 srgb, std::span<float> shares) {
  SWARD_ASSERT(shares.size() == materials.size(), "material_shares: one share a material");
  const glm::vec3 hsv = material_glsl::rgb_to_hsv(srgb);
  material_glsl::BestMaterials best = material_glsl::no_materials();
  for (size_t i = 0; i < materials.size(); ++i) {
    const auto params = make_material_params(materials[i], {});
    best = material_glsl::insert_material(best, int(i), material_glsl::material_score(params, hsv));
    shares[i] = 0;
  }
  const glm::vec3 share = material_glsl::material_shares_of(best);
  if (best.first >= 0) shares[size_t(best.first)] = share.x;
  if (best.second >= 0) shares[size_t(best.second)] = share.y;
  if (best.third >= 0) shares[size_t(best.third)] = share.z;
}

std::vector<GroundMaterial> default_ground_materials() {
  std::vector<GroundMaterial> all;
  all.push_back(material("grass", {0.222f, 0.46f, 0.42f}, {3.0f, 0.8f, 0.4f}, 0.5f));
  all.push_back(material("litter", {0.075f, 0.40f, 0.27f}, {3.0f, 1.0f, 1.0f}, 0.22f));
  all.back().relief_m = 0.03f;
  all.push_back(material("gravel", {0.095f, 0.24f, 0.50f}, {2.0f, 1.2f, 0.6f}, 0.3f));
  all.push_back(material("rock", {0.1f, 0.07f, 0.45f}, {0.0f, 1.2f, 0.4f}, 0.4f));
  all.back().tile_m = 3.0f;
  all.back().relief_m = 0.15f;
  all.back().cliff_detail = "strata";
  all.push_back(material("sand", {0.12f, 0.32f, 0.78f}, {3.0f, 1.0f, 1.0f}, 0.25f));
  all.push_back(material("snow", {0.6f, 0.03f, 0.94f}, {0.0f, 1.0f, 1.0f}, 0.3f));
  all.back().tile_m = 4.0f;
  all.push_back(GroundMaterial{});
  all.back().name = "soil";
  return all;
}

}  // namespace sward
