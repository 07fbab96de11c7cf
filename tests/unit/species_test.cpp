// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/species.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace sward {
namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

Layer good_layer() {
  Layer layer;
  layer.name = "ground";
  layer.species.resize(3);
  layer.species[0].name = "fescue";
  layer.species[1].name = "sedge";
  layer.species[2].name = "soil";
  layer.species[2].kind = PlantKind::none;
  return layer;
}

TEST(ValidateLayer, AcceptsDefaultsAndExtremes) {
  EXPECT_TRUE(validate(good_layer()));
  Layer layer = good_layer();
  layer.species[1].max_distance = k_infinity;
  layer.species[2].forbids = true;
  layer.species[0].stiffness = {0.0f, 1.0f};
  layer.species[0].height_m = {0.3f, 0.3f};
  layer.species[0].max_segments = 64;
  layer.cluster_size = 32;
  layer.shadow_distance_m = 0.0f;
  layer.species.resize(size_t(k_max_species), layer.species[0]);
  EXPECT_TRUE(validate(layer));
}

struct BadLayer {
  const char* field;
  std::function<void(Layer&)> spoil;
};

const BadLayer k_bad_layers[] = {
    {"species", [](Layer& l) { l.species.clear(); }},
    {"species", [](Layer& l) { l.species.resize(65, l.species[0]); }},
    {"triangle_area_m2", [](Layer& l) { l.triangle_area_m2 = 0.0f; }},
    {"triangle_area_m2", [](Layer& l) { l.triangle_area_m2 = k_infinity; }},
    {"horizon_m", [](Layer& l) { l.horizon_m = -1.0f; }},
    {"horizon_m", [](Layer& l) { l.horizon_m = k_nan; }},
    {"cluster_size", [](Layer& l) { l.cluster_size = 0; }},
    {"cluster_size", [](Layer& l) { l.cluster_size = 33; }},
    {"law", [](Layer& l) { l.law = DensityLaw(7); }},
    {"density", [](Layer& l) { l.density = 0.0f; }},
    {"density", [](Layer& l) { l.density = k_infinity; }},
    {"density times triangle_area_m2", [](Layer& l) { l.density = 1.0e6f; }},
    {"full_distance_m", [](Layer& l) { l.full_distance_m = 0.0f; }},
    {"falloff", [](Layer& l) { l.falloff = 0.0f; }},
    {"ceiling", [](Layer& l) { l.ceiling = 0; }},
    {"ceiling", [](Layer& l) { l.ceiling = 1 << 21; }},
    {"full_segments_m", [](Layer& l) { l.full_segments_m = 0.0f; }},
    {"shadow_distance_m", [](Layer& l) { l.shadow_distance_m = -1.0f; }},
};

TEST(ValidateLayer, NamesEveryFieldOutOfRange) {
  for (const BadLayer& bad : k_bad_layers) {
    Layer layer = good_layer();
    bad.spoil(layer);
    const auto result = validate(layer);
    ASSERT_FALSE(result) << bad.field;
    EXPECT_NE(result.error().message.find("'ground'"), std::string::npos) << result.error().message;
    EXPECT_NE(result.error().message.find(std::string(": ") + bad.field), std::string::npos) << result.error().message;
  }
}

struct BadSpecies {
  const char* field;
  std::function<void(Species&)> spoil;
};

