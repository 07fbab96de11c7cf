// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/height_field.h>

#include <cmath>
#include <limits>
#include <string>

#include "unit/field_reference.h"
#if defined(SWARD_IMAGE_IO)
#include <sward/image_io/image_io.h>

#include <filesystem>
#endif

using namespace field_reference;
using sward::HeightFieldDesc;

namespace {

HeightFieldDesc plain(int columns, int rows, glm::dvec2 spacing = {1.0, 1.0}) {
  HeightFieldDesc desc;
  desc.columns = columns;
  desc.rows = rows;
  desc.spacing = spacing;
  desc.relief.enabled = false;
  return desc;
}

HeightField make(const HeightFieldDesc& desc, HeightField::Samples samples, std::span<const uint8_t> holes = {}) {
  auto field = HeightField::create(desc, std::move(samples), holes);
  if (!field) throw std::runtime_error(field.error().message);
  return std::move(*field);
}

HeightField rough(int columns, int rows, bool relief, glm::dvec2 spacing = {3.0, 5.0}) {
  HeightFieldDesc desc = plain(columns, rows, spacing);
  desc.relief.enabled = relief;
  return make(desc, rough_heights(columns, rows, 5));
}

std::string message_of(const HeightFieldDesc& desc, size_t samples, size_t holes = 0) {
  const auto field =
      HeightField::create(desc, std::vector<float>(samples, 1.0f), std::vector<uint8_t>(holes, uint8_t(0)));
  return field ? std::string() : field.error().message;
}

TEST(HeightField, SamplesStandWhereTheContractSays) {
  HeightFieldDesc desc = plain(4, 3, {10.0, 20.0});
  desc.origin = {1000.0, 2000.0, 50.0};
  desc.scale = 0.5;
  desc.offset = -100.0;
  const HeightField field = make(desc, std::vector<uint16_t>{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 65535});
  const int step = field.sample_step();
  // Column 3, row 0: 1.5 spacings east, 1 north.
  EXPECT_EQ(field.world_xy({3 * step, 0}), glm::dvec2(1015.0, 2020.0));
  EXPECT_EQ(field.world_xy({0, 2 * step}), glm::dvec2(985.0, 1980.0));
  EXPECT_EQ(field.min_corner(), glm::dvec2(985.0, 1980.0));
  EXPECT_EQ(field.max_corner(), glm::dvec2(1015.0, 2020.0));
  EXPECT_EQ(field.sample(2, 1), 50.0 - 100.0 + 6.0);
  EXPECT_EQ(field.height(LatticePoint(2 * step, step)), -44.0);
  EXPECT_EQ(field.height(glm::dvec2(1005.0, 2000.0)), -44.0);
  // Indices beyond the data repeat the edge.
  EXPECT_EQ(field.sample(9, 9), field.sample(3, 2));
  EXPECT_EQ(field.sample(-1, -1), field.sample(0, 0));
  EXPECT_EQ(field.height(LatticePoint(4 * step, 4 * step)), field.sample(3, 2));
  EXPECT_EQ(field.height_range(), glm::dvec2(-50.0, 50.0 - 100.0 + 32767.5));
}

TEST(HeightField, RootSquaresPadLeastWithinTheLimit) {
  struct Row {
    int columns, rows, bits;
    glm::ivec2 squares;
  };
  // By hand. 1200 = 4.7 * 256 = 9.4 * 128; 4000 fits 4096 with any side up to it; 1200 x 3: 2 columns of rows' padding.
  for (const Row& row : {Row{2, 2, 1, {1, 1}}, Row{3, 2, 1, {1, 1}}, Row{5, 3, 1, {2, 1}}, Row{1025, 1025, 10, {1, 1}},
                         Row{1201, 1201, 8, {5, 5}}, Row{4001, 4001, 12, {1, 1}}, Row{257, 129, 7, {2, 1}},
                         Row{129, 257, 7, {1, 2}}, Row{1537, 1025, 9, {3, 2}}, Row{258, 2, 1, {129, 1}}}) {
    const HeightField field =
        make(plain(row.columns, row.rows), std::vector<uint16_t>(size_t(row.columns) * size_t(row.rows), uint16_t(7)));
    EXPECT_EQ(field.root_bits(), row.bits) << row.columns << " x " << row.rows;
    EXPECT_EQ(field.root_squares(), row.squares) << row.columns << " x " << row.rows;
    EXPECT_EQ(field.data_level(), 2 * row.bits);
    EXPECT_EQ(field.max_level(), 2 * row.bits);
    EXPECT_EQ(field.sample_step() << row.bits, sward::k_root_side);
  }
}

TEST(HeightField, MeshEndsAtTheFinestEdge) {
  HeightFieldDesc desc = plain(65, 65, {5.0, 8.0});
  desc.relief.enabled = true;
  desc.relief.finest_edge_m = 0.5f;
  // 8 m halved 4 times is 0.5 m.
  EXPECT_EQ(make(desc, std::vector<float>(65 * 65)).max_level(), 12 + 8);
  desc.relief.finest_edge_m = 0.49f;
  EXPECT_EQ(make(desc, std::vector<float>(65 * 65)).max_level(), 12 + 10);
  desc.relief.finest_edge_m = 9.0f;
  EXPECT_EQ(make(desc, std::vector<float>(65 * 65)).max_level(), 12);
  // Ids end at level 35.
  desc = plain(1025, 1025, {160.0, 160.0});
  desc.relief.enabled = true;
  EXPECT_EQ(make(desc, std::vector<float>(1025 * 1025)).max_level(), 35);
}

// Finest surface against the triangles of the bintree's definition.
void check_finest_surface(const HeightField& field, int triangles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int checked = 0;
  while (checked < triangles) {
    const Triangle t = random_triangle(field, field.max_level(), random);
    if (!field.inside(t.apex) || !field.inside(t.left) || !field.inside(t.right)) continue;
    double a = uniform(random), b = uniform(random);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const glm::dvec2 xy =
        (1.0 - a - b) * field.world_xy(t.apex) + a * field.world_xy(t.left) + b * field.world_xy(t.right);
    const double z = (1.0 - a - b) * field.height(t.apex) + a * field.height(t.left) + b * field.height(t.right);
    ASSERT_NEAR(field.height(xy), z, 1e-7) << "triangle " << checked;
    const glm::dvec3 apex(field.world_xy(t.apex), field.height(t.apex));
    const glm::dvec3 left(field.world_xy(t.left), field.height(t.left));
    const glm::dvec3 right(field.world_xy(t.right), field.height(t.right));
    const glm::dvec3 normal = glm::normalize(glm::cross(left - apex, right - apex));
    // At the middle, so that rounding does not choose a neighbour.
    ASSERT_NEAR(glm::distance(field.normal(glm::dvec2(apex + left + right) / 3.0), normal), 0.0, 1e-6);
    ++checked;
  }
}

TEST(HeightField, FinestSurfaceIsTheBintreesAtTheDataLevel) {
  check_finest_surface(rough(65, 65, false), 20000);
  check_finest_surface(rough(130, 70, false), 20000);
}

TEST(HeightField, FinestSurfaceIsTheBintreesBelowTheData) {
  check_finest_surface(rough(130, 70, true), 20000);
}

TEST(HeightField, FinestSurfaceIsTheBintreesAtAnOddLevel) {
  HeightFieldDesc desc = plain(513, 513, {160.0, 160.0});
  desc.relief.enabled = true;
  desc.relief.finest_edge_m = 0.1f;
  const HeightField field = make(desc, rough_heights(513, 513, 5));
  ASSERT_EQ(field.max_level(), 35);
  check_finest_surface(field, 5000);
}

TEST(HeightField, LatticeHeightsBetweenSamplesAreLinearOnDataTriangles) {
  const HeightField field = rough(37, 50, false);
  std::mt19937 random(9);
  for (int i = 0; i < 20000; ++i) {
    const Triangle t = random_triangle(field, field.data_level(), random);
    Triangle small = t;
    while (small.level < 30) small = small.child(int(random() % 2));
    const LatticePoint p = small.apex;
    const double expected = plane_height(field, t, glm::dvec2(p));
    ASSERT_NEAR(field.height(p), expected, 1e-9);
  }
}

TEST(HeightField, SurfaceIsContinuous) {
  const HeightField field = rough(70, 40, true);
  std::mt19937 random(4);
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  for (int i = 0; i < 50000; ++i) {
    const glm::dvec2 p = low + size * glm::dvec2(uniform(random), uniform(random));
    // The steepest facet here rises some 100 m in 3 m.
    ASSERT_NEAR(field.height(p), field.height(p + glm::dvec2(1e-6, -1e-6)), 1e-3);
  }
}

TEST(HeightField, NothingBeyondTheData) {
  const HeightField field = rough(70, 40, true);
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  EXPECT_FALSE(std::isnan(field.height(low)));
  EXPECT_FALSE(std::isnan(field.height(high)));
  EXPECT_NEAR(field.height(low), field.sample(0, 39), 1e-6);
  EXPECT_NEAR(field.height(high), field.sample(69, 0), 1e-6);
  EXPECT_TRUE(std::isnan(field.height(low - glm::dvec2(0.01, 0.0))));
  EXPECT_TRUE(std::isnan(field.height(high + glm::dvec2(0.0, 0.01))));
  EXPECT_TRUE(std::isnan(field.height(glm::dvec2(std::nan(""), 0.0))));
  EXPECT_EQ(field.normal(high + 1.0), glm::dvec3(0, 0, 1));
  const int step = field.sample_step();
  EXPECT_TRUE(field.inside({69 * step, 39 * step}));
  EXPECT_FALSE(field.inside({69 * step + 1, 0}));
  EXPECT_FALSE(field.inside({0, 39 * step + 1}));
  EXPECT_FALSE(field.inside({-1, 0}));
}

TEST(HeightField, FarOriginKeepsTheSurface) {
  HeightFieldDesc desc = plain(65, 65, {2.0, 2.0});
  desc.relief.enabled = true;
  const HeightField near = make(desc, rough_heights(65, 65, 5));
  desc.origin = {1.0e7, -1.0e7, 0.0};
  const HeightField far = make(desc, rough_heights(65, 65, 5));
  for (double x = -60.0; x < 60.0; x += 0.73) {
    const glm::dvec2 p(x, 0.31 * x + 3.0);
    ASSERT_NEAR(near.height(p), far.height(p + glm::dvec2(desc.origin)), 1e-5);
  }
}

TEST(HeightField, DataGradientOfAPlaneAndAtTheEdge) {
  std::vector<float> plane;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 17; ++column) plane.push_back(float(3 * column + 8 * row));
  }
  HeightFieldDesc desc = plain(17, 9, {2.0, 4.0});
  desc.origin = {100.0, 50.0, 0.0};
  const HeightField field = make(desc, plane);
  // 3 m per 2 m east; 8 m per 4 m south.
  for (const glm::dvec2 p : {glm::dvec2(100, 50), {84, 34}, {116, 66}, {101.3, 40.2}, {500, -500}, {-500, 500}}) {
    EXPECT_NEAR(glm::distance(field.data_gradient(p), glm::dvec2(1.5, -2.0)), 0.0, 1e-12);
  }
}

