// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Runs the command-line tool as a user would, in an empty folder with a small height map beside it.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace cli {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (!text.empty() && text.back() == separator && separator != '\n') parts.emplace_back();
  return parts;
}

/// A CSV file's cells by row; row 0 is the header.
inline std::vector<std::vector<std::string>> read_csv(const fs::path& path) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(read_file(path), '\n')) rows.push_back(split(line, ','));
  return rows;
}

// The map: not square, and no power of two.
constexpr int k_columns = 129, k_rows = 97;
constexpr double k_spacing = 4.0, k_scale = 0.01;

/// Raw units of the height map, as it is written.
inline int raw_height(int column, int row) {
  return int(
      std::lround(3000 + 900 * std::sin(column * 0.09) * std::cos(row * 0.11) + 60 * std::sin(column * 0.7 + row)));
}
inline double sample_x(int column) {
  return (column - (k_columns - 1) / 2.0) * k_spacing;
}
inline double sample_y(int row) {
  return ((k_rows - 1) / 2.0 - row) * k_spacing;
}

inline std::string height_map() {
  std::string bytes = "P5\n" + std::to_string(k_columns) + " " + std::to_string(k_rows) + "\n65535\n";
  for (int row = 0; row < k_rows; ++row)
    for (int column = 0; column < k_columns; ++column) {
      bytes += char(raw_height(column, row) >> 8);
      bytes += char(raw_height(column, row) & 255);
    }
  return bytes;
}

struct Result {
  int status = -1;
  std::string out, err;
};

/// A folder `inputs` with small.toml and small.pgm, and an empty folder that the tool runs in.
class CliTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    base_ = fs::path(testing::TempDir()) / ("sward_cli_" + name + "_" + std::to_string(getpid()));
    fs::remove_all(base_);
    fs::create_directories(inputs());
    fs::create_directories(folder());
#ifdef SWARD_IMAGE_IO
    write_file(inputs() / "small.pgm", height_map());
    const std::string terrain = "height = \"small.pgm\"\nspacing_m = 4.0\nheight_scale_m = 0.01\n";
#else
    const std::string terrain = "generator = \"meadow\"\nsamples = 129\nsize_m = 512.0\n";
#endif
    write_file(inputs() / "small.toml", "name = \"small\"\n[terrain]\n" + terrain +
                                            "max_triangles = 1500\n"
                                            "[[layer]]\nname = \"grass\"\nhorizon_m = 40.0\ndensity = 60.0\n"
                                            "[[layer.species]]\nname = \"grass\"\nhsv = [77.0, 0.46, 0.43]\n"
                                            "[[layer.species]]\nname = \"straw\"\nhsv = [50.0, 0.42, 0.5]\n");
  }
  void TearDown() override {
    fs::remove_all(base_);
  }

  fs::path inputs() const {
    return base_ / "inputs";
  }
  /// Where the tool runs.
  fs::path folder() const {
    return base_ / "work";
  }
  std::string scene() const {
    return (inputs() / "small.toml").string();
  }

  std::vector<std::string> files_in_folder() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder())) names.push_back(entry.path().filename().string());
    return names;
  }

  /// Runs `sward ARGUMENTS`, through the shell.
  Result run(const std::string& arguments, const std::string& environment = "") const {
    const std::string out = (base_ / "stdout").string(), err = (base_ / "stderr").string();
    const int status = std::system(("cd '" + folder().string() + "' && " + environment + " '" SWARD_TOOL "' " +
                                    arguments + " > '" + out + "' 2> '" + err + "' < /dev/null")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out), read_file(err)};
  }

  /// One line on stderr that begins as every error does, and the status.
  static void expect_error(const Result& result, int status) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.err.rfind("sward: error: ", 0), 0u) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
  }

 private:
  fs::path base_;
};

inline bool no_gl(const Result& info) {
  return info.status != 0;
}

}  // namespace cli

/// Skips the test, saying why, where no GL context can be made.
#define SWARD_NEEDS_GL()                                        \
  if (const cli::Result info = run("info"); cli::no_gl(info)) { \
    GTEST_SKIP() << "no GL context here: " << info.err;         \
  }                                                             \
  static_assert(true)
