// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// [wind], [[wind.source]] and [[wind.mover]] of scene files.
#include <gtest/gtest.h>
#include <sward/scene/scene.h>

namespace sward {
namespace {

std::string scene_text(const std::string& wind) {
  return "[terrain]\ngenerator = \"meadow\"\n" + wind +
         "\n[[layer]]\n[[layer.species]]\nname = \"grass\"\ncolor = \"#6a8f3c\"\n";
}

SceneWind wind_of(const std::string& text) {
  const auto scene = parse_scene(scene_text(text), "t.toml");
  EXPECT_TRUE(scene) << scene.error().message;
  return scene && scene->wind ? *scene->wind : SceneWind();
}

void expect_error(const std::string& wind, int line, const std::string& part) {
  const auto scene = parse_scene(scene_text(wind), "t.toml");
  ASSERT_FALSE(scene) << wind;
  EXPECT_EQ(scene.error().message.rfind("t.toml:" + std::to_string(line) + ": ", 0), 0u) << scene.error().message;
  EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
}

TEST(SceneWind, NoneWithoutATable) {
  const auto scene = parse_scene(scene_text(""), "t.toml");
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->wind);
}

TEST(SceneWind, WeatherIsReadWithItsUnits) {
  const SceneWind wind = wind_of(
      "[wind]\nspeed_m_s = 7\nfrom_deg = 90\ngustiness = 0.3\ngust_length_m = 25\nambient_m_s = 0.1\n"
      "turbulence = 0.4\nstrength_map = \"a.png\"\nturn_map = \"b.png\"\n");
  EXPECT_EQ(wind.weather.speed_m_s, 7);
  EXPECT_NEAR(wind.weather.from_azimuth, 1.5707963f, 1e-6f);
  EXPECT_EQ(wind.weather.gustiness, 0.3f);
  EXPECT_EQ(wind.weather.gust_length_m, 25);
  EXPECT_EQ(wind.weather.ambient_m_s, 0.1f);
  EXPECT_EQ(wind.weather.turbulence, 0.4f);
  EXPECT_EQ(wind.strength_file, "a.png");
  EXPECT_EQ(wind.turn_file, "b.png");
  EXPECT_EQ(wind.where, "t.toml:3");
  EXPECT_EQ(wind_of("[wind]\nbeaufort = 8\n").weather.speed_m_s, beaufort_speed(8));
}

TEST(SceneWind, SourcesHaveTheDefaultsOfTheirKindWhereverItStands) {
  const SceneWind wind = wind_of(
      "[[wind.source]]\nposition_m = [3, -4]\nstart_s = 5\nspeed_m_s = 9\nduration_s = 2\nreach_m = 700\n"
      "[[wind.source]]\nposition_m = [1, 2]\nradius_m = 4\nspeed_m_s = 20\nvelocity_m_s = [1, 0]\nkind = "
      "\"whirlwind\"\n");
  ASSERT_EQ(wind.sources.size(), 2u);
  const WindSource &gust = wind.sources[0], &whirl = wind.sources[1];
  EXPECT_EQ(gust.position, glm::dvec2(3, -4));
  EXPECT_EQ(gust.start_s, 5);
  EXPECT_EQ(gust.outward_m_s, 9);
  EXPECT_EQ(gust.around_m_s, 0);
  EXPECT_EQ(gust.rise_s, 1) << "half of the duration";
  EXPECT_EQ(gust.reach_m, 700);
  EXPECT_EQ(whirl.around_m_s, 20);
  EXPECT_EQ(whirl.outward_m_s, -6);
  EXPECT_EQ(whirl.reach_m, 48);
  EXPECT_EQ(whirl.falloff, 1);
  EXPECT_EQ(whirl.duration_s, 30);
  EXPECT_EQ(whirl.velocity_m_s, glm::dvec2(1, 0));
}

TEST(SceneWind, MoversHavePaths) {
  const SceneWind wind = wind_of(
      "[[wind.mover]]\npath = [[0, 1, 2, 0], [4.5, 9, 8, 1]]\nshare = 0.5\n"
      "[[wind.mover]]\npath = [[2, 5, 6, 12]]\nwash_m_s = 22\nradius_m = 7\nkind = \"rotor\"\n");
  ASSERT_EQ(wind.movers.size(), 2u);
  EXPECT_EQ(wind.movers[0].mover.kind, WindMover::Kind::body);
  EXPECT_EQ(wind.movers[0].mover.strength, 0.5f);
  ASSERT_EQ(wind.movers[0].path.size(), 2u);
  EXPECT_EQ(wind.movers[0].path[1], glm::dvec4(4.5, 9, 8, 1));
  EXPECT_EQ(wind.movers[1].mover.strength, 22);
  EXPECT_EQ(wind.movers[1].mover.radius_m, 7);
  EXPECT_EQ(wind.movers[1].mover.kind, WindMover::Kind::rotor);
}

TEST(SceneWind, WhatIsWrongIsSaidWithItsLine) {
  expect_error("[wind]\nspeed_m_s = -1\n", 4, "expected a number in [0, 120] (metres a second)");
  expect_error("[wind]\nspeed_m_s = nan\n", 4, "expected a number");
  expect_error("[wind]\nspeed = 3\n", 4, "expected \"speed_m_s\"");
  expect_error("[wind]\nspeed_m_s = 3\nbeaufort = 3\n", 5, "contradict");
  expect_error("wind = 3\n", 3, "unknown key");  // it stands in [terrain]
  expect_error("[[wind.source]]\nstart_s = 1\n", 3, "expected position_m");
  expect_error("[[wind.source]]\nposition_m = [1, inf]\n", 4, "expected two numbers");
  expect_error("[[wind.source]]\nposition_m = [1, 2]\nkind = \"storm\"\n", 5, "expected \"gust\" or \"whirlwind\"");
  expect_error("[[wind.source]]\nposition_m = [1, 2]\nreach_m = 1\n", 3, "reach_m is 1; give more than 3");
  expect_error("[[wind.source]]\nposition_m = [1, 2]\nrepeat_s = 1\n", 3, "repeat_s is 1; give 4");
  expect_error("[[wind.source]]\nposition_m = [1, 2]\nrise_s = 3\n", 3, "rise_s is 3");
  expect_error("[[wind.mover]]\nkind = \"body\"\n", 3, "expected path");
  expect_error("[[wind.mover]]\npath = [[0, 1, 2, 0]]\n", 3, "two or more");
  expect_error("[[wind.mover]]\npath = [[1, 1, 2, 0], [1, 3, 2, 0]]\n", 4, "rising times");
  expect_error("[[wind.mover]]\npath = [[0, 1, 2, 0], [1, 3, 2, 0]]\nwash_m_s = 3\n", 5, "on a body");
  expect_error("[[wind.mover]]\nkind = \"rotor\"\npath = [[0, 1, 2, 0]]\nshare = 1\n", 6, "on a rotor");
  expect_error("[[wind.mover]]\npath = [[0, 1, 2, 0], [1, 3, 2, 0]]\nradius_m = 51\n", 5, "[0.01, 50]");
}

std::shared_ptr<const GrayMap> grey(std::vector<uint8_t> values) {
  auto map = std::make_shared<GrayMap>();
  map->width = int(values.size());
  map->height = 1;
  map->values = std::move(values);
  return map;
}

TEST(SceneWind, PaintedMapsAreFactorsAndTurns) {
  SceneWind wind;
  wind.where = "t.toml:9";
  EXPECT_EQ(*painted_wind(wind, {0, 0}, {1, 1}), nullptr);
  wind.strength_file = "a.png";
  const auto missing = painted_wind(wind, {0, 0}, {1, 1});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message.rfind("t.toml:9: ", 0), 0u);
  wind.strength = grey({128, 64, 0});
  wind.turn = grey({128, 192, 0});
  const auto map = painted_wind(wind, {5, 6}, {70, 80});
  ASSERT_TRUE(map);
  EXPECT_EQ((*map)->min, glm::dvec2(5, 6));
  EXPECT_EQ((*map)->size_m, glm::dvec2(70, 80));
  EXPECT_EQ((*map)->factors[0], glm::vec2(1, 0));
  EXPECT_NEAR((*map)->factors[1].y, 0.5f, 1e-6f);
  EXPECT_EQ(glm::length((*map)->factors[2]), 0);
  wind.turn = grey({128});
  EXPECT_FALSE(painted_wind(wind, {0, 0}, {1, 1}));
}

}  // namespace
}  // namespace sward
