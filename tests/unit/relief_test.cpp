// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/height_field.h>

#include <cmath>
#include <stdexcept>

#include "unit/field_reference.h"

using namespace field_reference;
using sward::HeightFieldDesc;

namespace {

struct Ground {
  HeightField field;  // With relief.
  HeightField base;   // Without.
};

HeightField make(const HeightFieldDesc& desc, const std::vector<float>& samples,
                 const std::vector<uint8_t>& holes = {}) {
  auto field = HeightField::create(desc, samples, holes);
  if (!field) throw std::runtime_error(field.error().message);
  return std::move(*field);
}

Ground ground(int columns, int rows, glm::dvec2 spacing, std::vector<float> samples, float flat_share = 0.25f,
              const std::vector<uint8_t>& holes = {}) {
  HeightFieldDesc desc;
  desc.columns = columns;
  desc.rows = rows;
  desc.spacing = spacing;
  desc.relief.flat_share = flat_share;
  desc.relief.smooth = false;
  HeightField field = make(desc, samples, holes);
  desc.relief.enabled = false;
  return {std::move(field), make(desc, samples, holes)};
}

Ground rough_ground(glm::dvec2 spacing) {
  return ground(65, 48, spacing, rough_heights(65, 48, 3));
}

double relief_at(const Ground& g, LatticePoint p) {
  return g.field.height(p) - g.base.height(p);
}

double first_amplitude(const Ground& g) {
  const HeightFieldDesc& desc = g.field.desc();
  return double(desc.relief.roughness) * std::sqrt(desc.spacing.x * desc.spacing.y);
}

// A random lattice point of the data.
template <class Random>
LatticePoint random_point(const HeightField& field, Random& random) {
  const int step = field.sample_step();
  return {int(random() % uint32_t((field.desc().columns - 1) * step)),
          int(random() % uint32_t((field.desc().rows - 1) * step))};
}

TEST(Relief, IsZeroOnEverySample) {
  const Ground g = rough_ground({8.0, 8.0});
  const int step = g.field.sample_step();
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 65; ++column) {
      const LatticePoint p(column * step, row * step);
      ASSERT_EQ(g.field.height(p), g.field.sample(column, row));
      ASSERT_EQ(g.field.sample(column, row), g.base.sample(column, row));
    }
  }
}

TEST(Relief, IsThereBetweenSamplesAndWithinItsAmplitude) {
  const Ground g = ground(65, 65, {8.0, 8.0}, std::vector<float>(65 * 65, 0.0f), 1.0f);
  std::mt19937 random(1);
  double sum = 0.0, squares = 0.0, largest = 0.0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double z = relief_at(g, random_point(g.field, random));
    sum += z;
    squares += z * z;
    largest = std::max(largest, std::abs(z));
  }
  EXPECT_LE(largest, g.field.relief_amplitude());
  EXPECT_GT(largest, 0.4 * g.field.relief_amplitude());
  EXPECT_GT(std::sqrt(squares / count), 0.15 * first_amplitude(g));
  EXPECT_NEAR(sum / count, 0.0, 0.05 * first_amplitude(g));
}

TEST(Relief, FlatGroundHasItsShareOfSteepGround) {
  const Ground flat = ground(33, 33, {4.0, 4.0}, std::vector<float>(33 * 33, 0.0f));
  std::vector<float> slope, half_slope;
  for (int row = 0; row < 33; ++row) {
    for (int column = 0; column < 33; ++column) {
      slope.push_back(float(4 * column));
      // Half of full_slope = 0.7: 0.35 * 4 m, where a smooth rise from 0.25 to 1 has come half of the way.
      half_slope.push_back(1.4f * float(column));
    }
  }
  const Ground steep = ground(33, 33, {4.0, 4.0}, slope), middling = ground(33, 33, {4.0, 4.0}, half_slope);
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    const LatticePoint p = random_point(flat.field, random);
    const double full = relief_at(steep, p);
    ASSERT_NEAR(relief_at(flat, p), 0.25 * full, 0.003 * first_amplitude(flat));
    ASSERT_NEAR(relief_at(middling, p), 0.625 * full, 0.003 * first_amplitude(flat));
  }
}

