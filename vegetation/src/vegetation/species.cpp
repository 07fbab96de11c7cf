// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/species.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include "vegetation/plant_mesh.h"

namespace sward {

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
/// Colour distances are never less (CONTRACT, Classification); with the largest exponent the best score stays finite.
constexpr float k_least_distance = 1.0e-4f;
constexpr float k_largest_exponent = 8.0f;
constexpr float k_largest_weight = 100.0f;
/// Seeds a triangle: ranks stay exact in a float and below the clusters' index space.
constexpr float k_most_seeds = 1048576.0f;

/// Collects the first field that is out of range; the rest is then skipped.
class Check {
 public:
  explicit Check(std::string owner) : owner_(std::move(owner)) {}

  /// `value` must lie within [low, high]; NaN never does.
  void within(const char* field, float value, float low, float high) {
    if (!(value >= low && value <= high)) report(field, value, low, high, '[');
  }
  void above(const char* field, float value, float low, float high) {
    if (!(value > low && value <= high)) report(field, value, low, high, '(');
  }
  void finite_above(const char* field, float value, float low) {
    above(field, value, low, std::numeric_limits<float>::max());
  }
  void finite_from(const char* field, float value, float low) {
    within(field, value, low, std::numeric_limits<float>::max());
  }
  void range(const char* field, FloatRange value, float low, float high) {
    within((std::string(field) + ".min").c_str(), value.min, low, high);
    within((std::string(field) + ".max").c_str(), value.max, low, high);
    if (value.max < value.min) refuse(std::string(field) + ".max is less than " + field + ".min");
  }
  void components(const char* field, glm::vec3 value, float low, float high) {
    for (int i = 0; i < 3; ++i)
      within((std::string(field) + "[" + std::to_string(i) + "]").c_str(), value[i], low, high);
  }
  void require(bool condition, const std::string& message) {
    if (!condition) refuse(message);
  }

  Expected<void> result() const { return message_.empty() ? Expected<void>{} : Expected<void>{fail(message_)}; }

 private:
  void report(const char* field, float value, float low, float high, char bracket) {
    std::ostringstream text;
    text << field << " is " << value << " but must lie in " << bracket << low;
    if (high >= std::numeric_limits<float>::max())
      text << ", infinity" << (high < k_infinity ? ")" : "]");
    else
      text << ", " << high << "]";
    refuse(text.str());
  }
  void refuse(const std::string& message) {
    if (message_.empty()) message_ = owner_ + ": " + message;
  }

