// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/bounds.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

#include "unit/field_reference.h"
#if defined(SWARD_IMAGE_IO)
#include <sward/image_io/image_io.h>
#endif

using namespace field_reference;
using sward::Bounds;
using sward::HeightFieldDesc;

namespace {

namespace fs = std::filesystem;

HeightFieldDesc describe(int columns, int rows, bool relief, glm::dvec2 spacing = {4.0, 6.0}) {
  HeightFieldDesc desc;
  desc.columns = columns;
  desc.rows = rows;
  desc.spacing = spacing;
  desc.relief.enabled = relief;
  return desc;
}

HeightField make(const HeightFieldDesc& desc, HeightField::Samples samples, std::span<const uint8_t> holes = {}) {
  auto field = HeightField::create(desc, std::move(samples), holes);
  if (!field) throw std::runtime_error(field.error().message);
  return std::move(*field);
}

HeightField rough(int columns, int rows, bool relief = false) {
  return make(describe(columns, rows, relief), rough_heights(columns, rows, 21));
}

// Rough ground with a lake of holes, scattered ones and one across the edge.
HeightField with_holes(int columns, int rows, bool relief) {
  std::vector<uint8_t> holes(size_t(columns) * size_t(rows), 0);
  std::mt19937 random(2);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool lake = std::hypot(column - columns / 3, row - rows / 2) < rows / 5.0 || column + row < 12;
      if (lake || random() % 50 == 0) holes[size_t(row) * size_t(columns) + size_t(column)] = 1;
    }
  }
  return make(describe(columns, rows, relief), rough_heights(columns, rows, 21), holes);
}

// Rounding of heights in double.
constexpr double k_rounding = 1e-6;

// Every triangle of coarse levels, random ones of all levels, against every sample in them.
void check_samples(const HeightField& field, const Bounds& bounds, int per_level) {
  std::mt19937 random(31);
  int64_t checked = 0;
  const auto check = [&](const Triangle& t) {
    const double error = largest_sample_error(field, t);
    if (error < 0.0) return;
    ASSERT_LE(error, double(bounds.bound(t.middle(), t.level)) + k_rounding) << "level " << t.level;
    ++checked;
  };
  for (int level = 0; level < field.data_level(); ++level) {
    if (level <= 5) {
      all_triangles(field, level, check);
      continue;
    }
    for (int i = 0; i < per_level && !testing::Test::HasFatalFailure(); ++i) {
      check(random_triangle(field, level, random));
    }
  }
  EXPECT_GT(checked, 10 * per_level / 4);
}

// Every triangle of every level: only for small fields.
void check_all_samples(const HeightField& field) {
  const Bounds bounds = Bounds::create(field);
  for (int level = 0; level <= field.data_level(); ++level) {
    all_triangles(field, level, [&](const Triangle& t) {
      const double error = largest_sample_error(field, t);
      ASSERT_LE(error, double(bounds.bound(t.middle(), level)) + k_rounding) << "level " << level;
    });
  }
}

TEST(BoundsFormat, EncodesEveryCodeToItself) {
  float before = -1.0f;
  for (int code = 0; code <= 0xfffe; ++code) {
    const float metres = Bounds::decode(uint16_t(code));
    ASSERT_GT(metres, before);
    ASSERT_EQ(Bounds::encode_up(metres), code);
    before = metres;
  }
  // The largest is just below 2^19 m.
  EXPECT_GT(before, 524000.0f);
}

TEST(BoundsFormat, RoundsUpByLittle) {
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    const float metres = float(std::ldexp(1.0 + double(random() % 100000) / 100000.0, int(random() % 39) - 21));
    const float decoded = Bounds::decode(Bounds::encode_up(metres));
    ASSERT_GE(decoded, metres);
    ASSERT_LE(double(decoded), double(metres) * (1.0 + 1.0 / 2048.0) + std::ldexp(1.0, -23));
  }
  EXPECT_EQ(Bounds::encode_up(0.0f), 0);
  EXPECT_EQ(Bounds::decode(0), 0.0f);
}

