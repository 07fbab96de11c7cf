// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// terrain.source and --source: the same plants, much the same picture, figures of their own.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli_support.h"

namespace {

class CliClipmap : public cli::CliTest {
 protected:
  // The scene, drawn by a clipmap.
  std::string clipmap_scene() const {
    std::string text = cli::read_file(scene());
    const std::string budget = "max_triangles = 1500\n";
    text.replace(text.find(budget), budget.size(), "source = \"clipmap\"\n");
    cli::write_file(inputs() / "clipmap.toml", text);
    return (inputs() / "clipmap.toml").string();
  }
  // id, rank, species of each plant, to the rest of its row.
  std::map<std::string, std::vector<std::string>> plants(const std::string& arguments) {
    const cli::Result result = run("plants " + arguments + " -o plants.csv");
    EXPECT_EQ(result.status, 0) << result.err;
    std::map<std::string, std::vector<std::string>> found;
    const auto rows = cli::read_csv(folder() / "plants.csv");
    for (size_t i = 1; i < rows.size(); ++i) found[rows[i][0] + "," + rows[i][1] + "," + rows[i][2]] = rows[i];
    return found;
  }
};

double mean_difference(const std::string& a, const std::string& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0;
  for (size_t i = 14; i < a.size(); ++i) sum += std::abs(int(uint8_t(a[i])) - int(uint8_t(b[i])));
  return sum / double(a.size() - 14);
}

TEST_F(CliClipmap, ThePictureIsMuchTheMeshs) {
  SWARD_NEEDS_GL();
  // A scene file's source and the option are the same.
  const std::string rest = " --camera 0,0,+1.7,90,-15 --size 160x90 --samples 1 -o ";
  ASSERT_EQ(run("render " + scene() + rest + "roam.ppm").status, 0);
  ASSERT_EQ(run("render " + scene() + " --source clipmap" + rest + "a.ppm --stats a.json").status, 0);
  ASSERT_EQ(run("render " + clipmap_scene() + rest + "b.ppm").status, 0);
  const std::string clipmap = cli::read_file(folder() / "a.ppm");
  EXPECT_TRUE(clipmap == cli::read_file(folder() / "b.ppm"));
  const double difference = mean_difference(clipmap, cli::read_file(folder() / "roam.ppm"));
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference, 8.0);  // the scene's mesh has 1500 triangles: its ground is off by centimetres
  const auto json = nlohmann::json::parse(cli::read_file(folder() / "a.json"));
  EXPECT_TRUE(json["bound_px"].is_null());
  EXPECT_GT(json["clipmap_blocks"], 10);
  EXPECT_EQ(json["clipmap_finest"], 0);
  EXPECT_GT(json["clipmap_points"], 100000);
  EXPECT_GT(json["fixed_triangles"], 100);
  EXPECT_GT(json["plants"], 100);
  EXPECT_GE(json["clusters_submitted"], json["clusters_fertile"]);
  EXPECT_GT(json["clusters_fertile"], 0);
}

TEST_F(CliClipmap, PlantsAreTheSame) {
  SWARD_NEEDS_GL();
  cli::write_file(inputs() / "flight.csv", "time,x,y,z,yaw,pitch\n0,5,7,40,90,-20\n1,6,7,34,80,-25\n");
  const std::string frame = " --flight " + (inputs() / "flight.csv").string() + " --fps 1 --at 1";
  const auto clipmap = plants(clipmap_scene() + " --gpu" + frame);
  const auto all = plants(scene() + " --region -50,-50,60,60");
  ASSERT_GT(clipmap.size(), 1000u);
  size_t unknown = 0;
  for (const auto& [key, row] : clipmap) {
    const auto found = all.find(key);
    if (found == all.end()) {
      ++unknown;
      continue;
    }
    for (const int column : {3, 4}) EXPECT_NEAR(std::stod(row[column]), std::stod(found->second[column]), 1e-3);
    for (const int column : {6, 7, 8})
      EXPECT_NEAR(std::stod(row[column]), std::stod(found->second[column]), 1e-4 * std::stod(row[column]));
  }
  EXPECT_LE(double(unknown), 0.001 * double(clipmap.size()));
  // Without --gpu the CPU's twin, over a mesh: the same again, but for what culling leaves over at the picture's edges.
  const auto twin = plants(clipmap_scene() + frame);
  size_t common = 0;
  for (const auto& [key, row] : twin) common += clipmap.contains(key);
  EXPECT_GE(double(common), 0.97 * double(twin.size()));
}

TEST_F(CliClipmap, AFlightReadsLittle) {
  SWARD_NEEDS_GL();
  cli::write_file(inputs() / "flight.csv",
                  "time,x,y,z,yaw,pitch\n0,0,0,40,90,-20\n0.1,0.6,0,40,90,-20\n0.2,1.2,0,40,90,-20\n");
  ASSERT_EQ(run("fly " + clipmap_scene() + " --flight " + (inputs() / "flight.csv").string() +
                " --fps 10 --size 64x36 --samples 1 --csv f.csv")
                .status,
            0);
  const auto rows = cli::read_csv(folder() / "f.csv");
  const auto at = size_t(std::find(rows[0].begin(), rows[0].end(), "clipmap_points") - rows[0].begin());
  ASSERT_LT(at, rows[0].size());
  ASSERT_EQ(rows.size(), 4u);
  for (size_t i = 1; i < rows.size(); ++i) EXPECT_LT(std::stod(rows[i][at]), 2500) << i;
}

}  // namespace