TEST(Relief, VanishesInHoles) {
  std::vector<uint8_t> holes(65 * 65, 0);
  for (int row = 20; row < 40; ++row) {
    for (int column = 10; column < 30; ++column) holes[size_t(row * 65 + column)] = 1;
  }
  const Ground g = ground(65, 65, {8.0, 8.0}, rough_heights(65, 65, 3), 1.0f, holes);
  const int step = g.field.sample_step();
  for (int i = 1; i < 500; ++i) {
    const LatticePoint p(10 * step + 19 * step * i / 500, 20 * step + 19 * step * (i * 7 % 500) / 500);
    ASSERT_EQ(relief_at(g, p), 0.0);
    ASSERT_EQ(g.field.relief_bound(LatticePoint(20 * step + step / 2, 30 * step + step / 2), g.field.data_level()),
              0.0);
  }
}

TEST(Relief, IsDeterministicAndDependsOnItsSeed) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 33;
  desc.spacing = {8.0, 8.0};
  const HeightField first = make(desc, rough_heights(33, 33, 3)), second = make(desc, rough_heights(33, 33, 3));
  desc.relief.seed = 2;
  const HeightField other = make(desc, rough_heights(33, 33, 3));
  std::mt19937 random(1);
  int same = 0;
  for (int i = 0; i < 1000; ++i) {
    const LatticePoint p = random_point(first, random);
    ASSERT_EQ(first.height(p), second.height(p));
    same += first.height(p) == other.height(p) ? 1 : 0;
  }
  EXPECT_LT(same, 10);
}

// Noise must not repeat: its rows, columns and octaves are unlike each other.
TEST(Relief, CellsAreNotAlike) {
  const Ground g = ground(129, 129, {2.0, 2.0}, std::vector<float>(129 * 129, 0.0f), 1.0f);
  const int step = g.field.sample_step();
  const auto correlation = [&](LatticePoint shift) {
    double product = 0.0, squares = 0.0;
    for (int row = 0; row < 100; ++row) {
      for (int column = 0; column < 100; ++column) {
        const LatticePoint p = LatticePoint(column, row) * step + LatticePoint(step / 2, step / 2);
        const double z = relief_at(g, p);
        product += z * relief_at(g, p + shift * step);
        squares += z * z;
      }
    }
    return product / squares;
  };
  for (const LatticePoint shift : {LatticePoint(3, 0), {0, 3}, {2, 2}, {8, 0}, {0, 8}, {16, 0}, {0, 16}, {5, 7}}) {
    EXPECT_LT(std::abs(correlation(shift)), 0.06) << shift.x << ", " << shift.y;
  }
}

// Every level's share of the bound against 1e5 random splits of it, and that the share is of use.
void check_splits(const Ground& g) {
  std::mt19937 random(11);
  for (int level = g.field.data_level(); level < g.field.max_level(); ++level) {
    const double allowed = g.field.relief_bound(level) - g.field.relief_bound(level + 1);
    ASSERT_GT(allowed, 0.0);
    double largest = 0.0;
    for (int i = 0; i < 100000; ++i) {
      const Triangle t = random_triangle(g.field, level, random);
      if (!g.field.inside(t.left) || !g.field.inside(t.right)) continue;
      const double bend = g.field.height(t.middle()) - 0.5 * (g.field.height(t.left) + g.field.height(t.right));
      largest = std::max(largest, std::abs(bend));
    }
    EXPECT_LE(largest, allowed) << "level " << level;
    EXPECT_GT(largest, 0.3 * allowed) << "level " << level;
    testing::Test::RecordProperty("share_used_level_" + std::to_string(level), std::to_string(largest / allowed));
  }
}

TEST(Relief, BoundHoldsAtSplitsOfFlatGround) {
  check_splits(ground(33, 33, {16.0, 16.0}, std::vector<float>(33 * 33, 0.0f), 1.0f));
}