TEST(HeightField, DataGradientIsBilinearBetweenCentralDifferences) {
  std::vector<float> heights(25, 0.0f);
  heights[size_t(2 * 5 + 2)] = 8.0f;
  const HeightField field = make(plain(5, 5), heights);
  // West of the spike the slope is 4, east -4; halfway between (1, 2) and the spike 2.
  EXPECT_NEAR(field.data_gradient({-1, 0}).x, 4.0, 1e-12);
  EXPECT_NEAR(field.data_gradient({1, 0}).x, -4.0, 1e-12);
  EXPECT_NEAR(field.data_gradient({-0.5, 0}).x, 2.0, 1e-12);
  EXPECT_NEAR(field.data_gradient({-1, 0.5}).x, 2.0, 1e-12);
  EXPECT_NEAR(field.data_gradient({0, 1}).y, -4.0, 1e-12);
}

TEST(HeightField, AHoleOfOneSampleIsTheMeanOfItsNeighbours) {
  std::vector<float> heights = rough_heights(20, 20, 1);
  std::vector<uint8_t> holes(400, 0);
  holes[size_t(7 * 20 + 5)] = 1;
  const float mean = (heights[7 * 20 + 4] + heights[7 * 20 + 6] + heights[6 * 20 + 5] + heights[8 * 20 + 5]) / 4.0f;
  heights[7 * 20 + 5] = -32768.0f;
  const HeightField field = make(plain(20, 20), heights, holes);
  EXPECT_EQ(field.hole_count(), 1);
  EXPECT_TRUE(field.is_hole(5, 7));
  EXPECT_FALSE(field.is_hole(5, 8));
  EXPECT_NEAR(field.sample(5, 7), double(mean), 1e-4);
  EXPECT_GT(field.height_range()[0], -1000.0);
}

