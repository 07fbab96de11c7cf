// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Baking and opening: what is written answers as what it was made of; bakes that are cut off go on; nothing half-baked
// or damaged is taken for good.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "world_support.h"

namespace {

using namespace world_support;
namespace fs = std::filesystem;

class WorldBake : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("sward_world_" + std::to_string(getpid()) + "_" +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    heights_ = make_heights(make_desc({3, 2}, 5, 2));
  }
  void TearDown() override { fs::remove_all(folder_); }

  sward::Expected<sward::BakeStats> bake(const sward::ReadHeights& read, const std::string& source = "test") {
    return sward::bake_world(folder_.string(), {heights_.desc, source, 1}, read);
  }
  sward::Expected<sward::BakeStats> bake() { return bake(heights_.reader()); }

  fs::path index() const { return folder_ / "world.index"; }
  fs::path square(int column, int row) const {
    return folder_ / ("r000" + std::to_string(row)) / ("c000" + std::to_string(column) + ".square");
  }
  size_t files_ending(const std::string& end) const {
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) count += entry.path().string().ends_with(end);
    return count;
  }
  static std::string read_all(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void write_all(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }
  static void flip(const fs::path& path, size_t at) {
    std::string bytes = read_all(path);
    bytes.at(at) = char(bytes[at] ^ 1);
    write_all(path, bytes);
  }
  std::string open_error() const {
    const auto world = sward::World::open(folder_.string(), roomy());
    return world ? std::string() : world.error().message;
  }

  fs::path folder_;
  Heights heights_;
};

TEST_F(WorldBake, WhatIsOpenedIsWhatWasBaked) {
  heights_.holes.assign(heights_.samples.size(), 0);
  for (size_t i = 0; i < heights_.holes.size(); i += 5) heights_.holes[i] = i % 97 > 50;
  const auto stats = bake();
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->baked, 6u);
  EXPECT_EQ(stats->skipped, 0u);
  EXPECT_GT(stats->holes, 50u);
  uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) bytes += entry.file_size();
  EXPECT_EQ(stats->bytes, bytes);
  EXPECT_EQ(files_ending(".part"), 0u);

  const auto reference = make_world(heights_, loader_of(heights_), roomy());
  settle(*reference, view_over(*reference));
  for (const bool mapped : {false, true}) {
    sward::WorldOptions options = roomy();
    options.map_files = mapped;
    auto world = sward::World::open(folder_.string(), options);
    ASSERT_TRUE(world) << world.error().message;
    EXPECT_EQ((*world)->desc().scale, heights_.desc.scale);
    EXPECT_EQ((*world)->stats().resident, 0u);
    settle(**world, view_over(**world));
    ASSERT_EQ((*world)->stats().resident, 6u) << (*world)->stats().last_error;
    for (const auto& [key, parents] : all_diamonds((*world)->lattice())) {
      const sward::LatticePoint centre(key.second.first, key.second.second);
      ASSERT_EQ((*world)->bound(centre, key.first), reference->bound(centre, key.first));
      ASSERT_EQ((*world)->height(centre), reference->height(centre));
      ASSERT_EQ((*world)->all_holes({centre, centre}), reference->all_holes({centre, centre}));
    }
  }
}

TEST_F(WorldBake, FloatsToo) {
  heights_.desc.floats = true;
  for (float& sample : heights_.samples) sample *= -0.123f;
  ASSERT_TRUE(bake());
  auto world = sward::World::open(folder_.string(), roomy()).value();
  settle(*world, view_over(*world));
  const int step = world->lattice().sample_step();
  for (int row = 0; row < heights_.desc.rows; ++row)
    for (int column = 0; column < heights_.desc.columns; ++column)
      ASSERT_EQ(world->height(sward::LatticePoint(column, row) * step), double(heights_.at(column, row)) * 0.01);
}

TEST_F(WorldBake, GoesOnWhereItWasCutOff) {
  int reads = 0;
  const auto failing = [&](const sward::SampleBox& box, std::span<float> heights,
                           std::span<uint8_t> holes) -> sward::Expected<void> {
    if (++reads == 4) return sward::fail("unreadable");
    return heights_.reader()(box, heights, holes);
  };
  const auto cut = bake(failing);
  ASSERT_FALSE(cut);
  EXPECT_NE(cut.error().message.find("square (0, 1): unreadable"), std::string::npos) << cut.error().message;
  EXPECT_NE(open_error().find("world.index"), std::string::npos) << open_error();
  EXPECT_EQ(files_ending(".square"), 3u);

  // One of the finished squares is damaged meanwhile, and a temporary was left.
  flip(square(1, 0), 500);
  write_all(folder_ / "r0000" / "c0002.square.1.1.part", "half");
  const auto rest = bake();
  ASSERT_TRUE(rest) << rest.error().message;
  EXPECT_EQ(rest->skipped, 2u);
  EXPECT_EQ(rest->baked, 4u);
  EXPECT_EQ(files_ending(".part"), 0u);
  EXPECT_EQ(open_error(), "");
  const std::string resumed = read_all(index());

  const auto again = bake();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->skipped, 6u);
  fs::remove_all(folder_);
  ASSERT_TRUE(bake());
  EXPECT_EQ(read_all(index()), resumed);
}