// 5 x 5 samples, one root square, worked out by hand. Heights, all others 0:
//   (2, 2) = 8: the centre of the root;  (3, 1) = 2: the centre of the north-eastern quarter.
TEST(Bounds, SmallFieldByHand) {
  std::vector<float> heights(25, 0.0f);
  heights[2 * 5 + 2] = 8.0f;
  heights[1 * 5 + 3] = 2.0f;
  const HeightField field = make(describe(5, 5, false), heights);
  ASSERT_EQ(field.root_bits(), 2);
  const Bounds bounds = Bounds::create(field);
  const int step = field.sample_step();
  const auto at = [&](int column, int row, int level) {
    return double(bounds.bound(LatticePoint(column, row) * step, level));
  };
  // Level 3: sides of two samples; (3, 0), (4, 1) lie between zeros, (2, 1) and (3, 2) between (2, 2) = 8 and 0.
  EXPECT_EQ(at(3, 0, 3), 0.0);
  EXPECT_EQ(at(2, 1, 3), 4.0);
  EXPECT_EQ(at(3, 2, 3), 4.0);
  EXPECT_EQ(at(1, 2, 3), 4.0);
  EXPECT_EQ(at(0, 1, 3), 0.0);
  // Level 2: (3, 1) has its base on the falling or rising diagonal by the parity of its square (1, 0): from (4, 0) to
  // (2, 2), mean 4, so 2 below it; plus 4. (1, 1): base (0, 0) to (2, 2), 4 below; plus 4.
  EXPECT_EQ(at(3, 1, 2), 6.0);
  EXPECT_EQ(at(1, 1, 2), 8.0);
  // Level 1: the middle of the northern side, between zeros: the larger of the quarters'.
  EXPECT_EQ(at(2, 0, 1), 8.0);
  EXPECT_EQ(at(4, 2, 1), 8.0);
  // Level 0: base from south-west to north-east, zeros: 8 for the centre and 8 below it.
  EXPECT_EQ(at(2, 2, 0), 16.0);
  EXPECT_EQ(at(3, 1, 4), 0.0);
}

// A root square's south-western and north-eastern corner carry the base of level 0, not the others.
TEST(Bounds, RootsSplitFromSouthWestToNorthEast) {
  std::vector<float> heights(9, 0.0f);
  heights[0] = 4.0f;  // NW
  const HeightField north_west = make(describe(3, 3, false), heights);
  // The centre is on its base; sides W and N are 2 off.
  EXPECT_EQ(Bounds::create(north_west).bound(LatticePoint(1, 1) * north_west.sample_step(), 0), 2.0f);
  heights[0] = 0.0f;
  heights[2] = 4.0f;  // NE
  const HeightField north_east = make(describe(3, 3, false), heights);
  EXPECT_EQ(Bounds::create(north_east).bound(LatticePoint(1, 1) * north_east.sample_step(), 0), 4.0f);
}

// The definition, top-down and by triangles: the diamond's two triangles are found as the bintree's triangles that have
// the same base.
class Reference {
 public:
  explicit Reference(const HeightField& field) : field_(field) {
    for (int level = 0; level < field.data_level(); ++level) {
      all_triangles(field, level, [&](const Triangle& t) {
        by_centre_[{level, t.middle().x, t.middle().y}].push_back(t);
      });
    }
  }
  double bound(LatticePoint centre, int level) {
    if (level >= field_.data_level()) return 0.0;
    const auto key = std::tuple(level, centre.x, centre.y);
    if (const auto known = done_.find(key); known != done_.end()) return known->second;
    double below = 0.0;
    const std::vector<Triangle>& triangles = by_centre_.at(key);
    for (const Triangle& t : triangles) {
      for (int turn = 0; turn < 2; ++turn) below = std::max(below, bound(t.child(turn).middle(), level + 1));
    }
    const Triangle& t = triangles.front();
    const double bend = field_.height(centre) - 0.5 * (field_.height(t.left) + field_.height(t.right));
    return done_[key] = below + std::abs(bend);
  }
  template <class Visit>
  void all(Visit&& visit) {
    for (const auto& [key, triangles] : by_centre_) visit(triangles);
  }

 private:
  const HeightField& field_;
  std::map<std::tuple<int, int, int>, std::vector<Triangle>> by_centre_;
  std::map<std::tuple<int, int, int>, double> done_;
};