  std::string owner_, message_;
};

void check_classification(const Species& species, Check& check) {
  check.require(species.kind <= PlantKind::mesh, "kind is none that is known");
  check.within("reference_hsv[0]", species.reference_hsv.x, 0.0f, std::nextafter(1.0f, 0.0f));
  check.within("reference_hsv[1]", species.reference_hsv.y, 0.0f, 1.0f);
  check.within("reference_hsv[2]", species.reference_hsv.z, 0.0f, 1.0f);
  check.components("weights", species.weights, 0.0f, k_largest_weight);
  check.require(species.weights != glm::vec3(0.0f), "weights are all 0; at least one must be more");
  check.above("exponent", species.exponent, 0.0f, k_largest_exponent);
  check.within("max_distance", species.max_distance, k_least_distance, k_infinity);
  check.require(!species.forbids || species.kind == PlantKind::none, "forbids is set, which only kind none may");
}

void check_growth(const Species& species, Check& check) {
  constexpr float k_half_pi = 1.5707964f;
  constexpr float k_most = 1.0e4f;
  check.range("height_m", species.height_m, 1.0e-3f, 200.0f);
  check.range("width_m", species.width_m, 1.0e-5f, 200.0f);
  check.range("stiffness", species.stiffness, 0.0f, 1.0f);
  check.within("lean", species.lean, 0.0f, k_half_pi);
  check.within("phototropism", species.phototropism, 0.0f, 1.0f);
  check.within("max_segments", float(species.max_segments), 1.0f, 64.0f);
  check.components("tint", species.tint, 0.0f, k_most);
  check.components("age_tint", species.age_tint, 0.0f, k_most);
  check.within("age_share", species.age_share, 0.0f, 1.0f);
  check.within("root_shade", species.root_shade, 0.0f, 1.0f);
  check.within("translucency", species.translucency, 0.0f, k_most);
  check.within("attenuation", species.attenuation, 0.0f, k_most);
  check.within("specular", species.specular, 0.0f, k_most);
  check.within("shininess", species.shininess, 1.0f, k_most);
  check.within("leaves", float(species.leaves), 1.0f, 8.0f);
  check.within("trunk_share", species.trunk_share, 0.0f, 0.9f);
  check.within("taper", species.taper, 0.0f, 1.0f);
  check.within("resistance", species.resistance.value_or(0.0f), 0.0f, 1.0f);
}

bool has_outline(PlantKind kind) {
  return kind == PlantKind::blade || kind == PlantKind::tuft || kind == PlantKind::leaf || kind == PlantKind::fern ||
         kind == PlantKind::billboard;
}

void check_images(const Species& species, Check& check) {
  check.within("detail_strength", species.detail_strength, 0.0f, 1.0f);
  check.within("detail_repeat", species.detail_repeat, 0.1f, 100.0f);
  check.require(!species.detail || (species.kind != PlantKind::none && species.kind != PlantKind::gravel),
                "detail is set, which kinds none and gravel do not have");
  check.require(!species.cutout || has_outline(species.kind),
                "cutout is set, which only kinds blade, tuft, leaf, fern and billboard have");
}

void check_tuft(const TuftShape& tuft, Check& check) {
  check.within("tuft.blades.min", float(tuft.blades.min), 1.0f, 9.0f);
  check.within("tuft.blades.max", float(tuft.blades.max), 1.0f, 9.0f);
  check.require(tuft.blades.max >= tuft.blades.min, "tuft.blades.max is less than tuft.blades.min");
  check.within("tuft.spread", tuft.spread, 0.0f, 1.5707964f);
}

void check_petal_colors(const FlowerShape& flower, Check& check) {
  const size_t colors = flower.petal_colors.size();
  check.require(colors >= 1 && colors <= size_t(k_most_petal_colors),
                "flower.petal_colors: there are " + std::to_string(colors) + " but 1 to 4 must be");
  for (const glm::vec3& color : flower.petal_colors) check.components("flower.petal_colors", color, 0.0f, 1.0f);
  check.require(flower.petal_shares.empty() || flower.petal_shares.size() == colors,
                "flower.petal_shares: there are " + std::to_string(flower.petal_shares.size()) + " for " +
                    std::to_string(colors) + " petal_colors");
  float sum = 0.0f;
  for (const float share : flower.petal_shares) {
    check.within("flower.petal_shares", share, 0.0f, 1.0e6f);
    sum += share;
  }
  check.require(flower.petal_shares.empty() || sum > 0.0f, "flower.petal_shares are all 0; at least one must be more");
}

void check_flower(const FlowerShape& flower, Check& check) {
  check_petal_colors(flower, check);
  check.within("flower.petals", float(flower.petals), 3.0f, 32.0f);
  check.within("flower.petal_width", flower.petal_width, 0.1f, 2.0f);
  check.within("flower.cup", flower.cup, -1.0f, 1.5f);
  check.range("flower.head_m", flower.head_m, 1.0e-3f, 10.0f);
  check.components("flower.centre_color", flower.centre_color, 0.0f, 1.0f);
  check.within("flower.centre_share", flower.centre_share, 0.0f, 0.9f);
  check.components("flower.stem_color", flower.stem_color, 0.0f, 1.0f);
  check.within("flower.leaves", float(flower.leaves), 0.0f, 8.0f);
}

void check_custom(const CustomKind& custom, Check& check) {
  check.require(!custom.functions.empty(), "custom.functions names no file; a kind of the host's own needs one");
  check.within("custom.shoots", float(custom.shoots), 1.0f, float(k_most_shoots));
  check.require(custom.parameters.size() <= size_t(k_most_parameters),
                "custom.parameters: there are " + std::to_string(custom.parameters.size()) + " but at most 16 fit");
  for (const float parameter : custom.parameters)
    check.within("custom.parameters", parameter, std::numeric_limits<float>::lowest(),
                 std::numeric_limits<float>::max());
}

void check_plant_mesh(const PlantMesh& plant, Check& check) {
  check.require(plant.mesh || !plant.file.empty() || !plant.shape.empty(), "mesh: there is none; kind mesh needs one");
  const std::string fault = fault_of(plant);
  check.require(fault.empty(), "mesh " + (plant.file.empty() ? std::string() : "\"" + plant.file + "\" ") + fault);
}

void check_kind(const Species& species, Check& check) {
  if (species.kind == PlantKind::tuft) check_tuft(species.tuft, check);
  if (species.kind == PlantKind::flower) check_flower(species.flower, check);
  if (species.kind == PlantKind::custom) check_custom(species.custom, check);
  if (species.kind == PlantKind::mesh) check_plant_mesh(species.mesh, check);
}

/// A range whose bounds may be missing (infinite); NaN is refused.
void check_rule(const char* field, FloatRange range, Check& check) {
  check.within((std::string(field) + ".min").c_str(), range.min, -k_infinity, std::numeric_limits<float>::max());
  check.within((std::string(field) + ".max").c_str(), range.max, -std::numeric_limits<float>::max(), k_infinity);
  check.require(range.min <= range.max, std::string(field) + ".max is less than " + field + ".min");
}

void check_mask(const std::shared_ptr<const GrayMap>& mask, Check& check) {
  if (!mask) return;
  if (auto valid = mask->validate(); !valid) check.require(false, "mask " + valid.error().message);
}

void check_placement(const Species& species, float water_level_m, Check& check) {
  check_rule("slope", species.slope, check);
  check.finite_from("slope_soft", species.slope_soft, 0.0f);
  check_rule("altitude_m", species.altitude_m, check);
  check.finite_from("altitude_soft_m", species.altitude_soft_m, 0.0f);
  check.within("above_water_m", species.above_water_m, -k_infinity, std::numeric_limits<float>::max());
  check.require(species.above_water_m == -k_infinity || water_level_m > -k_infinity,
                "above_water_m needs the layer's water_level_m");
  check_mask(species.mask, check);
}

void check_season(const SeasonFrame& frame, const std::string& name, Check& check) {
  const SeasonValues& values = frame.values;
  const auto field = [&](const char* member) { return name + member; };
  check.within(field(".at").c_str(), frame.at, 0.0f, std::nextafter(1.0f, 0.0f));
  check.within(field(".reference_hsv[0]").c_str(), values.reference_hsv.x, 0.0f, std::nextafter(1.0f, 0.0f));
  check.within(field(".reference_hsv[1]").c_str(), values.reference_hsv.y, 0.0f, 1.0f);
  check.within(field(".reference_hsv[2]").c_str(), values.reference_hsv.z, 0.0f, 1.0f);
  check.components(field(".tint").c_str(), values.tint, 0.0f, 1.0e4f);
  check.components(field(".age_tint").c_str(), values.age_tint, 0.0f, 1.0e4f);
  check.within(field(".age_share").c_str(), values.age_share, 0.0f, 1.0f);
  check.within(field(".height").c_str(), values.height, 0.0f, 1.0f);
  check.within(field(".density").c_str(), values.density, 0.0f, 1.0f);
}

void check_seasons(const Species& species, Check& check) {
  for (size_t i = 0; i < species.seasons.size(); ++i) {
    const std::string name = "seasons[" + std::to_string(i) + "]";
    check_season(species.seasons[i], name, check);
    check.require(i == 0 || species.seasons[i].at > species.seasons[i - 1].at,
                  name + ".at is not above that of the frame before");
  }
}

void check_maps(const Layer& layer, Check& check) {
  check.within("water_level_m", layer.water_level_m, -k_infinity, std::numeric_limits<float>::max());
  check.require(std::isfinite(layer.season), "season is not finite");
  check_mask(layer.mask, check);
  if (layer.height_map)
    if (auto valid = layer.height_map->validate(); !valid) check.require(false, "height_map " + valid.error().message);
  check.within("height_tile_m", layer.height_tile_m, 0.1f, 1.0e5f);
  check.within("height_least", layer.height_least, 0.0f, 1.0f);
  if (!layer.distribution) return;
  if (auto valid = layer.distribution->validate(); !valid)
    check.require(false, "distribution: " + valid.error().message);
}

/// What is placed by the base map or the horizon does not go with surfaces of any direction.
void check_mesh(const Layer& layer, Check& check) {
  if (!layer.on_mesh) return;
  check.require(!layer.mask && layer.mask_file.empty(), "mask is set, which a layer on a mesh cannot have");
  check.require(!layer.height_map && layer.height_map_file.empty(),
                "height_map is set, which a layer on a mesh cannot have");
  check.require(!layer.distribution && layer.distribution_file.empty(),
                "distribution is set, which a layer on a mesh cannot have; give the mesh colours");
  for (const Species& species : layer.species) {
    const std::string owner = "species '" + species.name + "': ";
    check.require(!species.mask && species.mask_file.empty(), owner + "mask is set, which no plant on a mesh can have");
    check.require(species.phototropism == 0.0f, owner + "phototropism must be 0 on a mesh, where plants hang down");
  }
}

Expected<void> check_layer(const Layer& layer, const std::string& owner) {
  Check check(owner);
  check.require(!layer.species.empty(), "species: there is none; a layer needs at least one");
  check.require(layer.species.size() <= size_t(k_max_species),
                "species: there are " + std::to_string(layer.species.size()) + " but at most " +
                    std::to_string(k_max_species) + " fit; use several layers");
  check.finite_above("triangle_area_m2", layer.triangle_area_m2, 0.0f);
  check.finite_above("horizon_m", layer.horizon_m, 0.0f);
  check.within("cluster_size", float(layer.cluster_size), 1.0f, float(k_max_cluster_size));
  check.require(
      layer.law == DensityLaw::distance || layer.law == DensityLaw::screen_area || layer.law == DensityLaw::world_area,
      "law is none that is known");
  check.finite_above("density", layer.density, 0.0f);
  check.finite_above("full_distance_m", layer.full_distance_m, 0.0f);
  check.above("falloff", layer.falloff, 0.0f, 16.0f);
  check.within("ceiling", float(layer.ceiling), 1.0f, k_most_seeds);
  check.finite_above("full_segments_m", layer.full_segments_m, 0.0f);
  check.finite_from("shadow_distance_m", layer.shadow_distance_m, 0.0f);
  check_maps(layer, check);
  check_mesh(layer, check);
  if (layer.law == DensityLaw::distance) {
    check.above("density times triangle_area_m2 (seeds a triangle)", layer.density * layer.triangle_area_m2, 0.0f,
                k_most_seeds);
  }
  return check.result();
}

}  // namespace

