// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// [[terrain.material]] of scene files.
#include <gtest/gtest.h>
#include <sward/scene/scene.h>

namespace sward {
namespace {

std::string scene_with(const std::string& materials) {
  return "[terrain]\ngenerator = \"meadow\"\n" + materials +
         "\n[[layer]]\n[[layer.species]]\nname = \"grass\"\nhsv = [90, 0.5, 0.4]\nweights = [2, 1, 0.5]\n";
}

std::string message(const std::string& materials) {
  const auto scene = parse_scene(scene_with(materials), "s.toml");
  return scene ? std::string() : scene.error().message;
}

TEST(SceneMaterials, AreReadWithTheirUnits) {
  const auto scene = parse_scene(scene_with(R"(
[[terrain.material]]
species = "grass"
detail = "grass"
tile_m = 1.5
[[terrain.material]]
name = "wall"
color = "#808080"
weights = [0, 1, 0.5]
detail = "rock"
cliff_detail = "strata"
broad_detail = "mottle"
cliff_tile_m = 8
exponent = 3
threshold = 0.2
strength = 0.5
relief_m = 0.1
cliff_relief_m = 0.4
sharpness = 2
[[terrain.material]]
detail = "sand.png"
)"),
                                 "s.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->materials.size(), 3u);
  const GroundMaterial& grass = scene->materials[0].material;
  EXPECT_EQ(grass.reference_hsv, glm::vec3(0.25f, 0.5f, 0.4f));
  EXPECT_EQ(grass.weights, glm::vec3(2, 1, 0.5f));
  EXPECT_EQ(grass.tile_m, 1.5f);
  EXPECT_EQ(grass.name, "grass");
  const GroundMaterial& wall = scene->materials[1].material;
  EXPECT_NEAR(wall.reference_hsv.value_or(glm::vec3(9)).z, 128.0f / 255, 1e-6);
  EXPECT_EQ(wall.name, "wall");
  EXPECT_EQ(wall.cliff_detail, "strata");
  EXPECT_EQ(wall.broad_detail, "mottle");
  EXPECT_EQ(wall.cliff_tile_m, 8);
  EXPECT_EQ(wall.exponent, 3);
  EXPECT_EQ(wall.max_distance, 0.2f);
  EXPECT_EQ(wall.strength, 0.5f);
  EXPECT_EQ(wall.relief_m, 0.1f);
  EXPECT_EQ(wall.cliff_relief_m, 0.4f);
  EXPECT_EQ(wall.sharpness, 2);
  EXPECT_FALSE(scene->materials[2].material.reference_hsv);
  EXPECT_EQ(scene->materials[2].detail_file, "sand.png");
  EXPECT_EQ(scene->materials[2].where, "s.toml:22");
  const auto unloaded = ground_materials(*scene);
  ASSERT_FALSE(unloaded);
  EXPECT_NE(unloaded.error().message.find("s.toml:22: the images of material"), std::string::npos);
}

TEST(SceneMaterials, AListWithoutOneThatIsEverywhereGetsSoil) {
  const auto scene = parse_scene(scene_with("[[terrain.material]]\nspecies = \"grass\"\n"), "s.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto materials = ground_materials(*scene);
  ASSERT_TRUE(materials && materials->size() == 2);
  EXPECT_FALSE(materials->at(1).reference_hsv);
  const auto none = parse_scene(scene_with("splatting = false\n"), "s.toml");
  ASSERT_TRUE(none);
  EXPECT_TRUE(ground_materials(*none)->empty());
  const auto usual = parse_scene(scene_with(""), "s.toml");
  ASSERT_TRUE(usual);
  EXPECT_EQ(ground_materials(*usual)->size(), default_ground_materials().size());
}

TEST(SceneMaterials, MistakesAreNamedWithTheirLineAndARemedy) {
  const std::string head = "[[terrain.material]]\n";
  EXPECT_EQ(message(head + "species = \"moss\"\n"),
            "s.toml:4: there is no species \"moss\" to take the material's colour from");
  EXPECT_NE(message(head + "detail = \"grvel\"\n")
                .find("s.toml:4: detail = \"grvel\" in [[terrain.material]]: expected "
                      "\"soil\", \"grass\", \"gravel\""),
            std::string::npos);
  EXPECT_EQ(message(head + "species = \"grass\"\ncolor = \"#808080\"\n"),
            "s.toml:5: color has no effect beside species, whose colour and weights the material has");
  EXPECT_EQ(message(head + "weights = [1, 1, 1]\n"),
            "s.toml:4: weights has no effect without a colour, expected color, hsv or species");
  EXPECT_NE(message(head + "tile_m = 0\n").find("s.toml:4: tile_m = 0"), std::string::npos);
  EXPECT_NE(message(head + "tile_n = 1\n").find("expected \"tile_m\""), std::string::npos);
  EXPECT_NE(message(head + "strength = 2\n").find("expected a number in [0, 1]"), std::string::npos);
  EXPECT_NE(message(head + "color = \"#808080\"\nweights = [0, 0, 0]\n").find("not all 0"), std::string::npos);
  EXPECT_NE(message(head + head).find("both everywhere"), std::string::npos);
  EXPECT_NE(message("material = 3\n").find("material is no list"), std::string::npos);
  std::string many;
  for (int i = 0; i < 17; ++i) many += head + "color = \"#808080\"\n";
  EXPECT_NE(message(many).find("at most 16"), std::string::npos) << message(many);
}

}  // namespace
}  // namespace sward