TEST(Relief, BoundHoldsAtSplitsOfRoughGroundWithUnlikeSpacings) {
  check_splits(rough_ground({16.0, 5.0}));
}

TEST(Relief, DataAddsNothingToSplitsBelowItsLevel) {
  const Ground g = rough_ground({16.0, 5.0});
  std::mt19937 random(12);
  for (int level = g.field.data_level(); level < g.field.max_level(); ++level) {
    for (int i = 0; i < 5000; ++i) {
      const Triangle t = random_triangle(g.base, level, random);
      const double bend = g.base.height(t.middle()) - 0.5 * (g.base.height(t.left) + g.base.height(t.right));
      ASSERT_NEAR(bend, 0.0, 1e-9);
    }
  }
}

// The sum: the finest surface against the planes of triangles of all levels below the data.
TEST(Relief, SurfaceStaysWithinTheLocalBound) {
  const Ground g = rough_ground({9.0, 13.0});
  std::mt19937 random(13);
  double best = 0.0;
  for (int level = g.field.data_level(); level < g.field.max_level(); ++level) {
    for (int i = 0; i < 3000; ++i) {
      const Triangle t = random_triangle(g.field, level, random);
      if (!g.field.inside(t.apex) || !g.field.inside(t.left) || !g.field.inside(t.right)) continue;
      const double bound = g.field.relief_bound(t.middle(), level);
      ASSERT_LE(bound, g.field.relief_bound(level) * (1.0 + 1e-12));
      for (int k = 0; k < 20; ++k) {
        Triangle small = t;
        while (small.level < g.field.max_level()) small = small.child(int(random() % 2));
        const double error = std::abs(g.field.height(small.apex) - plane_height(g.field, t, glm::dvec2(small.apex)));
        ASSERT_LE(error, bound + 1e-9) << "level " << level;
        best = std::max(best, error / bound);
      }
    }
  }
  EXPECT_GT(best, 0.3);
  RecordProperty("largest_share_of_the_bound", std::to_string(best));
}

TEST(Relief, BoundsGrowFromChildToParent) {
  const Ground g = rough_ground({9.0, 13.0});
  std::mt19937 random(14);
  for (int i = 0; i < 20000; ++i) {
    Triangle t = random_triangle(g.field, g.field.data_level(), random);
    while (t.level < g.field.max_level()) {
      const Triangle child = t.child(int(random() % 2));
      ASSERT_GE(g.field.relief_bound(t.middle(), t.level), g.field.relief_bound(child.middle(), child.level));
      t = child;
    }
  }
  EXPECT_EQ(g.field.relief_bound(g.field.max_level()), 0.0);
  EXPECT_EQ(g.field.relief_bound(0), g.field.relief_bound(g.field.data_level()));
}

TEST(Relief, GradientAgreesWithDifferences) {
  const Ground g = rough_ground({9.0, 13.0});
  std::mt19937 random(15);
  // One lattice unit is far below the finest cell.
  const int step = g.field.sample_step();
  const glm::dvec2 unit = g.field.desc().spacing / double(step);
  for (int i = 0; i < 20000; ++i) {
    const LatticePoint p = random_point(g.field, random) / 2 + LatticePoint(step, step);
    const double x = (relief_at(g, p + LatticePoint(1, 0)) - relief_at(g, p - LatticePoint(1, 0))) / (2.0 * unit.x);
    const double y = (relief_at(g, p - LatticePoint(0, 1)) - relief_at(g, p + LatticePoint(0, 1))) / (2.0 * unit.y);
    const glm::dvec2 gradient = g.field.relief_gradient(p);
    ASSERT_NEAR(gradient.x, x, 1e-4);
    ASSERT_NEAR(gradient.y, y, 1e-4);
  }
}

// The smooth surface alone.
HeightField smooth_ground(int columns, int rows, glm::dvec2 spacing, const std::vector<float>& samples,
                          const std::vector<uint8_t>& holes = {}) {
  HeightFieldDesc desc;
  desc.columns = columns;
  desc.rows = rows;
  desc.spacing = spacing;
  desc.relief.roughness = 0.0f;
  return make(desc, samples, holes);
}