float resistance_of(const Species& species) {
  if (species.resistance) return *species.resistance;
  const PlantKind kind = species.kind;
  if (kind == PlantKind::gravel || kind == PlantKind::litter || kind == PlantKind::billboard) return 1.0f;
  return std::clamp((species.height_m.max - 1.5f) / 2.5f, 0.0f, 1.0f);
}

Expected<void> validate(const Layer& layer) {
  const std::string owner = "layer '" + layer.name + "'";
  if (auto checked = check_layer(layer, owner); !checked) return checked;
  for (size_t i = 0; i < layer.species.size(); ++i) {
    const Species& species = layer.species[i];
    Check check(owner + ": species " + std::to_string(i) + " '" + species.name + "'");
    check_classification(species, check);
    check_growth(species, check);
    check_kind(species, check);
    check_images(species, check);
    check_placement(species, layer.water_level_m, check);
    check_seasons(species, check);
    if (auto checked = check.result(); !checked) return checked;
  }
  return {};
}

Expected<void> require_maps(const Layer& layer) {
  const auto missing = [&](const std::string& owner, const char* what, const std::string& file) {
    return fail("layer '" + layer.name + "'" + owner + ": the " + what + " \"" + file + "\" is named but not loaded");
  };
  if (!layer.mask && !layer.mask_file.empty()) return missing("", "mask", layer.mask_file);
  if (!layer.height_map && !layer.height_map_file.empty()) return missing("", "height map", layer.height_map_file);
  if (!layer.distribution && !layer.distribution_file.empty())
    return missing("", "distribution map", layer.distribution_file);
  for (const Species& species : layer.species) {
    if (!species.mask && !species.mask_file.empty())
      return missing(": species '" + species.name + "'", "mask", species.mask_file);
    if (!species.detail && !species.detail_file.path.empty())
      return missing(": species '" + species.name + "'", "detail", species.detail_file.path);
    if (!species.cutout && !species.cutout_file.path.empty())
      return missing(": species '" + species.name + "'", "cutout", species.cutout_file.path);
    if (species.kind == PlantKind::mesh && !species.mesh.mesh)
      return missing(": species '" + species.name + "'", "mesh", species.mesh.file + species.mesh.shape);
  }
  return {};
}

