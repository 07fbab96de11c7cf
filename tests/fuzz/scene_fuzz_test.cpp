// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Damaged scene files: a scene that the rest may rely on, or one error line with its place. Never a crash.

#include <gtest/gtest.h>
#include <sward/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace sward;

/// Pieces that make damage meaningful to the parser.
const std::vector<std::string> k_pieces{"[",
                                        "]",
                                        "[[",
                                        "]]",
                                        "=",
                                        "\"",
                                        "\"\"\"",
                                        "'",
                                        "{",
                                        "}",
                                        ",",
                                        ".",
                                        "#",
                                        "\n",
                                        "\r\n",
                                        "\t",
                                        "nan",
                                        "inf",
                                        "-inf",
                                        "1e309",
                                        "-0.0",
                                        "0x7fffffffffffffff",
                                        "9999999999999999999999",
                                        "true",
                                        "1979-05-27T07:32:00Z",
                                        "\\u0000",
                                        "\\UFFFFFFFF",
                                        "\xff",
                                        "\xe2\x82",
                                        "layer",
                                        "terrain",
                                        "species",
                                        "[[layer.species.x]]",
                                        "[terrain.relief.x]",
                                        "height_m = [1, [2, [3]]]",
                                        "kind = \"none\"\n",
                                        "law = \"world_area\"\n",
                                        "[[layer.species.season]]\nat = 0.5\n",
                                        "[[exclude]]\npolygon = [[0, 0], [4, 0], [0, 4]]\n",
                                        "[[wind.source]]\nposition_m = [1, 2]\nkind = \"whirlwind\"\n",
                                        "[[wind.mover]]\npath = [[0, 1, 2, 0], [3, 4, 5, 0]]\n",
                                        "[[disturbance.event]]\nkind = \"cut\"\nposition_m = [1, 2]\n",
                                        "[[disturbance.walker]]\npath = [[0, 1, 2], [1, 2, 3]]\n",
                                        "altitude_m = [1, 2]\nslope_deg = [3, 4]\n"};

std::string mutate(std::string text, std::mt19937& random) {
  const auto pick = [&](size_t count) { return count == 0 ? size_t(0) : size_t(random()) % count; };
  const size_t rounds = 1 + pick(4);
  for (size_t i = 0; i < rounds; ++i) {
    const size_t at = pick(text.size() + 1);
    switch (pick(6)) {
      case 0:
        text.insert(at, k_pieces[pick(k_pieces.size())]);
        break;
      case 1:
        text.erase(at, 1 + pick(30));
        break;
      case 2:
        if (at < text.size()) text[at] = char(random());
        break;
      case 3:
        text.insert(at, text.substr(pick(text.size() + 1), pick(200)));
        break;
      case 4:
        text.resize(at);
        break;
      default: {
        // Another number in the place of a digit.
        const size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text.replace(digit, 1, k_pieces[16 + pick(7)]);
      }
    }
  }
  return text;
}

bool all_finite(std::initializer_list<double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

void expect_sound(const Scene& scene) {
  EXPECT_NE(scene.generator.empty(), scene.height_path.empty());
  EXPECT_TRUE(all_finite({scene.spacing.x, scene.spacing.y, scene.height_scale, scene.height_offset, scene.no_data,
                          scene.origin.x, scene.origin.y, scene.origin.z, scene.camera.x, scene.camera.y,
                          scene.camera.z, scene.camera_yaw, scene.camera_pitch, scene.fov_y, scene.sun_azimuth,
                          scene.sun_elevation, scene.haze_distance_m, scene.target_px, scene.generator_size_m}));
  EXPECT_GT(scene.spacing.x, 0.0);
  EXPECT_GT(scene.spacing.y, 0.0);
  EXPECT_GT(scene.haze_distance_m, 0.0f);
  EXPECT_GE(scene.max_triangles, 2u);
  for (const Layer& layer : scene.layers) {
    const auto valid = validate(layer);
    EXPECT_TRUE(valid) << valid.error().message;
  }
}

TEST(SceneFuzz, DamagedScenesAreErrorsOrSound) {
  std::mt19937 random(20150601);
  int errors = 0, scenes = 0;
  for (const EmbeddedText& original : embedded_scenes()) {
    for (int round = 0; round < 4000; ++round) {
      const std::string text = mutate(std::string(original.text), random);
      const auto scene = parse_scene(text, "fuzz.toml");
      if (scene) {
        ++scenes;
        expect_sound(*scene);
        continue;
      }
      ++errors;
      const std::string& message = scene.error().message;
      ASSERT_TRUE(message.starts_with("fuzz.toml:")) << message;
      const int line = std::atoi(message.c_str() + 10);
      const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
      EXPECT_TRUE(line >= 1 && line <= lines) << message << " of " << lines << " lines";
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_GT(message.size(), 20u) << message;
    }
  }
  // The mutations are neither too gentle nor hopeless.
  EXPECT_GT(errors, 1000);
  EXPECT_GT(scenes, 100);
}

TEST(SceneFuzz, EveryPrefixIsHandled) {
  for (const EmbeddedText& original : embedded_scenes()) {
    for (size_t length = 0; length <= original.text.size(); ++length) {
      const auto scene = parse_scene(original.text.substr(0, length), "cut.toml");
      if (scene)
        expect_sound(*scene);
      else
        ASSERT_TRUE(scene.error().message.starts_with("cut.toml:")) << scene.error().message;
    }
  }
}

TEST(SceneFuzz, DeepNestingIsRefused) {
  for (const char bracket : {'[', '{'}) {
    const auto scene = parse_scene("x = " + std::string(100000, bracket), "deep.toml");
    EXPECT_FALSE(scene);
  }
  // Dotted keys nest too, alone and within lists and tables that nest.
  for (const int parts : {30, 60, 20000, 1000000}) {
    std::string dotted = "a";
    for (int i = 0; i < parts; ++i) dotted += ".a";
    EXPECT_FALSE(parse_scene(dotted + " = 1\n", "dotted.toml"));
    EXPECT_FALSE(parse_scene("[" + dotted + "]\nb = 1\n", "dotted.toml"));
    std::string nested = "x = [\n";
    for (int i = 0; i < 300; ++i) nested += "{" + dotted.substr(0, 120) + " = [\n";
    EXPECT_FALSE(parse_scene(nested, "nested.toml"));
  }
}

}  // namespace