HeightField smooth_rough_ground() {
  return smooth_ground(65, 48, {9.0, 13.0}, rough_heights(65, 48, 3));
}

TEST(SmoothRelief, GoesThroughEverySample) {
  const HeightField field = smooth_rough_ground();
  const int step = field.sample_step();
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 65; ++column) {
      ASSERT_EQ(field.height(LatticePoint(column, row) * step), field.sample(column, row));
    }
  }
}

// Interpolation by Keys' kernel with a = -1/2 reproduces polynomials of second degree.
TEST(SmoothRelief, ReproducesQuadrics) {
  const auto quadric = [](double x, double y) { return 0.3 * x * x - 0.7 * x * y + 0.2 * y * y + x - 2.0 * y; };
  std::vector<float> heights;
  for (int row = 0; row < 17; ++row) {
    for (int column = 0; column < 17; ++column) heights.push_back(float(quadric(column, row)));
  }
  const HeightField field = smooth_ground(17, 17, {8.0, 8.0}, heights);
  const int step = field.sample_step();
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const LatticePoint p(step + int(random() % uint32_t(14 * step)), step + int(random() % uint32_t(14 * step)));
    const glm::dvec2 place = glm::dvec2(p) / double(step);
    ASSERT_NEAR(field.height(p), quadric(place.x, place.y), 1e-4);
  }
}

TEST(SmoothRelief, PlanesStayPlanesUpToTheBorder) {
  std::vector<float> heights;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 17; ++column) heights.push_back(float(3 * column + 8 * row));
  }
  const HeightField field = smooth_ground(17, 9, {8.0, 8.0}, heights);
  const int step = field.sample_step();
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const LatticePoint p(int(random() % uint32_t(16 * step + 1)), int(random() % uint32_t(8 * step + 1)));
    ASSERT_NEAR(field.height(p), (3.0 * p.x + 8.0 * p.y) / step, 1e-9);
  }
  EXPECT_LT(field.relief_bound(0), 1e-9);
}

// Slopes do not jump where cells and their halves meet; those of the data's triangles do.
TEST(SmoothRelief, HasNoCreases) {
  const HeightField field = smooth_rough_ground();
  const int step = field.sample_step();
  std::mt19937 random(2);
  const auto crease = [&](const HeightField& ground, LatticePoint p, LatticePoint way) {
    return std::abs(ground.height(p + way) - 2.0 * ground.height(p) + ground.height(p - way));
  };
  HeightFieldDesc desc = field.desc();
  desc.relief.smooth = false;
  const HeightField flat = make(desc, rough_heights(65, 48, 3));
  double largest = 0.0, largest_flat = 0.0;
  for (int i = 0; i < 20000; ++i) {
    LatticePoint p((1 + int(random() % 63)) * step, step + int(random() % uint32_t(45 * step)));
    largest = std::max(largest, crease(field, p, {16, 0}));
    largest_flat = std::max(largest_flat, crease(flat, p, {16, 0}));
  }
  EXPECT_LT(largest, 0.02 * largest_flat);
}

TEST(SmoothRelief, StaysWithinTheLocalBound) {
  const HeightField field = smooth_rough_ground();
  std::mt19937 random(13);
  double best = 0.0, lost = 0.0;
  int64_t checked = 0;
  for (int level = field.data_level(); level < field.max_level(); ++level) {
    for (int i = 0; i < 5000; ++i) {
      const Triangle t = random_triangle(field, level, random);
      if (!field.inside(t.apex) || !field.inside(t.left) || !field.inside(t.right)) continue;
      const double bound = field.relief_bound(t.middle(), level);
      ASSERT_LE(bound, field.relief_bound(level) * (1.0 + 1e-12));
      double largest = 0.0;
      for (int k = 0; k < 20; ++k) {
        Triangle small = t;
        while (small.level < field.max_level()) small = small.child(int(random() % 2));
        largest =
            std::max(largest, std::abs(field.height(small.apex) - plane_height(field, t, glm::dvec2(small.apex))));
      }
      ASSERT_LE(largest, bound + 1e-9) << "level " << level;
      best = std::max(best, largest / bound);
      lost += bound / std::max(largest, 1e-3);
      ++checked;
    }
  }
  EXPECT_GT(best, 0.4);
  RecordProperty("largest_share_of_the_bound", std::to_string(best));
  RecordProperty("bound_over_largest_mean", std::to_string(lost / double(checked)));
}