const BadSpecies k_bad_species[] = {
    {"kind", [](Species& s) { s.kind = PlantKind(99); }},
    {"reference_hsv[0]", [](Species& s) { s.reference_hsv.x = 1.0f; }},
    {"reference_hsv[1]", [](Species& s) { s.reference_hsv.y = -0.1f; }},
    {"reference_hsv[2]", [](Species& s) { s.reference_hsv.z = k_nan; }},
    {"weights[1]", [](Species& s) { s.weights.y = -1.0f; }},
    {"weights[2]", [](Species& s) { s.weights.z = k_infinity; }},
    {"weights", [](Species& s) { s.weights = glm::vec3(0.0f); }},
    {"exponent", [](Species& s) { s.exponent = 0.0f; }},
    {"exponent", [](Species& s) { s.exponent = 9.0f; }},
    {"max_distance", [](Species& s) { s.max_distance = 0.0f; }},
    {"max_distance", [](Species& s) { s.max_distance = k_nan; }},
    {"forbids", [](Species& s) { s.forbids = true; }},
    {"height_m.min", [](Species& s) { s.height_m.min = 0.0f; }},
    {"height_m.max", [](Species& s) { s.height_m.max = k_infinity; }},
    {"height_m.max",
     [](Species& s) {
       s.height_m = {0.5f, 0.4f};
     }},
    {"width_m.min", [](Species& s) { s.width_m.min = -1.0f; }},
    {"width_m.max", [](Species& s) { s.width_m.max = k_nan; }},
    {"stiffness.min", [](Species& s) { s.stiffness.min = -0.1f; }},
    {"stiffness.max", [](Species& s) { s.stiffness.max = 1.1f; }},
    {"lean", [](Species& s) { s.lean = 2.0f; }},
    {"phototropism", [](Species& s) { s.phototropism = 1.5f; }},
    {"max_segments", [](Species& s) { s.max_segments = 0; }},
    {"max_segments", [](Species& s) { s.max_segments = 65; }},
    {"tint[0]", [](Species& s) { s.tint.x = -1.0f; }},
    {"age_tint[2]", [](Species& s) { s.age_tint.z = k_nan; }},
    {"age_share", [](Species& s) { s.age_share = 1.1f; }},
    {"root_shade", [](Species& s) { s.root_shade = -0.1f; }},
    {"translucency", [](Species& s) { s.translucency = -0.1f; }},
    {"attenuation", [](Species& s) { s.attenuation = k_infinity; }},
    {"specular", [](Species& s) { s.specular = -0.1f; }},
    {"shininess", [](Species& s) { s.shininess = 0.5f; }},
};

void expect_refused(const Layer& layer, const std::string& field) {
  const auto result = validate(layer);
  ASSERT_FALSE(result) << field;
  const std::string& message = result.error().message;
  EXPECT_NE(message.find("layer 'ground': species 1 'sedge': " + field), std::string::npos) << message;
}

TEST(ValidateSpecies, NamesLayerSpeciesAndFieldOutOfRange) {
  for (const BadSpecies& bad : k_bad_species) {
    Layer layer = good_layer();
    bad.spoil(layer.species[1]);
    expect_refused(layer, bad.field);
  }
}