TEST(Bounds, AreTheNestedWedgiesOfTheDefinition) {
  // Three root squares side by side, no padding.
  const HeightField field = rough(97, 33);
  ASSERT_EQ(field.root_squares(), glm::ivec2(3, 1));
  const Bounds bounds = Bounds::create(field);
  Reference reference(field);
  int pairs = 0;
  reference.all([&](const std::vector<Triangle>& triangles) {
    const Triangle& t = triangles.front();
    const double expected = reference.bound(t.middle(), t.level), stored = double(bounds.bound(t.middle(), t.level));
    ASSERT_LE(triangles.size(), 2u);
    pairs += triangles.size() == 2 ? 1 : 0;
    ASSERT_GE(stored, expected * (1.0 - 1e-12));
    // One rounding a level.
    ASSERT_LE(stored, expected * std::pow(1.0 + 1.0 / 2048.0, field.data_level()) + 1e-5);
  });
  EXPECT_GT(pairs, 2000);
}

TEST(Bounds, CoverEverySampleOfEveryTriangle) {
  check_all_samples(rough(65, 65));
}
TEST(Bounds, CoverEverySampleOfAPaddedField) {
  check_all_samples(rough(70, 45));
}
TEST(Bounds, CoverEverySampleOfAStrip) {
  check_all_samples(rough(300, 3));
}
TEST(Bounds, CoverEverySampleOfTheSmallestField) {
  check_all_samples(make(describe(2, 2, false), std::vector<float>{0.0f, 5.0f, -3.0f, 100.0f}));
  check_all_samples(make(describe(3, 2, false), std::vector<float>{0.0f, 5.0f, -3.0f, 100.0f, 2.0f, 9.0f}));
}
TEST(Bounds, CoverEveryValidSampleAroundHoles) {
  check_all_samples(with_holes(80, 65, false));
}

TEST(Bounds, CoverEverySampleOfWordsWithNegativeScale) {
  std::vector<uint16_t> words;
  for (const float height : rough_heights(65, 49, 4)) words.push_back(uint16_t(height * 100.0f + 30000.0f));
  HeightFieldDesc desc = describe(65, 49, false);
  desc.scale = -0.01;
  desc.offset = 300.0;
  desc.origin.z = 1234.5;
  check_all_samples(make(desc, words));
}

TEST(Bounds, CoverEverySampleOfALargeField) {
  const HeightField field = rough(600, 513);
  check_samples(field, Bounds::create(field), 300);
}

// Triangles of all levels, the finest surface instead of samples.
void check_surface(const HeightField& field) {
  const Bounds bounds = Bounds::create(field);
  std::mt19937 random(41);
  double best = 0.0;
  for (int level = 0; level < field.max_level(); ++level) {
    for (int i = 0; i < 1000; ++i) {
      const Triangle t = random_triangle(field, level, random);
      const double bound = double(bounds.bound(t.middle(), level));
      for (int k = 0; k < 20; ++k) {
        Triangle small = t;
        while (small.level < field.max_level()) small = small.child(int(random() % 2));
        if (!field.inside(small.apex) || !field.inside(small.left) || !field.inside(small.right)) continue;
        const double error = std::abs(field.height(small.apex) - plane_height(field, t, glm::dvec2(small.apex)));
        ASSERT_LE(error, bound + k_rounding) << "level " << level;
        if (bound > 0.0) best = std::max(best, error / bound);
      }
    }
  }
  EXPECT_GT(best, 0.3);
}

TEST(Bounds, CoverTheReliefToo) {
  check_surface(rough(65, 65, true));
}
TEST(Bounds, CoverTheReliefOfAPaddedField) {
  check_surface(rough(70, 45, true));
}
TEST(Bounds, CoverEveryValidSampleAroundHolesWithRelief) {
  const HeightField field = with_holes(80, 65, true);
  check_samples(field, Bounds::create(field), 2000);
}

void check_order(const HeightField& field) {
  const Bounds bounds = Bounds::create(field);
  std::mt19937 random(51);
  for (int i = 0; i < 20000; ++i) {
    Triangle t = random_triangle(field, 0, random);
    while (t.level < field.max_level()) {
      const Triangle child = t.child(int(random() % 2));
      ASSERT_GE(bounds.bound(t.middle(), t.level), bounds.bound(child.middle(), child.level)) << t.level;
      t = child;
    }
    EXPECT_EQ(bounds.bound(t.middle(), field.max_level()), 0.0f);
  }
}