// A wide hole in a tilted plane: the membrane over its rim is the plane.
TEST(HeightField, AWideHoleInAPlaneIsFilledWithThePlane) {
  const int size = 200;
  std::vector<float> heights;
  std::vector<uint8_t> holes;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const bool hole = std::hypot(column - 90, row - 110) < 60.0 && !(column == 90 && row == 110);
      heights.push_back(hole ? 9.0e8f : float(2 * column - row));
      holes.push_back(hole ? 1 : 0);
    }
  }
  const HeightField field = make(plain(size, size), heights, holes);
  EXPECT_EQ(field.hole_count(), int64_t(std::count(holes.begin(), holes.end(), uint8_t(1))));
  double worst = 0.0;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      worst = std::max(worst, std::abs(field.sample(column, row) - (2.0 * column - row)));
    }
  }
  // 1 % of what the rim spans (260 m).
  EXPECT_LT(worst, 2.6);
}

TEST(HeightField, AFillLiesBetweenItsRimAndHasNoSteps) {
  const int size = 128;
  std::vector<float> heights = rough_heights(size, size, 8);
  float low = 1e9f, high = -1e9f;
  const auto in_hole = [](int column, int row) { return column >= 40 && column < 90 && row >= 30 && row < 100; };
  for (int row = 29; row <= 100; ++row) {
    for (int column = 39; column <= 90; ++column) {
      float& height = heights[size_t(row * size + column)];
      if (in_hole(column, row)) {
        height = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  const HeightField field = make(plain(size, size), heights);
  EXPECT_EQ(field.hole_count(), 50 * 70);
  double steepest = 0.0;
  for (int row = 30; row < 100; ++row) {
    for (int column = 40; column < 90; ++column) {
      ASSERT_TRUE(field.is_hole(column, row));
      ASSERT_GE(field.sample(column, row), double(low));
      ASSERT_LE(field.sample(column, row), double(high));
      if (column < 42 || column >= 88 || row < 32 || row >= 98) continue;
      steepest = std::max(steepest, std::abs(field.sample(column, row) - field.sample(column - 1, row)));
      steepest = std::max(steepest, std::abs(field.sample(column, row) - field.sample(column, row - 1)));
    }
  }
  // Two samples in from the rim the fill has lost the rim's jumps (35 m cliffs, noise of +-1 a sample).
  EXPECT_LT(steepest, 8.0);
}

TEST(HeightField, HolesOfWordsStayWords) {
  std::vector<uint16_t> words(81, uint16_t(1000));
  std::vector<uint8_t> holes(81, 0);
  for (const size_t i : {0u, 8u, 40u, 41u, 80u}) {
    words[i] = 0;
    holes[i] = 255;
  }
  const HeightField field = make(plain(9, 9), words, holes);
  EXPECT_EQ(field.hole_count(), 5);
  EXPECT_EQ(field.height_range(), glm::dvec2(1000.0, 1000.0));
}

TEST(HeightField, OneSampleOfDataFillsAll) {
  std::vector<float> heights(50 * 30, std::numeric_limits<float>::infinity());
  heights[777] = 12.5f;
  const HeightField field = make(plain(50, 30), heights);
  EXPECT_EQ(field.hole_count(), 50 * 30 - 1);
  EXPECT_EQ(field.height_range(), glm::dvec2(12.5, 12.5));
}

TEST(HeightField, RefusesBadInputNamingIt) {
  const auto has = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  EXPECT_PRED2(has, message_of(plain(1, 9), 9), "1 x 9");
  EXPECT_PRED2(has, message_of(plain(1, 1), 1), "too small");
  EXPECT_PRED2(has, message_of(plain(0, 0), 0), "too small");
  EXPECT_PRED2(has, message_of(plain(-3, 4), 0), "too small");
  EXPECT_PRED2(has, message_of(plain(200000, 2), 400000), "too large");
  EXPECT_PRED2(has, message_of(plain(100000, 100000), 16), "too large");
  EXPECT_PRED2(has, message_of(plain(4, 4), 15), "15");
  EXPECT_PRED2(has, message_of(plain(4, 4), 16, 7), "mask of 7");
  EXPECT_PRED2(has, message_of(plain(4, 4, {0.0, 1.0}), 16), "spacing");
  EXPECT_PRED2(has, message_of(plain(4, 4, {1.0, std::nan("")}), 16), "spacing");
  HeightFieldDesc desc = plain(4, 4);
  desc.scale = 0.0;
  EXPECT_PRED2(has, message_of(desc, 16), "scale");
  desc = plain(4, 4);
  desc.origin.z = std::nan("");
  EXPECT_PRED2(has, message_of(desc, 16), "origin");
  desc = plain(4, 4);
  desc.relief.roughness = 0.6f;
  EXPECT_PRED2(has, message_of(desc, 16), "roughness");
  desc = plain(4, 4);
  desc.relief.flat_share = -0.1f;
  EXPECT_PRED2(has, message_of(desc, 16), "flat_share");
  desc = plain(4, 4);
  desc.relief.full_slope = 0.0f;
  EXPECT_PRED2(has, message_of(desc, 16), "full_slope");
  desc = plain(4, 4);
  desc.relief.finest_edge_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_PRED2(has, message_of(desc, 16), "finest_edge_m");

  const auto empty = HeightField::create(plain(4, 4), std::vector<float>(16, std::nanf("")));
  ASSERT_FALSE(empty);
  EXPECT_PRED2(has, empty.error().message, "no data");
  std::vector<float> wild(16, 0.0f);
  wild[3] = -3.0e38f;
  const auto spread = HeightField::create(plain(4, 4), wild);
  ASSERT_FALSE(spread);
  EXPECT_PRED2(has, spread.error().message, "span");
}

TEST(HeightField, FingerprintTellsFieldsApart) {
  HeightFieldDesc desc = plain(33, 33, {4.0, 4.0});
  desc.relief.enabled = true;
  const std::vector<float> heights = rough_heights(33, 33, 2);
  const uint64_t first = make(desc, heights).fingerprint();
  EXPECT_EQ(first, make(desc, heights).fingerprint());
  std::vector<float> changed = heights;
  changed[1088] += 0.001f;
  EXPECT_NE(first, make(desc, changed).fingerprint());
  std::vector<uint8_t> holes(heights.size(), 0);
  holes[500] = 1;
  EXPECT_NE(first, make(desc, heights, holes).fingerprint());
  HeightFieldDesc other = desc;
  other.spacing.y = 4.5;
  EXPECT_NE(first, make(other, heights).fingerprint());
  other = desc;
  other.relief.roughness *= 2.0f;
  EXPECT_NE(first, make(other, heights).fingerprint());
  other = desc;
  other.relief.enabled = false;
  EXPECT_NE(first, make(other, heights).fingerprint());
}

#if defined(SWARD_IMAGE_IO)
TEST(HeightField, RainiersHolesAreFilled) {
  const std::string path = std::string(SWARD_SHARED_DATA) + "/mt_rainier_90m.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  sward::HeightImport import;
  import.path = path;
  import.spacing = {63.5, 92.6};
  import.relief.enabled = false;
  const auto field = sward::load_height_field(import);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->hole_count(), 9033);
  EXPECT_EQ(field->root_bits(), 8);
  EXPECT_EQ(field->root_squares(), glm::ivec2(5, 5));
  // Nothing near -32768; the summit is in the file.
  EXPECT_GT(field->height_range()[0], -500.0);
  EXPECT_NEAR(field->height_range()[1], 4380.0, 60.0);
}
#endif

}  // namespace
