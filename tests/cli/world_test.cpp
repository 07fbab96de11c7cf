// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// render, fly and plants over a baked world: the pictures and plants of the height map it was baked of, errors that
// name what is missing, flights under a small cap.

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "cli_support.h"

namespace {

namespace fs = std::filesystem;

// The same program, driver and mesh: what may differ is which of two equal triangles is split first.
constexpr double k_mean_limit = 0.1;  // of 255

class CliWorld : public cli::CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
#ifndef SWARD_IMAGE_IO
    GTEST_SKIP() << "this build reads no height maps";
#endif
    // Squares as a field of this map has them, so that ids of triangles are the same.
    const std::string map = "'" + (inputs() / "small.pgm").string() + "'";
    ASSERT_EQ(run("bake " + map + " -o ../inputs/world --square 33 --spacing 4 --height-scale 0.01").status, 0);
    std::string colors = "P6\n16 12\n255\n";
    for (int i = 0; i < 16 * 12; ++i) colors += (i / 3 + i / 16) % 2 == 0 ? "\x60\x76\x3a" : "\x96\x8a\x58";
    cli::write_file(inputs() / "colors.ppm", colors);
    std::string flight = "time,x,y,z,yaw,pitch\n";
    for (int i = 0; i < 4; ++i)
      flight += std::to_string(i / 60.0) + "," + std::to_string(i * 40 - 60) + ",5,33,20,-8\n";
    cli::write_file(inputs() / "flight.csv", flight);
    // All of it is wanted: at this size of pictures the coarse data would do for what is far.
    std::string text = cli::read_file(inputs() / "small.toml");
    text.replace(text.find("height = "), text.find("max_triangles") - text.find("height = "),
                 "world = \"world\"\nworth_px = 0.0\n");
    cli::write_file(inputs() / "world.toml", text);
  }
  std::string input(const std::string& name) const {
    return "'" + (inputs() / name).string() + "'";
  }
  // The small scene's layers over its world, and over its height map without relief below the data.
  std::string over_world() const {
    return input("world.toml") + " --texture " + input("colors.ppm") + " ";
  }
  std::string over_field() const {
    return scene() + " --detail off --texture " + input("colors.ppm") + " ";
  }
  std::string flight() const {
    return " --flight " + input("flight.csv");
  }
  std::string render(const std::string& what) const {
    const cli::Result result = run("render " + what + " --size 160x90 -o p.ppm");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return cli::read_file(folder() / "p.ppm");
  }
  void damage() const {
    cli::write_file(inputs() / "world" / "r0001" / "c0001.square", "damaged");
  }
};

TEST_F(CliWorld, PicturesAreThoseOfTheMap) {
  SWARD_NEEDS_GL();
  for (const char* camera : {" --camera -2,20,+1.7,90,-12", " --camera 0,-60,+40,80,-30", " --camera 0,0,300,0,-89"}) {
    const std::string world = render(over_world() + camera), field = render(over_field() + camera);
    ASSERT_EQ(world.size(), 14u + 160 * 90 * 3);
    ASSERT_EQ(world.size(), field.size());
    double mean = 0;
    std::set<std::string> colors;
    for (size_t i = 14; i < world.size(); ++i) mean += std::abs(int(uint8_t(world[i])) - int(uint8_t(field[i])));
    for (size_t i = 14; i < world.size(); i += 3) colors.insert(world.substr(i, 3));
    EXPECT_LT(mean / double(world.size() - 14), k_mean_limit) << camera;
    EXPECT_GT(colors.size(), 500u) << camera;
  }
}

// A folder alone, with the built-in layers, a camera in its middle and a map painted from the coarse data.
TEST_F(CliWorld, FolderAloneIsEnough) {
  SWARD_NEEDS_GL();
  const std::string world = render("--world " + input("world") + " --triangles 1500");
  std::set<std::string> colors;
  for (size_t i = 14; i < world.size(); i += 3) colors.insert(world.substr(i, 3));
  EXPECT_GT(colors.size(), 500u);
  EXPECT_TRUE(world == render("--world " + input("world") + " --triangles 1500")) << "the same twice";
}

