// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/blade_shape.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sward {
namespace {

double sum(std::span<const double> v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

double inclination(std::span<const double> phi, int segment) {
  return sum(phi.first(size_t(segment)));
}

/// The mended equation 12 for joint n (1-based), term by term as CONTRACT has it.
double equation(std::span<const double> phi, double k_prime, int n) {
  const int segments = int(phi.size());
  double torque = 0.0;
  for (int i = n; i <= segments; ++i) {
    for (int j = n; j <= i - 1; ++j) torque += std::sin(inclination(phi, j));
    torque += 0.5 * std::sin(inclination(phi, i));
  }
  return torque - k_prime * phi[n - 1];
}

/// Equation 12 as printed: j from 1, the subtraction behind the outer sum.
double misprinted_equation(std::span<const double> phi, double k_prime, int n) {
  const int segments = int(phi.size());
  double torque = 0.0;
  for (int i = n; i <= segments; ++i) {
    for (int j = 1; j <= i - 1; ++j) torque += std::sin(inclination(phi, j));
    torque += 0.5 * std::sin(inclination(phi, i));
  }
  for (int i = 1; i <= n - 1; ++i) torque -= std::sin(inclination(phi, i));
  return torque - k_prime * phi[n - 1];
}

const struct {
  int segments;
  double k_prime;
} k_cases[] = {{1, 0.3},    {2, 1.0},    {3, 0.5},    {3, 4.0},      {3, 5.6},  {8, 10.0}, {8, 60.0},
               {16, 100.0}, {16, 400.0}, {16, 573.0}, {64, 20000.0}, {64, 1.0}, {16, 1e-6}};

TEST(BladeEquilibrium, SolvesEveryJointsEquation) {
  for (const auto& c : k_cases) {
    const auto phi = blade_equilibrium(c.segments, c.k_prime);
    ASSERT_TRUE(phi) << phi.error().message;
    ASSERT_EQ(int(phi->size()), c.segments);
    const std::vector<double> residual = blade_residual(*phi, c.k_prime);
    for (int n = 1; n <= c.segments; ++n) {
      EXPECT_LT(std::abs(equation(*phi, c.k_prime, n)), 1e-6) << c.segments << ' ' << c.k_prime << ' ' << n;
      EXPECT_NEAR(residual[n - 1], equation(*phi, c.k_prime, n), 1e-9);
    }
  }
}

TEST(BladeEquilibrium, IsBentAndBendsTowardsOneSide) {
  for (const auto& c : k_cases) {
    const auto phi = blade_equilibrium(c.segments, c.k_prime);
    ASSERT_TRUE(phi);
    EXPECT_GT(sum(*phi), 0.05);
    EXPECT_LE(sum(*phi), 3.1415927);
    for (int n = 0; n < c.segments; ++n) EXPECT_GE((*phi)[n], -1e-12);
  }
}

TEST(BladeEquilibrium, Equation11ForThreeSegments) {
  const double k_prime = 3.0;
  const auto phi = blade_equilibrium(3, k_prime);
  ASSERT_TRUE(phi);
  const double p1 = (*phi)[0], p2 = (*phi)[1], p3 = (*phi)[2];
  EXPECT_NEAR(2.5 * std::sin(p1) + 1.5 * std::sin(p1 + p2) + 0.5 * std::sin(p1 + p2 + p3), k_prime * p1, 1e-9);
  EXPECT_NEAR(1.5 * std::sin(p1 + p2) + 0.5 * std::sin(p1 + p2 + p3), k_prime * p2, 1e-9);
  EXPECT_NEAR(0.5 * std::sin(p1 + p2 + p3), k_prime * p3, 1e-9);
}

TEST(BladeEquilibrium, MisprintedEquationFails) {
  const auto phi = blade_equilibrium(3, 3.0);
  ASSERT_TRUE(phi);
  // Joint 1 is the same in both; from joint 2 on the printed form counts the segments below the joint.
  EXPECT_LT(std::abs(misprinted_equation(*phi, 3.0, 1)), 1e-6);
  EXPECT_GT(std::abs(misprinted_equation(*phi, 3.0, 2)), 0.1);
}

TEST(BladeEquilibrium, OneSegmentByHand) {
  // sin(phi) / 2 = k' phi: k' = sin(2)/4 has phi = 2.
  const auto phi = blade_equilibrium(1, std::sin(2.0) / 4.0);
  ASSERT_TRUE(phi);
  EXPECT_NEAR((*phi)[0], 2.0, 1e-9);
}

TEST(BladeEquilibrium, TipRisesWithStiffness) {
  for (const int segments : {3, 8, 16}) {
    const double critical = segments == 3 ? 5.69 : segments == 8 ? 78.9 : 574.2;
    double before = 3.15;
    for (int i = 1; i <= 40; ++i) {
      const auto phi = blade_equilibrium(segments, critical * i / 40.0);
      ASSERT_TRUE(phi);
      EXPECT_LT(sum(*phi), before) << segments << ' ' << i;
      before = sum(*phi);
    }
    EXPECT_LT(before, 0.2);
  }
}

TEST(BladeEquilibrium, EndsAtTheCriticalStiffness) {
  // Largest eigenvalue of the linearised chain: 5.70, 78.9, 574.3.
  EXPECT_TRUE(blade_equilibrium(3, 5.69));
  EXPECT_FALSE(blade_equilibrium(3, 5.71));
  EXPECT_TRUE(blade_equilibrium(8, 78.8));
  EXPECT_FALSE(blade_equilibrium(8, 79.1));
  EXPECT_TRUE(blade_equilibrium(16, 574.0));
  EXPECT_FALSE(blade_equilibrium(16, 574.6));
  EXPECT_NE(blade_equilibrium(16, 600.0).error().message.find("574.2"), std::string::npos);
}

TEST(BladeEquilibrium, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const int segments : {0, -1, 65}) EXPECT_FALSE(blade_equilibrium(segments, 1.0));
  for (const double k_prime : {0.0, -1.0, nan, infinity}) EXPECT_FALSE(blade_equilibrium(8, k_prime));
}

class Shapes : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = make_blade_shapes();
    ASSERT_TRUE(made) << made.error().message;
    shapes_ = std::move(*made);
    ASSERT_EQ(shapes_.texels.size(), size_t(k_blade_rows * k_blade_columns));
  }
  glm::vec4 at(int row, int column) const { return shapes_.texels[row * k_blade_columns + column]; }
  BladeShapes shapes_;
};

