// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Wrong usage and bad data: one error line, the right exit status, and nothing left in the folder.

#include "cli_support.h"

namespace {

struct BadInput {
  const char* name;
  const char* arguments;  ///< SCENE stands for the small scene.
  int status;
  const char* message;  ///< Part of the line.
};

class CliBadInput : public cli::CliTest, public testing::WithParamInterface<BadInput> {};

TEST_P(CliBadInput, OneLineAndNothingLeft) {
  std::string arguments = GetParam().arguments;
  for (size_t at = arguments.find("SCENE"); at != std::string::npos; at = arguments.find("SCENE"))
    arguments.replace(at, 5, scene());
  const cli::Result result = run(arguments);
  if (result.err.find("EGL") != std::string::npos) GTEST_SKIP() << "no GL context here: " << result.err;
  expect_error(result, GetParam().status);
  EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
  EXPECT_TRUE(files_in_folder().empty()) << "left behind: " << files_in_folder().front();
}

const BadInput k_cases[] = {
    // Usage: what does not parse, what is missing.
    {"NoCommand", "", 2, "subcommand"},
    {"UnknownCommand", "mow", 2, "subcommand"},
    {"UnknownOption", "info --loudly", 2, "--loudly"},
    {"NoOutput", "render SCENE", 2, "--output"},
    {"CameraTooShort", "render SCENE --camera 1,2 -o a.ppm", 2, "--camera"},
    {"CameraNoNumber", "render SCENE --camera 1,2,high,0,0 -o a.ppm", 2, "high"},
    {"SizeNoSize", "render SCENE --size big -o a.ppm", 2, "--size"},
    {"SamplesNoNumber", "render SCENE --samples many -o a.ppm", 2, "--samples"},
    {"SunTooShort", "render SCENE --sun 3 -o a.ppm", 2, "--sun"},
    {"DetailNoSwitch", "render SCENE --detail maybe -o a.ppm", 2, "--detail"},
    {"SourceUnknown", "render SCENE --source quadtree -o a.ppm", 2, "--source"},
    {"BudgetOfAClipmap", "render SCENE --source clipmap --triangles 500 -o a.ppm", 1, "--source roam"},
    {"NegativeBudget", "mesh SCENE --triangles -5", 2, "--triangles"},
    {"AtWithoutOutput", "mesh SCENE --at 3", 2, "--output"},
    {"OutputWithoutAt", "mesh SCENE -o a.ply", 2, "--at"},
    {"PlantsWithoutFrame", "plants SCENE -o a.csv", 2, "--at"},
    // Numbers out of range.
    {"CameraNaN", "render SCENE --camera nan,0,0,0,0 -o a.ppm", 1, "camera"},
    {"CameraInfinite", "render SCENE --camera 0,0,0,inf,0 -o a.ppm", 1, "camera"},
    {"CameraOffTheMap", "render SCENE --camera 1e6,0,+1.7,0,0 -o a.ppm", 1, "terrain spans x -256 to 256"},
    {"EmptySize", "render SCENE --size 0x10 -o a.ppm", 1, "0x10"},
    {"NegativeSize", "render SCENE --size 16x-1 -o a.ppm", 1, "16x-1"},
    {"NoSamples", "render SCENE --samples 0 -o a.ppm", 1, "--samples"},
    {"MoreSamplesThanThereAre", "render SCENE --samples 4096 -o a.ppm", 1, "maximum"},
    {"FlyMoreSamplesThanThereAre", "fly SCENE --samples 4096 --csv a.csv", 1, "maximum"},
    {"TimeNaN", "render SCENE --time nan -o a.ppm", 1, "--time"},
    {"WindOverlayWithoutWind", "render SCENE --wind-overlay -o a.ppm", 1, "[wind]"},
    {"SunAboveTheZenith", "render SCENE --sun 0,91 -o a.ppm", 1, "--sun"},
    {"NoSuchShaders", "render SCENE --shaders nowhere -o a.ppm", 1, "nowhere: there is no such folder of shaders"},
    {"BudgetBelowTheRoots", "mesh SCENE --triangles 1", 1, "root mesh"},
    {"FrameBeyondTheFlight", "mesh SCENE --fps 1 --at 30 -o a.ply", 1, "frames 0 to 29"},
    {"PlantsBeyondTheFlight", "plants SCENE --fps 1 --at 30 -o a.csv", 1, "frames 0 to 29"},
    {"FlightTooLong", "fly SCENE --seconds 31 --csv a.csv", 1, "30"},
    {"FlightTooLongFrom", "fly SCENE --from 20 --seconds 11 --csv a.csv", 1, "30"},
    {"NoFramesASecond", "mesh SCENE --fps 0", 1, "--fps"},
    // Files.
    {"MissingScene", "render nowhere.toml -o a.ppm", 1, "nowhere.toml"},
    {"UnknownBuiltIn", "render nowhere -o a.ppm", 1, "meadow"},
    {"SceneIsAFolder", "render .. -o a.ppm", 1, ".."},
    {"MissingHeights", "render --height none.png -o a.ppm", 1, "none.png"},
    {"MissingTexture", "render SCENE --texture none.png -o a.ppm", 1, "none.png"},
    {"SpacingWithoutHeights", "render --spacing 3 -o a.ppm", 1, "--height"},
    {"MissingFlight", "mesh SCENE --flight none.csv", 1, "none.csv"},
    {"NoPictureFormat", "render SCENE -o a.txt", 1, ".ppm"},
    // Output folders: found out before the long work.
    {"NoFolderForThePicture", "render -o none/a.ppm", 1, "none: this output folder does not exist"},
    {"NoFolderForTheStats", "render -o a.ppm --stats none/a.json", 1, "none: this output folder does not exist"},
    {"NoFolderForTheFrames", "fly --csv none/a.csv", 1, "none: this output folder does not exist"},
    {"NoFolderForTheSummary", "fly --summary none/a.json", 1, "none: this output folder does not exist"},
    {"NoFolderForPlots", "fly --plots none", 1, "none: this output folder does not exist"},
    {"NoFolderForTheMesh", "mesh --at 0 -o none/a.ply", 1, "none: this output folder does not exist"},
    {"NoFolderForTimings", "mesh --timings none/a.csv", 1, "none: this output folder does not exist"},
    {"NoFolderForPlants", "plants --at 0 -o none/a.csv", 1, "none: this output folder does not exist"},
    {"OutputIsAFolder", "mesh --timings .", 1, "is a folder"},
};

INSTANTIATE_TEST_SUITE_P(Table, CliBadInput, testing::ValuesIn(k_cases),
                         [](const auto& each) { return std::string(each.param.name); });

class CliBadFiles : public cli::CliTest {
 protected:
  void expect_refused(const std::string& flight, const std::string& message) {
    cli::write_file(inputs() / "flight.csv", flight);
    const cli::Result result =
        run("mesh " + scene() + " --timings t.csv --flight '" + (inputs() / "flight.csv").string() + "'");
    expect_error(result, 1);
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_TRUE(files_in_folder().empty());
  }
};

TEST_F(CliBadFiles, FlightsNameTheirLine) {
  expect_refused("", "flight.csv:1");
  expect_refused("a,b\n", "flight.csv:1");
  expect_refused("time,x,y,z,yaw,pitch\n", "no frame");
  expect_refused("time,x,y,z,yaw,pitch\n0,0,0,90,0,0\n1,0,0,90,0\n", "flight.csv:3");
  expect_refused("time,x,y,z,yaw,pitch\n0,0,0,90,east,0\n", "\"east\" is not a number");
  expect_refused("time,x,y,z,yaw,pitch\n0,0,0,nan,0,0\n", "flight.csv:2");
  expect_refused("time,x,y,z,yaw,pitch\n1,0,0,90,0,0\n0,0,0,90,0,0\n", "backwards");
}

TEST_F(CliBadFiles, ScenesNameTheirLine) {
  cli::write_file(inputs() / "bad.toml", "name = \"bad\"\n[terrain]\ngenerator = \"meadow\"\nheigth = 3\n");
  const cli::Result result = run("render '" + (inputs() / "bad.toml").string() + "' -o a.ppm");
  expect_error(result, 1);
  EXPECT_NE(result.err.find("bad.toml:4"), std::string::npos) << result.err;
  EXPECT_TRUE(files_in_folder().empty());
}

TEST_F(CliBadFiles, ReplacedShadersNameTheirLine) {
  cli::write_file(inputs() / "sky.frag.glsl", "layout(location = 0) out vec4 color;\nvoid main() { color = blue; }\n");
  const cli::Result result =
      run("render " + scene() + " --size 16x9 --samples 1 -o a.ppm --shaders '" + inputs().string() + "'");
  if (result.err.find("EGL") != std::string::npos) GTEST_SKIP() << "no GL context here: " << result.err;
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("sky.frag.glsl"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("blue"), std::string::npos) << result.err;
  EXPECT_TRUE(files_in_folder().empty());
}

#ifdef SWARD_IMAGE_IO
TEST_F(CliBadFiles, DamagedHeightMaps) {
  const std::string whole = cli::height_map();
  const std::pair<const char*, std::string> files[] = {{"empty.pgm", ""},
                                                       {"truncated.pgm", whole.substr(0, whole.size() / 2)},
                                                       {"text.png", "no picture\n"},
                                                       {"zero.pgm", "P5\n0 0\n65535\n"}};
  for (const auto& [name, bytes] : files) {
    cli::write_file(inputs() / name, bytes);
    const cli::Result result = run("mesh --timings t.csv --height '" + (inputs() / name).string() + "'");
    expect_error(result, 1);
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
    EXPECT_TRUE(files_in_folder().empty());
  }
}
#else
TEST_F(CliBadFiles, PicturesOfBareBuilds) {
  const cli::Result result = run("render " + scene() + " -o a.png");
  expect_error(result, 1);
  EXPECT_NE(result.err.find(".ppm"), std::string::npos) << result.err;
}
#endif

TEST_F(CliBadFiles, ViewWithoutADisplay) {
  const cli::Result result = run("view " + scene(), "env -u DISPLAY -u WAYLAND_DISPLAY");
  expect_error(result, 1);
  EXPECT_NE(result.err.find("sward render"), std::string::npos) << result.err;
}

// A file that was there before stays as it was when the work fails.
TEST_F(CliBadFiles, OlderOutputsSurviveAFailure) {
  cli::write_file(folder() / "t.csv", "older\n");
  expect_error(run("mesh " + scene() + " --triangles 1 --timings t.csv"), 1);
  EXPECT_EQ(cli::read_file(folder() / "t.csv"), "older\n");
}

TEST_F(CliBadFiles, HelpIsNoError) {
  for (const char* arguments : {"--help", "render --help", "--version"}) {
    const cli::Result result = run(arguments);
    EXPECT_EQ(result.status, 0) << arguments;
    EXPECT_NE(result.out, "") << arguments;
    EXPECT_EQ(result.err, "") << arguments;
  }
}

}  // namespace