TEST(SmoothRelief, BoundsGrowFromChildToParent) {
  const HeightField field = smooth_rough_ground();
  std::mt19937 random(14);
  for (int i = 0; i < 20000; ++i) {
    Triangle t = random_triangle(field, field.data_level(), random);
    while (t.level < field.max_level()) {
      const Triangle child = t.child(int(random() % 2));
      ASSERT_GE(field.relief_bound(t.middle(), t.level), field.relief_bound(child.middle(), child.level));
      t = child;
    }
  }
}

TEST(SmoothRelief, GradientsAddUpToThatOfTheSurface) {
  HeightFieldDesc desc = smooth_rough_ground().desc();
  desc.relief.roughness = 0.05f;
  const HeightField field = make(desc, rough_heights(65, 48, 3));
  const int step = field.sample_step();
  const glm::dvec2 unit = desc.spacing / double(step);
  std::mt19937 random(15);
  for (int i = 0; i < 20000; ++i) {
    LatticePoint p = random_point(field, random) / 2 + LatticePoint(step, step);
    if (i % 4 == 0) p = p / step * step;
    const double x = (field.height(p + LatticePoint(1, 0)) - field.height(p - LatticePoint(1, 0))) / (2.0 * unit.x);
    const double y = (field.height(p - LatticePoint(0, 1)) - field.height(p + LatticePoint(0, 1))) / (2.0 * unit.y);
    const glm::dvec2 gradient = field.data_gradient(field.world_xy(p)) + field.relief_gradient(p);
    ASSERT_NEAR(gradient.x, x, 1e-3);
    ASSERT_NEAR(gradient.y, y, 1e-3);
  }
}

TEST(SmoothRelief, OvershootLiesWithinTheAmplitude) {
  const HeightField field = smooth_rough_ground();
  std::mt19937 random(16);
  double beyond = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double z = field.height(random_point(field, random));
    beyond = std::max({beyond, field.height_range()[0] - z, z - field.height_range()[1]});
  }
  EXPECT_GT(beyond, 0.0);
  EXPECT_LE(beyond, field.relief_amplitude());
}

TEST(SmoothRelief, SmallestFields) {
  for (const glm::ivec2 size : {glm::ivec2(2, 2), {3, 2}, {2, 7}}) {
    const HeightField field = smooth_ground(size.x, size.y, {8.0, 8.0}, rough_heights(size.x, size.y, 3));
    std::mt19937 random(17);
    for (int i = 0; i < 2000; ++i) {
      const Triangle t = random_triangle(field, field.data_level() + int(random() % 4), random);
      if (!field.inside(t.apex) || !field.inside(t.left) || !field.inside(t.right)) continue;
      const double z = field.height(t.middle());
      const double error = std::abs(z - 0.5 * (field.height(t.left) + field.height(t.right)));
      ASSERT_LE(error, field.relief_bound(t.middle(), t.level) + 1e-9);
    }
  }
}

TEST(SmoothRelief, ChangesTheFingerprint) {
  HeightFieldDesc desc = smooth_rough_ground().desc();
  desc.relief.smooth = false;
  EXPECT_NE(smooth_rough_ground().fingerprint(), make(desc, rough_heights(65, 48, 3)).fingerprint());
}

TEST(Relief, OffMeansNone) {
  const Ground g = rough_ground({9.0, 13.0});
  EXPECT_EQ(g.base.max_level(), g.base.data_level());
  EXPECT_EQ(g.base.relief_bound(0), 0.0);
  EXPECT_EQ(g.base.relief_amplitude(), 0.0);
  EXPECT_EQ(g.base.relief_gradient({12345, 54321}), glm::dvec2(0.0));
}

}  // namespace
