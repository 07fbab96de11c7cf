// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// bake: a world from one height map or many, gone on with after a cut, never half. mesh --world: the mesh over it.

#include <algorithm>

#include "cli_support.h"

namespace {

namespace fs = std::filesystem;

class CliBake : public cli::CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
#ifndef SWARD_IMAGE_IO
    GTEST_SKIP() << "this build reads no height maps";
#endif
  }
  std::string map() const {
    return "'" + (inputs() / "small.pgm").string() + "'";
  }
  size_t files_under(const fs::path& path, const std::string& ending) const {
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path)) count += entry.path().string().ends_with(ending);
    return count;
  }
  // Part of the map as a map of its own.
  void write_part(const std::string& name, int first_column, int first_row, int columns, int rows) const {
    std::string bytes = "P5\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n65535\n";
    for (int row = first_row; row < first_row + rows; ++row)
      for (int column = first_column; column < first_column + columns; ++column) {
        bytes += char(cli::raw_height(column, row) >> 8);
        bytes += char(cli::raw_height(column, row) & 255);
      }
    cli::write_file(inputs() / name, bytes);
  }
  std::string payload(const fs::path& path) const {
    const std::string bytes = cli::read_file(path);
    return bytes.size() < 72 ? std::string() : bytes.substr(72);
  }
};

TEST_F(CliBake, OneMap) {
  const cli::Result result = run("bake " + map() + " -o world --square 33 --spacing 4 --height-scale 0.01");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("4 x 3 squares of 33 samples: 12 baked, 0 were there"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(files_under(folder() / "world", ".square"), 12u);
  EXPECT_EQ(files_under(folder() / "world", "world.index"), 1u);
  EXPECT_EQ(files_under(folder() / "world", ".part"), 0u);
}

TEST_F(CliBake, GoesOnAfterACut) {
  const std::string bake = "bake " + map() + " -o world --square 33 --spacing 4 --height-scale 0.01";
  // Files may not grow beyond a square's size: the index is larger, and is not written.
  const cli::Result full = run(bake, "trap '' XFSZ; ulimit -f 10;");
  expect_error(full, 1);
  EXPECT_NE(full.err.find("world.index"), std::string::npos) << full.err;
  EXPECT_EQ(files_under(folder() / "world", ".square"), 12u);
  EXPECT_EQ(files_under(folder() / "world", ".part") + files_under(folder() / "world", "world.index"), 0u);
  fs::remove(folder() / "world" / "r0001" / "c0002.square");
  const cli::Result rest = run(bake);
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.out.find("1 baked, 11 were there"), std::string::npos) << rest.out;
}

TEST_F(CliBake, ManyMapsAreAsOne) {
  ASSERT_EQ(run("bake " + map() + " -o one --square 33 --spacing 4").status, 0);
  // 129 x 97 as two by two maps that share one sample.
  write_part("a.pgm", 0, 0, 65, 49);
  write_part("b.pgm", 64, 0, 65, 49);
  write_part("c.pgm", 0, 48, 65, 49);
  write_part("d.pgm", 64, 48, 65, 49);
  std::string parts;
  for (const char* name : {"a.pgm", "b.pgm", "c.pgm", "d.pgm"}) parts += " '" + (inputs() / name).string() + "'";
  const cli::Result many = run("bake" + parts + " --images-a-row 2 --overlap 1 -o many --square 33 --spacing 4");
  ASSERT_EQ(many.status, 0) << many.err;
  for (const char* square : {"r0000/c0000.square", "r0001/c0001.square", "r0001/c0002.square", "r0002/c0003.square"}) {
    ASSERT_GT(payload(folder() / "one" / square).size(), 4000u);
    EXPECT_EQ(payload(folder() / "one" / square), payload(folder() / "many" / square)) << square;
  }
  const cli::Result short_row = run("bake" + parts + " --images-a-row 3 -o other");
  expect_error(short_row, 1);
  write_part("d.pgm", 64, 48, 60, 49);
  const cli::Result other_size = run("bake" + parts + " --images-a-row 2 --overlap 1 -o other --square 33");
  expect_error(other_size, 1);
  EXPECT_NE(other_size.err.find("d.pgm has 60 x 49"), std::string::npos) << other_size.err;
}