bool needs_altitudes(const Layer& layer) {
  return std::any_of(layer.species.begin(), layer.species.end(), [](const Species& s) {
    return s.altitude_m.min > -k_unbounded || s.altitude_m.max < k_unbounded || s.above_water_m > -k_unbounded;
  });
}

namespace {

glm::vec3 mix_hsv(glm::vec3 a, glm::vec3 b, float way) {
  if (a == b) return a;
  const float turn = b.x - a.x - std::floor(b.x - a.x + 0.5f);
  const float hue = a.x + turn * way;
  return {hue - std::floor(hue), glm::mix(a.y, b.y, way), glm::mix(a.z, b.z, way)};
}

SeasonValues mix(const SeasonValues& a, const SeasonValues& b, float way) {
  SeasonValues values;
  values.reference_hsv = mix_hsv(a.reference_hsv, b.reference_hsv, way);
  values.tint = glm::mix(a.tint, b.tint, way);
  values.age_tint = glm::mix(a.age_tint, b.age_tint, way);
  values.age_share = glm::mix(a.age_share, b.age_share, way);
  values.height = glm::mix(a.height, b.height, way);
  values.density = glm::mix(a.density, b.density, way);
  return values;
}

}  // namespace

SeasonValues season_values(const Species& species, float season) {
  const std::vector<SeasonFrame>& frames = species.seasons;
  if (frames.empty()) return {species.reference_hsv, species.tint, species.age_tint, species.age_share, 1.0f, 1.0f};
  const double at = double(season) - std::floor(double(season));
  size_t next = 0;
  while (next < frames.size() && double(frames[next].at) <= at) ++next;
  const SeasonFrame& before = frames[(next + frames.size() - 1) % frames.size()];
  const SeasonFrame& after = frames[next % frames.size()];
  const double begin = double(before.at) - (next == 0 ? 1.0 : 0.0);
  const double end = double(after.at) + (next == frames.size() ? 1.0 : 0.0);
  const double way = (at - begin) / (end - begin);
  return mix(before.values, after.values, float(way * way * (3.0 - 2.0 * way)));
}

float canopy_height(const Layer& layer) {
  float height = 0.0f;
  for (const Species& species : layer.species) {
    if (species.kind == PlantKind::none) continue;
    // Heads grow with distance as blades widen, by the root of 8 at most.
    const float head = species.kind == PlantKind::flower ? 1.5f * species.flower.head_m.max : 0.0f;
    height = std::max(height, species.height_m.max + head);
  }
  return height;
}

float canopy_spread(const Layer& layer) {
  constexpr float k_longest_shadow = 3.0f;  // heights (shaders/common_visible.glsl)
  constexpr float k_tall_m = 2.0f;
  const float height = canopy_height(layer);
  float reach = height;
  for (const Species& species : layer.species)
    if (species.kind != PlantKind::none) reach = std::max(reach, 0.5f * species.width_m.max);
  return layer.shadows && height >= k_tall_m ? reach + k_longest_shadow * height : reach;
}

}  // namespace sward