const BadSpecies k_bad_kinds[] = {
    {"tuft.blades.min",
     [](Species& s) {
       s.kind = PlantKind::tuft, s.tuft.blades = {0, 4};
     }},
    {"tuft.blades.max",
     [](Species& s) {
       s.kind = PlantKind::tuft, s.tuft.blades = {4, 10};
     }},
    {"tuft.blades.max is less",
     [](Species& s) {
       s.kind = PlantKind::tuft, s.tuft.blades = {4, 3};
     }},
    {"tuft.spread", [](Species& s) { s.kind = PlantKind::tuft, s.tuft.spread = k_nan; }},
    {"flower.petal_colors", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_colors.clear(); }},
    {"flower.petal_colors", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_colors.resize(5); }},
    {"flower.petal_colors[1]", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_colors[0].y = 1.1f; }},
    {"flower.petal_shares",
     [](Species& s) {
       s.kind = PlantKind::flower, s.flower.petal_shares = {1, 1};
     }},
    {"flower.petal_shares", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_shares = {-1}; }},
    {"flower.petal_shares are all 0", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_shares = {0}; }},
    {"flower.petals", [](Species& s) { s.kind = PlantKind::flower, s.flower.petals = 2; }},
    {"flower.petal_width", [](Species& s) { s.kind = PlantKind::flower, s.flower.petal_width = 0; }},
    {"flower.cup", [](Species& s) { s.kind = PlantKind::flower, s.flower.cup = -2; }},
    {"flower.head_m.min",
     [](Species& s) {
       s.kind = PlantKind::flower, s.flower.head_m = {0, 1};
     }},
    {"flower.head_m.max is less",
     [](Species& s) {
       s.kind = PlantKind::flower, s.flower.head_m = {0.2f, 0.1f};
     }},
    {"flower.centre_color[0]", [](Species& s) { s.kind = PlantKind::flower, s.flower.centre_color.x = -1; }},
    {"flower.centre_share", [](Species& s) { s.kind = PlantKind::flower, s.flower.centre_share = 1; }},
    {"flower.stem_color[2]", [](Species& s) { s.kind = PlantKind::flower, s.flower.stem_color.z = k_infinity; }},
    {"flower.leaves", [](Species& s) { s.kind = PlantKind::flower, s.flower.leaves = 9; }},
    {"custom.functions", [](Species& s) { s.kind = PlantKind::custom; }},
    {"custom.shoots",
     [](Species& s) {
       s.kind = PlantKind::custom, s.custom = {"a.glsl", 13, {}};
     }},
    {"custom.parameters",
     [](Species& s) {
       s.kind = PlantKind::custom, s.custom = {"a.glsl", 1, {k_infinity}};
     }},
    {"custom.parameters",
     [](Species& s) {
       s.kind = PlantKind::custom, s.custom = {"a.glsl", 1, std::vector<float>(17)};
     }},
};

TEST(ValidateSpecies, NamesWhatIsWrongWithAKind) {
  for (const BadSpecies& bad : k_bad_kinds) {
    Layer layer = good_layer();
    bad.spoil(layer.species[1]);
    expect_refused(layer, bad.field);
    // What another kind reads is nothing to this one.
    layer.species[1].kind = PlantKind::blade;
    EXPECT_TRUE(validate(layer)) << bad.field;
  }
}

TEST(ValidateSpecies, SaysTheRange) {
  Layer layer = good_layer();
  layer.species[0].phototropism = 1.5f;
  EXPECT_EQ(validate(layer).error().message,
            "layer 'ground': species 0 'fescue': phototropism is 1.5 but must lie in [0, 1]");
  layer = good_layer();
  layer.horizon_m = 0.0f;
  EXPECT_EQ(validate(layer).error().message, "layer 'ground': horizon_m is 0 but must lie in (0, infinity)");
  layer = good_layer();
  layer.species[0].max_distance = 0.0f;
  EXPECT_EQ(validate(layer).error().message,
            "layer 'ground': species 0 'fescue': max_distance is 0 but must lie in [0.0001, infinity]");
}

TEST(Canopy, SpreadsAsFarAsCrownsAndShadows) {
  Species tree, grass;
  tree.kind = PlantKind::billboard;
  tree.height_m = {4.0f, 6.0f};
  tree.width_m = {10.0f, 20.0f};
  grass.height_m = {0.2f, 0.5f};
  Layer layer;
  layer.species = {grass, tree};
  layer.shadows = false;
  EXPECT_FLOAT_EQ(canopy_spread(layer), 10.0f);
  layer.shadows = true;
  EXPECT_FLOAT_EQ(canopy_spread(layer), 28.0f);
  // Nobody misses a blade's shadow.
  layer.species = {grass};
  EXPECT_FLOAT_EQ(canopy_spread(layer), 0.5f);
}

TEST(Canopy, IsTheTallestPlant) {
  Layer layer = good_layer();
  layer.species[0].height_m = {0.2f, 0.7f};
  layer.species[1].height_m = {0.2f, 0.3f};
  layer.species[2].height_m = {0.2f, 9.0f};  // bare ground
  EXPECT_EQ(canopy_height(layer), 0.7f);
  layer.species = {layer.species[2]};
  EXPECT_EQ(canopy_height(layer), 0.0f);
}

}  // namespace
}  // namespace sward