TEST_F(WorldBake, OtherSourcesAreNotMixed) {
  ASSERT_TRUE(bake());
  const auto other = bake(heights_.reader(), "another");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("holds another world"), std::string::npos);
  EXPECT_EQ(open_error(), "");
  // Squares without an index belong to no world yet: those of another source are baked anew.
  fs::remove(index());
  const auto anew = bake(heights_.reader(), "another");
  ASSERT_TRUE(anew);
  EXPECT_EQ(anew->skipped, 0u);
}

TEST_F(WorldBake, FullDiskLeavesNothingHalf) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto full = bake();
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("cannot write"), std::string::npos) << full.error().message;
  EXPECT_NE(full.error().message.find("bake again to go on"), std::string::npos) << full.error().message;
  EXPECT_EQ(files_ending(".part") + files_ending(".square"), 0u);
  EXPECT_NE(open_error(), "");
  EXPECT_TRUE(bake());
}

TEST_F(WorldBake, FolderThatCannotBe) {
  write_all(folder_, "a file");
  const auto done = bake();
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find(folder_.string()), std::string::npos);
}

TEST_F(WorldBake, DamagedIndexIsRefused) {
  ASSERT_TRUE(bake());
  const std::string good = read_all(index());
  const auto expect = [&](const std::string& bytes, const char* part) {
    write_all(index(), bytes);
    EXPECT_NE(open_error().find(part), std::string::npos) << open_error();
    EXPECT_NE(open_error().find(index().string()), std::string::npos) << open_error();
  };
  for (const size_t at : {size_t(9), size_t(20), size_t(100), size_t(140), good.size() / 2, good.size() - 1}) {
    std::string bad = good;
    bad[at] = char(bad[at] ^ 4);
    expect(bad, "damaged");
  }
  std::string version = good;
  version[7] = 2;
  expect(version, "another version");
  expect("", "truncated");
  expect(good.substr(0, 100), "truncated");
  expect(good.substr(0, good.size() - 1), "truncated");
  expect(good + "x", "longer");
  fs::remove(index());
  EXPECT_NE(open_error().find("sward bake"), std::string::npos);
  fs::create_directory(index());
  EXPECT_NE(open_error().find("no ordinary file"), std::string::npos);
}

// A square that cannot be read is reported, and the rest of the world goes on.
TEST_F(WorldBake, DamagedSquaresStayCoarse) {
  ASSERT_TRUE(bake());
  const fs::path file = square(1, 1);
  const std::string good = read_all(file), other = read_all(square(0, 0));
  const auto error_with = [&](bool mapped) {
    sward::WorldOptions options = roomy();
    options.map_files = mapped;
    auto world = sward::World::open(folder_.string(), options).value();
    settle(*world, view_over(*world));
    const sward::WorldStats stats = world->stats();
    EXPECT_EQ(stats.resident, 5u);
    EXPECT_EQ(stats.failures, 1u);
    EXPECT_EQ(stats.failing, 1u);
    EXPECT_FALSE(world->resident({1, 1}));
    EXPECT_NE(stats.last_error.find("square (1, 1)"), std::string::npos);
    return stats.last_error;
  };
  const auto expect = [&](const std::string& bytes, const char* part) {
    write_all(file, bytes);
    for (const bool mapped : {false, true})
      EXPECT_NE(error_with(mapped).find(part), std::string::npos) << error_with(mapped);
  };
  for (const size_t at : {size_t(9), size_t(30), size_t(80), good.size() / 2, good.size() - 1}) {
    std::string bad = good;
    bad[at] = char(bad[at] ^ 16);
    expect(bad, "damaged");
  }
  std::string version = good;
  version[7] = 9;
  expect(version, "another version");
  expect("", "truncated");
  expect(good.substr(0, 50), "truncated");
  expect(good.substr(0, good.size() / 2), "truncated");
  expect(good + "xx", "longer");
  expect(other, "another world");
  fs::remove(file);
  EXPECT_NE(error_with(false).find("cannot open"), std::string::npos);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_NE(error_with(false).find("no ordinary file"), std::string::npos);
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_NE(error_with(true).find("no ordinary file"), std::string::npos);
}

// A square that is sound, of the same bake settings, but not the one that the index was written for.
TEST_F(WorldBake, ExchangedSquareIsRefused) {
  ASSERT_TRUE(bake());
  const std::string index_bytes = read_all(index());
  fs::remove_all(folder_);
  heights_.samples[3] += 1;
  ASSERT_TRUE(bake());
  write_all(index(), index_bytes);
  auto world = sward::World::open(folder_.string(), roomy()).value();
  settle(*world, view_over(*world));
  EXPECT_EQ(world->stats().resident, 5u);
  EXPECT_NE(world->stats().last_error.find("not the one that the world's index"), std::string::npos);
}

TEST_F(WorldBake, ProgressEndsAtOne) {
  std::vector<float> seen;
  ASSERT_TRUE(sward::bake_world(folder_.string(), {heights_.desc, "", 1}, heights_.reader(),
                                [&](float done) { seen.push_back(done); }));
  ASSERT_GE(seen.size(), 6u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0f);
}

}  // namespace