TEST_F(CliWorld, PlantsAreThoseOfTheMap) {
  for (const char* name : {"world.csv", "field.csv"}) {
    const std::string what = name[0] == 'w' ? over_world() : over_field();
    const cli::Result result = run("plants " + what + flight() + " --at 3 -o " + name);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  auto world = cli::read_csv(folder() / "world.csv"), field = cli::read_csv(folder() / "field.csv");
  ASSERT_GT(field.size(), 500u);
  ASSERT_EQ(world.size(), field.size());
  std::sort(world.begin(), world.end());
  std::sort(field.begin(), field.end());
  for (size_t i = 0; i < world.size(); ++i) {
    // z is the drawn surface's, whose vertices may still be moving; all else is static.
    for (size_t column = 0; column < world[i].size(); ++column) {
      if (column == 5) continue;
      ASSERT_EQ(world[i][column], field[i][column]) << "row " << i << " column " << column;
    }
  }
}

TEST_F(CliWorld, FlightsGoOnUnderASmallCap) {
  SWARD_NEEDS_GL();
  // The smallest cap there is, as the error names it.
  const cli::Result refused = run("fly " + over_world() + flight() + " --memory 0.001 --size 64x36 --csv f.csv");
  expect_error(refused, 1);
  const std::string words = "raise it to at least ";
  const size_t at = refused.err.find(words);
  ASSERT_NE(at, std::string::npos) << refused.err;
  const double bytes = std::stod(refused.err.substr(at + words.size())) + 10;
  const std::string cap = " --memory " + std::to_string(bytes / (1 << 20));
  for (const char* wait : {"", " --wait"}) {
    const cli::Result flown = run("fly " + over_world() + flight() + cap + wait + " --size 64x36 --csv f.csv");
    ASSERT_EQ(flown.status, 0) << flown.err;
    const auto rows = cli::read_csv(folder() / "f.csv");
    ASSERT_EQ(rows.size(), 5u);
    const auto column = [&rows](const char* name) {
      return size_t(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    };
    ASSERT_LT(column("world_mb"), rows[0].size());
    for (size_t i = 1; i < rows.size(); ++i) {
      EXPECT_LE(std::stod(rows[i][column("world_mb")]) * (1 << 20), bytes + 1);
      EXPECT_EQ(rows[i][column("squares_wanted")], "1");
      EXPECT_EQ(rows[i][column("squares_failing")], "0");
    }
  }
  // Over a height map there are no squares to tell of.
  ASSERT_EQ(run("fly " + scene() + flight() + " --size 64x36 --samples 1 --csv g.csv").status, 0);
  const auto rows = cli::read_csv(folder() / "g.csv");
  const auto column = std::find(rows[0].begin(), rows[0].end(), "squares_wanted") - rows[0].begin();
  EXPECT_EQ(rows[1].at(size_t(column)), "");
}

TEST_F(CliWorld, WaitingFlightsAreTheSameTwice) {
  SWARD_NEEDS_GL();
  std::vector<std::vector<std::string>> figures;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(run("fly " + over_world() + flight() + " --wait --size 64x36 --csv f.csv").status, 0);
    const auto rows = cli::read_csv(folder() / "f.csv");
    figures.emplace_back();
    for (size_t row = 1; row < rows.size(); ++row)
      for (size_t column = 0; column < rows[row].size(); ++column)
        if (rows[0][column].find("_ms") == std::string::npos && rows[0][column] != "peak_rss_mb")
          figures.back().push_back(rows[row][column]);
  }
  EXPECT_EQ(figures[0], figures[1]);
}

TEST_F(CliWorld, DamagedSquareIsNamed) {
  SWARD_NEEDS_GL();
  damage();
  const std::string low = " --camera -60,20,+30,0,-40";
  const cli::Result render = run("render " + over_world() + low + " --size 64x36 -o p.ppm");
  expect_error(render, 1);
  EXPECT_NE(render.err.find("square (1, 1): "), std::string::npos) << render.err;
  EXPECT_NE(render.err.find("c0001.square"), std::string::npos) << render.err;
  EXPECT_TRUE(files_in_folder().empty());
  // A flight that does not wait draws the coarse ground there, and says so once.
  const cli::Result live = run("fly " + over_world() + flight() + " --fps 60 --size 64x36 --csv f.csv");
  EXPECT_EQ(live.status, 0) << live.err;
  EXPECT_LE(std::count(live.err.begin(), live.err.end(), '\n'), 1) << live.err;
  expect_error(run("fly " + over_world() + flight() + " --wait --size 64x36 --csv g.csv"), 1);
}

TEST_F(CliWorld, DamagedIndexIsOneError) {
  const fs::path index = inputs() / "world" / "world.index";
  const std::string whole = cli::read_file(index);
  for (const std::string& bytes : {std::string("none"), whole.substr(0, whole.size() / 2)}) {
    cli::write_file(index, bytes);
    const cli::Result result = run("render " + over_world() + " -o p.ppm");
    if (result.err.find("EGL") != std::string::npos) GTEST_SKIP() << "no GL context here: " << result.err;
    expect_error(result, 1);
    EXPECT_NE(result.err.find("world.index"), std::string::npos) << result.err;
    EXPECT_TRUE(files_in_folder().empty());
  }
}

struct BadWorld {
  const char* name;
  const char* arguments;  ///< WORLD stands for the scene over the world, SCENE for the one over its map.
  const char* message;
};

class CliBadWorld : public CliWorld, public testing::WithParamInterface<BadWorld> {};

TEST_P(CliBadWorld, OneLineAndNothingLeft) {
  std::string arguments = GetParam().arguments;
  const std::pair<std::string, std::string> words[] = {
      {"WORLD", input("world.toml")}, {"SCENE", scene()}, {"MAP", input("small.pgm")}, {"FOLDER", input("world")}};
  for (const auto& [word, stands_for] : words)
    for (size_t at = arguments.find(word); at != std::string::npos; at = arguments.find(word))
      arguments.replace(at, word.size(), stands_for);
  const cli::Result result = run(arguments);
  if (result.err.find("EGL") != std::string::npos) GTEST_SKIP() << "no GL context here: " << result.err;
  expect_error(result, 1);
  EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
  EXPECT_TRUE(files_in_folder().empty());
}

const BadWorld k_bad[] = {
    {"Missing", "render --world none -o p.ppm", "sward bake"},
    {"NoWorld", "render --world .. -o p.ppm", "world.index"},
    {"FlyMissing", "fly --world none --csv f.csv", "sward bake"},
    {"WorldAndHeight", "render --world FOLDER --height MAP -o p.ppm", "--world and --height contradict"},
    {"Spacing", "render --world FOLDER --spacing 3 -o p.ppm", "baked with"},
    {"Detail", "render WORLD --detail on -o p.ppm", "--detail on"},
    {"MemoryWithoutWorld", "render SCENE --memory 9 -o p.ppm", "--memory is the cap of a world"},
    {"NoMemory", "render WORLD --memory 0 -o p.ppm", "--memory must be"},
    {"MemoryBelowTwoSquares", "render WORLD --memory 0.001 -o p.ppm", "raise it to at least"},
    {"WaitWithoutWorld", "fly SCENE --wait --csv f.csv", "--wait is for worlds"},
    {"PaperFlight", "fly WORLD --csv f.csv", "--flight FILE.csv"},
    {"CameraBesideIt", "render WORLD --camera 9999,0,+2,0,0 -o p.ppm", "terrain spans x -256 to 256"},
    {"MissingTexture", "render WORLD --texture none.png -o p.ppm", "none.png"},
};

INSTANTIATE_TEST_SUITE_P(Kinds, CliBadWorld, testing::ValuesIn(k_bad),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
