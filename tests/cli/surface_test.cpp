// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Surfaces and plants that are meshes, out of files: without GL.

#include "cli_support.h"

namespace {

class CliSurface : public cli::CliTest {
 protected:
  // The small scene with a surface made of keys, and a mesh file beside it.
  std::string scene_with(const std::string& name, const std::string& keys, const std::string& mesh) const {
    cli::write_file(inputs() / "body.off", mesh);
    cli::write_file(inputs() / name, cli::read_file(scene()) + "[[surface]]\nlayer = \"ivy\"\n" + keys +
                                         "[[layer]]\nname = \"ivy\"\non_mesh = true\ntriangle_area_m2 = 0.5\n"
                                         "density = 50.0\n[[layer.species]]\nname = \"ivy\"\ncolor = \"#304020\"\n");
    return (inputs() / name).string();
  }
  cli::Result list(const std::string& scene) { return run("plants " + scene + " --region -2,-2,2,2 -o plants.csv"); }
};

const std::string k_tent = "OFF\n4 2 0\n-1 -1 0\n1 -1 0\n0 0 1\n0 1 0\n3 0 1 2\n3 1 3 2\n";

TEST_F(CliSurface, PlantsStandOnAMeshFile) {
  const cli::Result result =
      list(scene_with("tent.toml", "mesh = \"body.off\"\ncolor = \"#304020\"\nposition_m = [0, 0, 50]\n", k_tent));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("sward: warning: "), std::string::npos) << "it has holes";
  EXPECT_NE(result.err.find("body.off"), std::string::npos) << result.err;
  const auto rows = cli::read_csv(folder() / "plants.csv");
  size_t high = 0;
  double ground = 0;
  for (size_t i = 1; i < rows.size(); ++i) ground = std::max(ground, rows[i][2] == "0" ? std::stod(rows[i][5]) : 0);
  for (size_t i = 1; i < rows.size(); ++i) high += std::stod(rows[i][5]) > ground + 40;
  // 1.4 and 1.2 square metres of 50.
  EXPECT_GT(high, 90u);
  EXPECT_LT(high, 200u);
}

TEST_F(CliSurface, BadMeshesAreNamed) {
  const auto expect_words = [&](const std::string& keys, const std::string& mesh, const std::string& words) {
    const cli::Result result = list(scene_with("bad.toml", keys, mesh));
    expect_error(result, 1);
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  const std::string painted = "mesh = \"body.off\"\ncolor = \"#304020\"\n";
  expect_words("mesh = \"none.off\"\n", k_tent, "none.off: no such mesh file");
  expect_words("mesh = \"body.off\"\n", k_tent, "no vertex colours");
  expect_words(painted, "", "body.off");
  expect_words(painted, "OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n", "no face with an area");
  expect_words(painted + "position_m = [90000, 0, 0]\n", k_tent, "no ground");
}

}  // namespace