TEST_F(Shapes, KeepTheirLengthAboveTheGround) {
  for (int column = 0; column < k_blade_columns; ++column) {
    EXPECT_EQ(at(0, column).x, 0.0f);
    EXPECT_EQ(at(0, column).y, 0.0f);
    for (int row = 1; row < k_blade_rows; ++row) {
      const glm::vec2 step = glm::vec2(at(row, column)) - glm::vec2(at(row - 1, column));
      EXPECT_NEAR(glm::length(step), 1.0f / 16.0f, 1e-6f) << row << ' ' << column;
      EXPECT_GE(at(row, column).y, 0.0f);
      EXPECT_EQ(at(row, column).w, 0.0f);
    }
  }
}

TEST_F(Shapes, InclinationsAreThoseOfTheSegments) {
  for (int column = 0; column < k_blade_columns; column += 9) {
    for (int row = 0; row < k_blade_rows; ++row) {
      const int below = std::max(row, 1), above = std::min(row + 1, k_blade_rows - 1);
      const glm::vec2 first = glm::vec2(at(below, column)) - glm::vec2(at(below - 1, column));
      const glm::vec2 second = glm::vec2(at(above, column)) - glm::vec2(at(above - 1, column));
      const float mean = 0.5f * (std::atan2(first.x, first.y) + std::atan2(second.x, second.y));
      EXPECT_NEAR(at(row, column).z, mean, 1e-4f);
    }
  }
}

TEST_F(Shapes, FollowTheEquilibriumWhereTheGroundIsFar) {
  const int column = k_blade_columns - 1;
  const auto phi = blade_equilibrium(16, blade_k_prime(1.0));
  ASSERT_TRUE(phi);
  glm::dvec2 point(0.0);
  for (int segment = 1; segment <= 16; ++segment) {
    point += glm::dvec2(std::sin(inclination(*phi, segment)), std::cos(inclination(*phi, segment))) / 16.0;
    EXPECT_NEAR(at(segment, column).x, point.x, 1e-6);
    EXPECT_NEAR(at(segment, column).y, point.y, 1e-6);
  }
}

TEST_F(Shapes, RangeFromHangingToNearlyStraight) {
  EXPECT_EQ(at(16, 0).y, 0.0f);
  EXPECT_GT(at(16, k_blade_columns - 1).y, 0.99f);
  EXPECT_GT(at(16, k_blade_columns - 1).x, 0.01f);
  // The middle of the range stands, bent: neither lies nor is straight.
  EXPECT_GT(at(16, k_blade_columns / 2).y, 0.2f);
  EXPECT_LT(at(16, k_blade_columns / 2).y, 0.9f);
}

TEST_F(Shapes, DeflectLessTheStifferTheyAre) {
  const glm::vec2 straight(0.0f, 1.0f);
  for (int column = 1; column < k_blade_columns; ++column) {
    EXPECT_GE(at(16, column).y, at(16, column - 1).y);
    EXPECT_LT(glm::length(glm::vec2(at(16, column)) - straight), glm::length(glm::vec2(at(16, column - 1)) - straight))
        << column;
    EXPECT_GT(blade_k_prime(column / 63.0), blade_k_prime((column - 1) / 63.0));
  }
  EXPECT_LT(blade_k_prime(1.0), 574.25);
  EXPECT_EQ(blade_k_prime(2.0), blade_k_prime(1.0));
}

TEST(BladeScaling, ShapesOfAnyNumberOfSegmentsAgree) {
  // k' goes with the cube of the number of segments: the same blade in 16 and 64 pieces has nearly the same tip.
  const auto coarse = blade_equilibrium(16, 0.09 * 4096.0), fine = blade_equilibrium(64, 0.09 * 262144.0);
  ASSERT_TRUE(coarse && fine);
  EXPECT_NEAR(sum(*coarse), sum(*fine), 0.15);
}

}  // namespace
}  // namespace sward