TEST(Bounds, NeverGrowFromParentToChild) {
  check_order(rough(70, 45, false));
  check_order(rough(70, 45, true));
  check_order(with_holes(80, 65, true));
}

TEST(Bounds, AreSharedAcrossRootSquares) {
  // A spike in the eastern of two root squares; the diamond on their border belongs to both.
  std::vector<float> heights(5 * 3, 0.0f);
  heights[size_t(1 * 5 + 3)] = 10.0f;
  const HeightField field = make(describe(5, 3, false), heights);
  ASSERT_EQ(field.root_squares(), glm::ivec2(2, 1));
  const Bounds bounds = Bounds::create(field);
  const int step = field.sample_step();
  // The spike is the centre of the eastern root, its sides are flat; only the root has it.
  EXPECT_EQ(bounds.bound(LatticePoint(3, 1) * step, 0), 10.0f);
  EXPECT_EQ(bounds.bound(LatticePoint(1, 1) * step, 0), 0.0f);
  // On the border: both roots have it.
  heights.assign(15, 0.0f);
  heights[size_t(1 * 5 + 2)] = 6.0f;
  const HeightField border = make(describe(5, 3, false), heights);
  const Bounds shared = Bounds::create(border);
  EXPECT_EQ(shared.bound(LatticePoint(1, 1) * step, 0), 6.0f);
  EXPECT_EQ(shared.bound(LatticePoint(3, 1) * step, 0), 6.0f);
}

TEST(Bounds, PaddingAloneCountsNothing) {
  // 21 of 33 rows are data. Relief is felt at most two samples beyond its diamond.
  const HeightField field = rough(1000, 21, true);
  ASSERT_EQ(field.root_squares() * (1 << field.root_bits()), glm::ivec2(1008, 32));
  const Bounds bounds = Bounds::create(field);
  const int step = field.sample_step();
  int beyond = 0;
  for (int level = 2; level <= field.data_level() + 2; ++level) {
    const int margin = 2 * step + (sward::k_root_side >> (level / 2));
    all_triangles(field, level, [&](const Triangle& t) {
      const int top = std::min(t.apex.y, std::min(t.left.y, t.right.y));
      if (top <= 20 * step + margin) return;
      ASSERT_EQ(bounds.bound(t.middle(), t.level), 0.0f) << level;
      ++beyond;
    });
  }
  EXPECT_GT(beyond, 1000);
}

TEST(Bounds, HolesAloneCountNothing) {
  const HeightField field = with_holes(80, 65, true);
  const Bounds bounds = Bounds::create(field);
  const int step = field.sample_step();
  // The middle of the lake, 13 samples in radius.
  const LatticePoint middle(26 * step, 32 * step);
  for (int level = field.data_level() - 1; level < field.max_level(); ++level) {
    EXPECT_EQ(bounds.bound(middle + LatticePoint(step, 0), level), 0.0f) << level;
    EXPECT_GT(bounds.bound(middle + LatticePoint(21 * step, 0), level), 0.0f) << level;
  }
}

TEST(Bounds, FlatGroundHasNone) {
  const HeightField field = make(describe(100, 40, false), std::vector<float>(4000, 17.25f));
  const Bounds bounds = Bounds::create(field);
  for (int level = 0; level < field.data_level(); ++level) {
    all_triangles(field, level, [&](const Triangle& t) { ASSERT_EQ(bounds.bound(t.middle(), level), 0.0f); });
  }
}

