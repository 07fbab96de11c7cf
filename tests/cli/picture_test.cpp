// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// render, fly and info: what they write.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "cli_support.h"

namespace {

// Of CONTRACT's list; a scene may have more.
const char* const k_figures[] = {
    "plants",          "clusters_submitted", "clusters_fertile", "fixed_triangles", "triangles_visible",
    "triangles_drawn", "grow_fragments",     "bound_px",         "cpu_roam_ms",     "cpu_seeding_ms",
    "gpu_terrain_ms",  "gpu_classify_ms",    "gpu_grow_ms",      "frame_ms",        "peak_rss_mb"};
const std::set<std::string> k_gpu_times{"gpu_terrain_ms", "gpu_classify_ms", "gpu_grow_ms"};

class CliPictures : public cli::CliTest {
 protected:
  static bool software(const nlohmann::json& json) {
    return json.at("gl_renderer").get<std::string>().find("llvmpipe") != std::string::npos;
  }
  // Low over the field's middle, looking at its plants.
  std::string camera() const { return " --camera 0,0,+1.7,90,-15 "; }
  void expect_figures_of_the_paper(bool software);
};

TEST_F(CliPictures, TheSameTwice) {
  SWARD_NEEDS_GL();
  for (const char* name : {"a.ppm", "b.ppm"})
    ASSERT_EQ(run("render " + scene() + camera() + "--size 160x90 -o " + name).status, 0);
  const std::string first = cli::read_file(folder() / "a.ppm");
  EXPECT_EQ(first.rfind("P6\n160 90\n255\n", 0), 0u);
  EXPECT_EQ(first.size(), 14u + 160 * 90 * 3);
  EXPECT_TRUE(first == cli::read_file(folder() / "b.ppm"));
  // Pictures that are all one colour would be the same too.
  std::set<std::string> colors;
  for (size_t i = 14; i < first.size(); i += 3) colors.insert(first.substr(i, 3));
  EXPECT_GT(colors.size(), 500u);
}

#ifdef SWARD_IMAGE_IO
TEST_F(CliPictures, PngTheSameTwice) {
  SWARD_NEEDS_GL();
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(run("render " + scene() + camera() + "--size 96x64 -o " + name).status, 0);
  const std::string first = cli::read_file(folder() / "a.png");
  EXPECT_EQ(first.substr(1, 3), "PNG");
  EXPECT_TRUE(first == cli::read_file(folder() / "b.png"));
}
#endif

TEST_F(CliPictures, OptionsChangeThePicture) {
  SWARD_NEEDS_GL();
  const std::string base = "render " + scene() + " --size 96x64 --samples 1 ";
  std::set<std::string> pictures;
  const std::string variants[] = {camera(), camera() + "--sun 10,60", camera() + "--no-plants",
                                  " --camera 0,0,+1.7,90,-30 ", " --camera 0,0,+9.5,90,-15 "};
  for (const std::string& options : variants) {
    ASSERT_EQ(run(base + options + " -o a.ppm").status, 0) << options;
    pictures.insert(cli::read_file(folder() / "a.ppm"));
  }
  EXPECT_EQ(pictures.size(), std::size(variants));
}

// The cells of a contact sheet of a camera that stands, where nothing moves, are the picture that render makes.
// The rest of the scene is drawn, and what is wrong is said.
TEST_F(CliPictures, AKindThatDoesNotCompileIsLeftOut) {
  SWARD_NEEDS_GL();
  const std::string reeds = (inputs() / "reeds.toml").string();
  cli::write_file(inputs() / "reed.glsl", "#include \"common_shoot.glsl\"\nint two = three;\n");
  cli::write_file(reeds, cli::read_file(scene()) +
                             "[[layer]]\nname = \"reeds\"\nhorizon_m = 10.0\ndensity = 5.0\n"
                             "[[layer.species]]\nname = \"reed\"\nkind = \"custom\"\nhsv = [77.0, 0.46, 0.43]\n"
                             "custom = { functions = \"reed.glsl\", shoots = 6 }\n");
  const std::string with = camera() + "--samples 1 --size 96x64 ";
  ASSERT_EQ(run("render " + scene() + with + "-o without.ppm").status, 0);
  const cli::Result result = run("render " + reeds + with + "-o with.ppm");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("sward: warning: layer 'reeds': species 'reed'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("reed.glsl:2"), std::string::npos) << result.err;
  EXPECT_TRUE(cli::read_file(folder() / "with.ppm") == cli::read_file(folder() / "without.ppm"));
}

TEST_F(CliPictures, ContactSheetsHoldFramesSideBySide) {
  SWARD_NEEDS_GL();
  ASSERT_EQ(run("render " + scene() + camera() + "--size 64x48 --samples 1 -o a.ppm").status, 0);
  ASSERT_EQ(run("fly " + scene() + camera() +
                "--flight still --seconds 1 --fps 5 --size 64x48 --samples 1 --sheet sheet.ppm --sheet-frames 3")
                .status,
            0);
  const std::string picture = cli::read_file(folder() / "a.ppm"), sheet = cli::read_file(folder() / "sheet.ppm");
  ASSERT_EQ(sheet.rfind("P6\n131 99\n255\n", 0), 0u) << "two by two, three pixels between them";
  const std::string row = picture.substr(13 + 20 * 64 * 3, 64 * 3);
  EXPECT_EQ(sheet.substr(14 + (20 * 131 + 67) * 3, 64 * 3), row);
  EXPECT_EQ(sheet.substr(14 + (20 + 51) * 131 * 3, 64 * 3), row);
  EXPECT_EQ(sheet.substr(14 + ((20 + 51) * 131 + 67) * 3, 64 * 3), std::string(64 * 3, char(24)))
      << "the fourth is none";
  EXPECT_NE(run("plants " + scene() + " --flight still --at 0 -o p.csv").status, 0);
}

TEST_F(CliPictures, StatsAreFlatAndComplete) {
  SWARD_NEEDS_GL();
  ASSERT_EQ(run("render " + scene() + camera() + "--size 96x64 --samples 1 -o a.ppm --stats a.json").status, 0);
  const auto json = nlohmann::json::parse(cli::read_file(folder() / "a.json"));
  for (const char* name : k_figures) {
    ASSERT_TRUE(json.contains(name)) << name;
    const bool unknown = software(json) && k_gpu_times.count(name) != 0;
    EXPECT_TRUE(unknown ? json[name].is_null() : json[name].is_number()) << name;
  }
  EXPECT_GT(json["plants"], 100);
  EXPECT_GE(json["clusters_submitted"], json["clusters_fertile"]);
  EXPECT_GT(json["clusters_fertile"], 0);
  EXPECT_LE(json["triangles_visible"], 1500);
  EXPECT_GT(json["triangles_drawn"], json["triangles_visible"]);
  EXPECT_GT(json["peak_rss_mb"], 1);
}

// Of a flight of fifteen frames, two seconds apart, in the folder.
void CliPictures::expect_figures_of_the_paper(bool software) {
  const auto column = [this](const char* file, const char* name) {
    const auto rows = cli::read_csv(folder() / file);
    EXPECT_EQ(rows.size(), 16u) << file;
    std::vector<double> values;
    const auto at = size_t(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    EXPECT_LT(at, rows[0].size()) << file << " " << name;
    for (size_t i = 1; i < rows.size() && at < rows[0].size(); ++i) values.push_back(std::stod(rows[i][at]));
    return values;
  };
  EXPECT_EQ(column("figure7.csv", "second"), column("figure8.csv", "second"));
  EXPECT_EQ(column("figure7.csv", "second").back(), 28);
  const auto with = column("figure7.csv", "frame_ms"), without = column("figure7.csv", "without_vegetation_ms");
  EXPECT_GT(with[7], without[7]) << "many plants are drawn in the middle";
  const auto submitted = column("figure8.csv", "clusters_submitted"), bare = column("figure8.csv", "clusters_bare"),
             fertile = column("figure8.csv", "clusters_fertile"),
             triangles = column("figure8.csv", "plant_triangles_in_hundreds");
  for (size_t i = 0; i < submitted.size(); ++i) EXPECT_EQ(submitted[i], bare[i] + fertile[i]) << i;
  EXPECT_GT(fertile[7], 0);
  EXPECT_GT(triangles[7], 0);
  EXPECT_EQ(std::filesystem::exists(folder() / "figure9.csv"), !software);
  if (software) return;
  for (const char* name :
       {"clusters_of_1_ms", "clusters_of_2_ms", "clusters_of_4_ms", "clusters_of_8_ms", "clusters_of_16_ms"})
    EXPECT_GT(column("figure9.csv", name)[7], 0) << name;
}

TEST_F(CliPictures, FlightsAreMeasured) {
  SWARD_NEEDS_GL();
  const cli::Result result =
      run("fly " + scene() + " --fps 0.5 --size 64x36 --samples max --csv f.csv --summary f.json --plots .");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(cli::read_file(folder() / "f.json"));
  EXPECT_EQ(json["frames"], 15);
  const auto rows = cli::read_csv(folder() / "f.csv");
  ASSERT_EQ(rows.size(), 16u);
  for (const char* name : k_figures) {
    const auto column = std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin();
    ASSERT_LT(size_t(column), rows[0].size()) << name;
    if (software(json) && k_gpu_times.count(name) != 0) {
      EXPECT_TRUE(json[name].is_null()) << name;
      EXPECT_EQ(rows[1][size_t(column)], "") << name;
      continue;
    }
    // The summary against the rows: the mean, and the middle of fifteen.
    std::vector<double> values;
    double sum = 0;
    for (size_t i = 1; i < rows.size(); ++i) {
      ASSERT_EQ(rows[i].size(), rows[0].size());
      values.push_back(std::stod(rows[i][size_t(column)]));
      sum += values.back();
    }
    std::sort(values.begin(), values.end());
    EXPECT_NEAR(json[name]["mean"], sum / 15, 1e-9 * std::abs(sum)) << name;
    EXPECT_DOUBLE_EQ(json[name]["median"], values[7]) << name;
    EXPECT_DOUBLE_EQ(json[name]["max"], values[14]) << name;
    // Rank 0.95 * 14 = 13.3 of the sorted values.
    EXPECT_NEAR(json[name]["p95"], values[13] + 0.3 * (values[14] - values[13]), 1e-9 * std::abs(sum)) << name;
  }
  // High at both ends, where no plant is drawn, low in the middle, where many are.
  const auto plants = std::find(rows[0].begin(), rows[0].end(), "plants") - rows[0].begin();
  EXPECT_EQ(rows[1][size_t(plants)], "0");
  EXPECT_GT(std::stoi(rows[8][size_t(plants)]), 100);
  for (const char* name : {"times.svg", "plants.svg", "triangles.svg", "bound.svg"}) {
    const std::string svg = cli::read_file(folder() / name);
    EXPECT_EQ(svg.rfind("<svg", 0), 0u) << name;
    EXPECT_NE(svg.find("<polyline"), std::string::npos) << name;
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
  }
  expect_figures_of_the_paper(software(json));
  if (software(json)) {
    EXPECT_NE(result.err.find("figure 9 is left out"), std::string::npos) << result.err;
  }
}

class CliVideo : public CliPictures {
 protected:
  // A stand-in for ffmpeg that keeps its input under the last argument's name.
  cli::Result fly_with(const std::string& script) {
    const cli::fs::path ffmpeg = inputs() / "ffmpeg";
    cli::write_file(ffmpeg, "#!/bin/sh\n" + script);
    cli::fs::permissions(ffmpeg, cli::fs::perms::owner_all);
    return run("fly " + scene() + " --fps 0.1 --size 32x18 --samples 1 --video v.mp4",
               "PATH='" + inputs().string() + "':/usr/bin:/bin");
  }
};

TEST_F(CliVideo, FramesReachFfmpeg) {
  SWARD_NEEDS_GL();
  const cli::Result result = fly_with("for last; do :; done; exec cat > \"$last\"\n");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(files_in_folder(), std::vector<std::string>{"v.mp4"});
  EXPECT_EQ(cli::fs::file_size(folder() / "v.mp4"), 3u * 32 * 18 * 3);
}

TEST_F(CliVideo, AFailingFfmpegLeavesNothing) {
  SWARD_NEEDS_GL();
  expect_error(fly_with("for last; do :; done; head -c 10 > \"$last\"; cat > /dev/null; exit 1\n"), 1);
  EXPECT_TRUE(files_in_folder().empty());
  expect_error(fly_with("exit 1\n"), 1);
  EXPECT_TRUE(files_in_folder().empty());
}

TEST_F(CliVideo, NoFfmpeg) {
  const cli::Result result = run("fly " + scene() + " --video v.mp4", "PATH=/nowhere");
  expect_error(result, 1);
  EXPECT_NE(result.err.find("ffmpeg"), std::string::npos);
}

TEST_F(CliPictures, InfoNamesTheDriver) {
  SWARD_NEEDS_GL();
  const cli::Result result = run("info");
  for (const char* part : {"GL vendor", "GL version", "samples", "missing"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
}

}  // namespace