TEST_F(CliBake, AnotherWorldIsNotOverwritten) {
  ASSERT_EQ(run("bake " + map() + " -o world --square 33").status, 0);
  const cli::Result other = run("bake " + map() + " -o world --square 33 --height-scale 2");
  expect_error(other, 1);
  EXPECT_NE(other.err.find("holds another world"), std::string::npos) << other.err;
}

struct BadBake {
  const char* name;
  const char* arguments;  ///< MAP stands for the map.
  int status;
  const char* message;
};

class CliBadBake : public CliBake, public testing::WithParamInterface<BadBake> {};

TEST_P(CliBadBake, OneLineAndNothingLeft) {
  std::string arguments = GetParam().arguments;
  for (size_t at = arguments.find("MAP"); at != std::string::npos; at = arguments.find("MAP"))
    arguments.replace(at, 3, map());
  const cli::Result result = run(arguments);
  expect_error(result, GetParam().status);
  EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
  EXPECT_TRUE(files_in_folder().empty()) << files_in_folder().front();
}

const BadBake k_bad[] = {
    {"NoInput", "bake -o world", 2, "inputs"},
    {"NoOutput", "bake MAP", 2, "--output"},
    {"SquareIsNoNumber", "bake MAP -o world --square big", 2, "--square"},
    {"SquareIsNoPower", "bake MAP -o world --square 100", 1, "--square"},
    {"MissingMap", "bake none.pgm -o world", 1, "none.pgm"},
    {"OverlapTooLarge", "bake MAP -o world --overlap 97", 1, "cannot share 97"},
    {"NegativeOverlap", "bake MAP -o world --overlap -1", 1, "cannot share -1"},
    {"NoRow", "bake MAP -o world --images-a-row 0", 1, "--images-a-row"},
    {"NoSpacing", "bake MAP -o world --spacing 0", 1, "spacing"},
    {"MissingWorld", "mesh --world none --flight MAP", 1, "sward bake"},
    {"WorldAndHeight", "mesh --height MAP --world none --flight MAP", 1, "contradict"},
    {"WaitWithoutWorld", "mesh --wait", 1, "--world"},
    {"NoScale", "bake MAP -o world --height-scale 0", 1, "scale"},
};

INSTANTIATE_TEST_SUITE_P(Kinds, CliBadBake, testing::ValuesIn(k_bad),
                         [](const auto& each) { return std::string(each.param.name); });

// A flight of three frames over the middle.
std::string flight() {
  std::string csv = "time,x,y,z,yaw,pitch\n";
  for (int i = 0; i < 3; ++i) csv += std::to_string(i) + "," + std::to_string(i * 20) + ",0,120,30,-30\n";
  return csv;
}

TEST_F(CliBake, MeshOverAWorld) {
  ASSERT_EQ(run("bake " + map() + " -o world --square 33 --spacing 4 --height-scale 0.01").status, 0);
  cli::write_file(inputs() / "flight.csv", flight());
  const std::string path = " --flight '" + (inputs() / "flight.csv").string() + "' --triangles 1500";
  const cli::Result world = run("mesh --world world --wait" + path + " --timings t.csv --at 2 -o world.ply");
  ASSERT_EQ(world.status, 0) << world.err;
  const auto rows = cli::read_csv(folder() / "t.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0],
            cli::split("frame,poll_ms,update_ms,visible,splits,merges,bound_px,resident,loads,drops,memory_mb", ','));
  EXPECT_GT(std::stod(rows[3][7]), 3);
  EXPECT_GT(cli::read_file(folder() / "world.ply").size(), 1000u);
  const cli::Result capped = run("mesh --world world --memory 0.01" + path);
  expect_error(capped, 1);
  EXPECT_NE(capped.err.find("raise it to at least"), std::string::npos) << capped.err;
  cli::write_file(folder() / "world" / "r0001" / "c0001.square", "damaged");
  const cli::Result damaged = run("mesh --world world --wait" + path);
  EXPECT_EQ(damaged.status, 0) << damaged.err;
  EXPECT_NE(damaged.out.find("square (1, 1)"), std::string::npos) << damaged.out;
}

}  // namespace