std::vector<char> file_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class BoundsFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("sward_bounds_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name = "bounds.bin") const { return (folder_ / name).string(); }
  void write(const std::vector<char>& bytes) const {
    std::ofstream(path(), std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  }
  std::string load_error(const HeightField& field) const {
    const auto loaded = Bounds::load(path(), field);
    return loaded ? std::string() : loaded.error().message;
  }
  fs::path folder_;
};

TEST_F(BoundsFile, ThreadsMakeNoDifference) {
  const HeightField field = with_holes(700, 520, true);
  ASSERT_TRUE(Bounds::create(field, 1).save(path("1")));
  const std::vector<char> one = file_bytes(path("1"));
  for (const int threads : {2, 5, 0}) {
    ASSERT_TRUE(Bounds::create(field, threads).save(path("n")));
    EXPECT_EQ(one, file_bytes(path("n"))) << threads;
  }
}

TEST_F(BoundsFile, ComesBackAsItWas) {
  const HeightField field = rough(70, 45, true);
  const Bounds bounds = Bounds::create(field);
  ASSERT_TRUE(bounds.save(path()));
  // Nothing beside it.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  const auto loaded = Bounds::load(path(), field);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->memory(), bounds.memory());
  for (int level = 0; level < field.max_level() && level < 14; ++level) {
    all_triangles(field, level, [&](const Triangle& t) {
      ASSERT_EQ(loaded->bound(t.middle(), level), bounds.bound(t.middle(), level));
    });
  }
}

TEST_F(BoundsFile, RefusesWhatIsNotItsOwn) {
  const HeightField field = rough(70, 45);
  EXPECT_NE(load_error(field).find("cannot read"), std::string::npos);
  ASSERT_TRUE(Bounds::create(field).save(path()));
  const std::vector<char> good = file_bytes(path());
  ASSERT_EQ(load_error(field), "");

  for (const size_t length : {size_t(0), size_t(7), size_t(39), size_t(40), good.size() / 2, good.size() - 1}) {
    write(std::vector<char>(good.begin(), good.begin() + std::ptrdiff_t(length)));
    EXPECT_NE(load_error(field).find("truncated"), std::string::npos) << length;
  }
  std::vector<char> bytes = good;
  bytes.push_back(0);
  write(bytes);
  EXPECT_NE(load_error(field).find("longer"), std::string::npos);
  for (size_t at = 0; at < good.size(); at += at < 40 ? 1 : 501) {
    bytes = good;
    bytes[at] = char(bytes[at] ^ 0x10);
    write(bytes);
    EXPECT_NE(load_error(field), "") << at;
  }
  bytes = good;
  bytes[0] = char(bytes[0] + 1);
  write(bytes);
  EXPECT_NE(load_error(field).find("version"), std::string::npos);
  write(good);
  EXPECT_NE(load_error(rough(70, 45, true)).find("another height field"), std::string::npos);
  EXPECT_NE(load_error(make(describe(70, 45, false), rough_heights(70, 45, 22))).find("another"), std::string::npos);
}

TEST_F(BoundsFile, SaysWhenItCannotBeWritten) {
  const HeightField field = rough(9, 9);
  const auto saved = Bounds::create(field).save(path("absent/bounds.bin"));
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message.find("absent/bounds.bin"), std::string::npos);
  // A folder stands in the way: nothing is left behind.
  fs::create_directories(folder_ / "taken" / "full");
  EXPECT_FALSE(Bounds::create(field).save(path("taken")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST(Bounds, ProgressRisesToOne) {
  const HeightField field = rough(600, 513);
  float last = 0.0f;
  int calls = 0;
  Bounds::create(field, 2, [&](float done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0f);
    last = done;
    ++calls;
  });
  EXPECT_EQ(last, 1.0f);
  EXPECT_GT(calls, 10);
  EXPECT_LT(calls, 500);
}

#if defined(SWARD_IMAGE_IO)
void check_file(const char* name, glm::dvec2 spacing, double scale) {
  const std::string path = std::string(SWARD_SHARED_DATA) + "/" + name;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";
  for (const bool relief : {false, true}) {
    sward::HeightImport import;
    import.path = path;
    import.spacing = spacing;
    import.scale = scale;
    import.relief.enabled = relief;
    const auto field = sward::load_height_field(import);
    ASSERT_TRUE(field) << field.error().message;
    check_samples(*field, Bounds::create(*field), 300);
  }
}

TEST(Bounds, CoverEverySampleOfRainier) {
  check_file("mt_rainier_90m.tif", {63.5, 92.6}, 1.0);
}
TEST(Bounds, CoverEverySampleOfPuget) {
  check_file("ps_height_1k.png", {160.0, 160.0}, 0.1);
}
#endif

}  // namespace
