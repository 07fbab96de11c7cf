// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Scene keys of placement and seasons.
#include <gtest/gtest.h>
#include <sward/scene/scene.h>

namespace sward {
namespace {

std::string scene_text(const std::string& layer, const std::string& species, const std::string& end = "") {
  return "[terrain]\ngenerator = \"meadow\"\n[[layer]]\nname = \"cover\"\n" + layer +
         "[[layer.species]]\nname = \"grass\"\ncolor = \"#6a8f3c\"\n" + species + end;
}

void expect_error(const std::string& text, int line, const std::string& part) {
  const auto scene = parse_scene(text, "t.toml");
  ASSERT_FALSE(scene) << text;
  EXPECT_EQ(scene.error().message.rfind("t.toml:" + std::to_string(line) + ": ", 0), 0u) << scene.error().message;
  EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
}

TEST(ScenePlacement, KeysReachTheLayer) {
  const auto scene = parse_scene(
      scene_text(
          "water_level_m = 3.5\nmask = \"a.png\"\nheight_map = \"h.png\"\nheight_tile_m = 8\nheight_least = 0.2\n"
          "distribution = \"b.png\"\n",
          "slope_deg = [0, 30]\nslope_soft_deg = 10\naltitude_m = [10, 400]\naltitude_soft_m = 5\n"
          "above_water_m = -0.5\nmask = \"c.png\"\ntint = [2, 2, 2]\n"
          "[[layer.species.season]]\nat = 0.25\nheight = 0.5\n"
          "[[layer.species.season]]\nat = 0.75\ntint = [1, 1, 1]\ncolor = \"#ff0000\"\n",
          "[season]\nat = 0.25\n[[season.ground]]\nat = 0.25\ntint = [0.5, 1, 1]\n"
          "[[exclude]]\ndisc = [1, 2, 3]\n"
          "[[exclude]]\nlayer = \"cover\"\npolygon = [[0, 0], [4, 0], [0, 4]]\n"),
      "t.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  const Layer& layer = scene->layers[0];
  const Species& grass = layer.species[0];
  EXPECT_EQ(layer.water_level_m, 3.5f);
  EXPECT_EQ(layer.mask_file, "a.png");
  EXPECT_EQ(layer.height_map_file, "h.png");
  EXPECT_EQ(layer.height_tile_m, 8.0f);
  EXPECT_EQ(layer.height_least, 0.2f);
  EXPECT_EQ(layer.distribution_file, "b.png");
  EXPECT_EQ(grass.mask_file, "c.png");
  EXPECT_NEAR(grass.slope.max, 0.5235988f, 1e-6f);
  EXPECT_NEAR(grass.slope_soft, 0.1745329f, 1e-6f);
  EXPECT_EQ(grass.altitude_m.min, 10);
  EXPECT_EQ(grass.altitude_soft_m, 5);
  EXPECT_EQ(grass.above_water_m, -0.5f);
  EXPECT_EQ(layer.season, 0.25f);
  ASSERT_EQ(grass.seasons.size(), 2u);
  EXPECT_EQ(grass.seasons[0].values.tint, glm::vec3(2));  // the species' own
  EXPECT_EQ(grass.seasons[0].values.height, 0.5f);
  EXPECT_EQ(grass.seasons[0].values.reference_hsv, grass.reference_hsv);
  EXPECT_EQ(grass.seasons[1].values.reference_hsv, glm::vec3(0, 1, 1));
  EXPECT_EQ(season_values(grass, 0.5f).tint, glm::vec3(1.5f));
  EXPECT_EQ(ground_tint(scene->ground_seasons, 0.9f), glm::vec3(0.5f, 1, 1));
  ASSERT_EQ(scene->exclusions.size(), 2u);
  EXPECT_EQ(scene->exclusions[0].radius_m, 3);
  EXPECT_EQ(scene->exclusions[1].layer, "cover");
  EXPECT_EQ(scene->exclusions[1].corners.size(), 3u);
}

TEST(ScenePlacement, WhatIsWrongIsSaidWithItsLine) {
  expect_error(scene_text("", "slope_deg = [40, 30]\n"), 8, "min <= max (degrees)");
  expect_error(scene_text("", "slope_deg = [0, 91]\n"), 8, "in [0, 90]");
  expect_error(scene_text("", "altitude_m = [nan, 1]\n"), 8, "altitude_m");
  expect_error(scene_text("", "altitude_soft_m = -1\n"), 8, "a number >= 0");
  expect_error(scene_text("", "above_water_m = 1\n"), 3, "above_water_m needs the layer's water_level_m");
  expect_error(scene_text("", "mask = 3\n"), 8, "the path of an image");
  expect_error(scene_text("", "[[layer.species.season]]\nheight = 0.5\n"), 8, "expected at = 0 to 1");
  expect_error(scene_text("", "[[layer.species.season]]\nat = 1.0\n"), 9, "a number in [0, 1)");
  expect_error(scene_text("", "[[layer.species.season]]\nat = 0.5\n[[layer.species.season]]\nat = 0.5\n"), 10,
               "not above that of the frame before");
  expect_error(scene_text("", "season = [{ at = 0.5 }]\ntint = [1, 1, 1]\n"), 9, "expected before it");
  expect_error(scene_text("", "", "[[exclude]]\ndisc = [0, 0, -1]\n"), 9, "the radius in (0, 1000000]");
  expect_error(scene_text("", "", "[[exclude]]\n"), 8, "neither a radius nor corners");
  expect_error(scene_text("", "", "[[exclude]]\npolygon = [[0, 0], [4, 4], [4, 0], [0, 3]]\n"), 8,
               "edges 0-1 and 2-3 meet");
  expect_error(scene_text("", "", "[[exclude]]\npolygon = [[0, 0], [inf, 4], [4, 0]]\n"), 9, "finite");
  expect_error(scene_text("", "", "[[exclude]]\nlayer = \"trees\"\ndisc = [0, 0, 1]\n"), 8,
               "there is no layer \"trees\"");
  expect_error(scene_text("", "", "[season]\nat = 1.5\n"), 9, "a number in [0, 1]");
}

}  // namespace
}  // namespace sward
