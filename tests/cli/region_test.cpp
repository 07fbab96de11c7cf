// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// plants --region, and what rules, shapes and the season do to it: all without GL.

#include <cmath>

#include "cli_support.h"

namespace {

class CliRegion : public cli::CliTest {
 protected:
  // Adds to the end of the scene.
  std::string scene_with(const std::string& name, const std::string& lines) const {
    cli::write_file(inputs() / name, cli::read_file(scene()) + lines);
    return (inputs() / name).string();
  }
  std::vector<std::vector<std::string>> list(const std::string& arguments) {
    const cli::Result result = run("plants " + arguments + " -o plants.csv");
    EXPECT_EQ(result.status, 0) << result.err;
    return cli::read_csv(folder() / "plants.csv");
  }
};

TEST_F(CliRegion, ListsAPlaceAndLeavesShapesOut) {
  const auto all = list(scene() + " --region 10,20,18,26");
  ASSERT_GT(all.size(), 1000u);  // 48 square metres of 60 plants
  for (size_t i = 1; i < all.size(); ++i) {
    const double x = std::stod(all[i][3]), y = std::stod(all[i][4]);
    EXPECT_TRUE(x >= 10 && x <= 18 && y >= 20 && y <= 26);
  }
  const auto rest = list(scene_with("disc.toml", "[[exclude]]\ndisc = [14.0, 23.0, 2.0]\n") + " --region 10,20,18,26");
  EXPECT_NEAR(double(all.size() - rest.size()), 60 * 3.14159 * 4, 120);
  for (size_t i = 1; i < rest.size(); ++i)
    EXPECT_GT(std::hypot(std::stod(rest[i][3]) - 14, std::stod(rest[i][4]) - 23), 1.999);
}

TEST_F(CliRegion, TheSeasonChangesHeights) {
  const std::string year = scene_with(
      "year.toml", "[[layer.species.season]]\nat = 0.0\nheight = 0.5\n[[layer.species.season]]\nat = 0.5\n");
  const auto sum = [&](const std::string& season) {
    double heights = 0;
    const auto rows = list(year + " --region 0,0,10,10 --season " + season);
    for (size_t i = 1; i < rows.size(); ++i)
      if (rows[i][2] == "1") heights += std::stod(rows[i][6]);
    return heights;
  };
  const double winter = sum("0"), summer = sum("0.5");
  ASSERT_GT(winter, 0);
  EXPECT_NEAR(winter / summer, 0.5, 0.001);
}

TEST_F(CliRegion, RefusesWhatItCannotList) {
  expect_error(run("plants " + scene() + " -o p.csv"), 2);  // neither frame nor place
  expect_error(run("plants " + scene() + " --region 0,0,10,10 --at 1 -o p.csv"), 2);
  expect_error(run("plants " + scene() + " --region 10,0,0,10 -o p.csv"), 1);
  const cli::Result many = run("plants " + scene() + " --region 0,0,100,100 --most 100 -o p.csv");
  expect_error(many, 1);
  EXPECT_NE(many.err.find("more than 100 plants"), std::string::npos) << many.err;
  expect_error(run("plants " + scene() + " --region 0,0,1,1 --season 2 -o p.csv"), 1);
  EXPECT_TRUE(files_in_folder().empty());
}

#ifdef SWARD_IMAGE_IO
TEST_F(CliRegion, MasksAreReadFromFiles) {
  cli::write_file(inputs() / "west.pgm", std::string("P5\n2 1\n255\n") + '\0' + '\xff');
  std::string text = cli::read_file(scene());
  text.insert(text.find("[[layer.species]]"), "mask = \"west.pgm\"\n");
  cli::write_file(inputs() / "masked.toml", text);
  const auto rows = list((inputs() / "masked.toml").string() + " --region -8,0,8,4");
  ASSERT_GT(rows.size(), 500u);
  for (size_t i = 1; i < rows.size(); ++i) EXPECT_GE(std::stod(rows[i][3]), -1e-3);
  cli::write_file(inputs() / "none.toml", text.replace(text.find("west.pgm"), 8, "gone.pgm"));
  const cli::Result gone = run("plants " + (inputs() / "none.toml").string() + " --region 0,0,1,1 -o p.csv");
  expect_error(gone, 1);
  EXPECT_NE(gone.err.find("gone.pgm"), std::string::npos) << gone.err;
}
#endif

}  // namespace
