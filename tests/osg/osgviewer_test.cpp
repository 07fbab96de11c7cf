// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Stock osgviewer, the program that OpenSceneGraph ships: what it says, and the screenshots that it writes at the key
// c.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <osg/Image>
#include <osgDB/ReadFile>
#include <string>

namespace {

namespace fs = std::filesystem;

constexpr int k_width = 200, k_height = 150;
const std::string k_scene = SWARD_OSG_TESTS "/small.toml.sward";
// Beside the line of sight, its foot in the grass: moved there by OpenSceneGraph's own pseudo-loader.
const std::string k_mast = "'" SWARD_OSG_MODELS "/mast.osgt.(6,0.7,10.9).trans'";

struct Shown {
  std::string said;
  osg::ref_ptr<osg::Image> picture;  // empty: none was written
};

// Five frames; c is pressed in the third.
Shown show(const std::string& arguments, const std::string& keys = "c2") {
  const fs::path folder =
      fs::path(testing::TempDir()) /
      (std::string("sward_osgviewer_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string command = "cd '" + folder.string() + "' && OSG_RUN_FRAME_COUNT=5 OSG_WINDOW='0 0 " +
                              std::to_string(k_width) + " " + std::to_string(k_height) + "' " SWARD_OSGVIEWER " " +
                              arguments + " " + keys + ".keys > said.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream stream(folder / "said.txt");
  Shown shown{{std::istreambuf_iterator<char>(stream), {}}, nullptr};
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
    if (file.path().extension() == ".jpg") shown.picture = osgDB::readRefImageFile(file.path().string());
  return shown;
}

void expect_no_complaint(const Shown& shown) {
  for (const char* bad : {"OpenGL error", "sward: error", "Could not", "Warning"})
    EXPECT_EQ(shown.said.find(bad), std::string::npos) << shown.said;
}

int green_at(const osg::Image& picture, int x, int y) {
  return picture.data(unsigned(x), unsigned(y))[1];
}

double roughness(const osg::Image& picture, int first_row, int last_row) {
  double sum = 0;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 1; x < k_width; ++x) sum += std::abs(green_at(picture, x, y) - green_at(picture, x - 1, y));
  return sum / ((last_row - first_row) * k_width);
}

// OpenSceneGraph clears to a dark blue; sky is brighter.
bool sky_at(const osg::Image& picture, int x, int y) {
  const unsigned char* pixel = picture.data(unsigned(x), unsigned(y));
  return pixel[2] > 120 && pixel[1] > 100;
}

// Its home is the scene's camera at eye level: plants fill the lower half, from the lowest row on.
void expect_scene(const Shown& shown) {
  expect_no_complaint(shown);
  ASSERT_TRUE(shown.picture.valid()) << shown.said;
  ASSERT_EQ(shown.picture->s(), k_width);
  ASSERT_EQ(shown.picture->t(), k_height);
  EXPECT_TRUE(sky_at(*shown.picture, k_width / 4, k_height - 5));
  EXPECT_GT(roughness(*shown.picture, 0, k_height / 8), 4) << "nothing is cut by the near plane";
  EXPECT_GT(roughness(*shown.picture, k_height / 8, k_height / 3), 4);
}

TEST(Osgviewer, ShowsSkyGroundAndPlants) {
  expect_scene(show(k_scene + " --SingleThreaded"));
}

TEST(Osgviewer, ShowsThemOnFourSamplesWithThreads) {
  expect_scene(show(k_scene + " --samples 4 --CullThreadPerCameraDrawThreadPerContext"));
}

// The statistics' panel is drawn by a camera of its own over the scene.
TEST(Osgviewer, ShowsStatisticsAndAModelOverTheScene) {
  const Shown shown = show(k_scene + " " + k_mast + " --DrawThreadPerContext", "s0_s1_c3");
  expect_no_complaint(shown);
  ASSERT_TRUE(shown.picture.valid()) << shown.said;
  int red = 0;
  for (int y = 0; y < k_height; ++y)
    for (int x = 0; x < k_width; ++x) {
      const unsigned char* pixel = shown.picture->data(unsigned(x), unsigned(y));
      red += pixel[0] > 150 && pixel[1] < 80 && pixel[2] < 80 ? 1 : 0;
    }
  EXPECT_GT(red, 30) << "bands of the mast";
  // The panel is a dark veil over the sky, and does not reach the right border.
  EXPECT_LT(green_at(*shown.picture, k_width / 2, k_height - 30),
            green_at(*shown.picture, k_width - 3, k_height - 30) - 30);
}

TEST(Osgviewer, SaysWhatIsWrongAndShowsTheRest) {
  const std::string broken = testing::TempDir() + "sward_osgviewer_broken.toml";
  std::ofstream(broken) << "[terrain]\nheight = \"nowhere.png\"\n";
  const Shown shown = show(k_mast + " " + broken + ".sward");
  EXPECT_NE(shown.said.find("nowhere.png"), std::string::npos) << shown.said;
  EXPECT_EQ(shown.said.find("OpenGL error"), std::string::npos) << shown.said;
  EXPECT_TRUE(shown.picture.valid()) << shown.said;
}

}  // namespace
