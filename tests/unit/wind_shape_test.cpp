// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The chain's equilibrium under gravity and wind, and the table of it.
#include <sward/vegetation/blade_shape.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sward {
namespace {

double inclination(std::span<const double> phi, int segment) {
  double sum = 0;
  for (int j = 0; j < segment; ++j) sum += phi[size_t(j)];
  return sum;
}

/// The equation of joint n (1-based), term by term as blade_shape.h has it.
double equation(std::span<const double> phi, double k_prime, double load, int n) {
  const int segments = int(phi.size());
  double torque = 0.0;
  for (int i = n; i <= segments; ++i) {
    const double t = inclination(phi, i), c = std::cos(t);
    double arm = 0.5;
    for (int j = n; j <= i - 1; ++j) {
      torque += std::sin(inclination(phi, j));
      arm += std::cos(inclination(phi, j) - t);
    }
    torque += 0.5 * std::sin(t) + load * c * std::abs(c) * arm;
  }
  return torque - k_prime * phi[size_t(n - 1)];
}

const double k_loads[] = {1e-6, 0.01, 0.3, 2.0, 30.0, 400.0};

TEST(WindEquilibrium, SolvesEveryJointsEquation) {
  for (const double k_prime : {280.0, 400.0, 520.0, 573.0}) {
    for (const double load : k_loads) {
      const auto phi = wind_equilibrium(16, k_prime, load);
      ASSERT_TRUE(phi) << phi.error().message;
      const std::vector<double> residual = wind_residual(*phi, k_prime, load);
      for (int n = 1; n <= 16; ++n) {
        EXPECT_LT(std::abs(equation(*phi, k_prime, load, n)), 1e-6) << k_prime << ' ' << load << ' ' << n;
        EXPECT_NEAR(residual[size_t(n - 1)], equation(*phi, k_prime, load, n), 1e-8 * (1 + load));
      }
    }
  }
}

TEST(WindEquilibrium, OneSegmentByHand) {
  // sin(phi)/2 + load cos^2(phi)/2 = k' phi; at phi = 1 with k' = 0.5 it is the load below.
  const double load = (1.0 - std::sin(1.0)) / (std::cos(1.0) * std::cos(1.0));
  const auto phi = wind_equilibrium(1, 0.5 * (1.0 - 1e-7), 1e-9);
  ASSERT_TRUE(phi);
  const auto blown = wind_equilibrium(1, 0.499, load * (0.499 / 0.5));
  ASSERT_TRUE(blown);
  const double p = (*blown)[0];
  EXPECT_NEAR(0.5 * std::sin(p) + 0.5 * load * (0.499 / 0.5) * std::cos(p) * std::cos(p), 0.499 * p, 1e-9);
  EXPECT_NEAR(p, 1.0, 0.01);
}

TEST(WindEquilibrium, WithoutWindIsGravitys) {
  EXPECT_EQ(*wind_equilibrium(16, 450.0, 0.0), *blade_equilibrium(16, 450.0));
}

TEST(WindEquilibrium, StrongWindFlattensAndSaturates) {
  double before = 0;
  for (const double load : {0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    const auto phi = wind_equilibrium(16, 560.0, load);
    ASSERT_TRUE(phi);
    double lateral = 0;
    for (int i = 1; i <= 16; ++i) lateral += std::sin(inclination(*phi, i)) / 16.0;
    EXPECT_GT(lateral, before);
    before = lateral;
  }
  EXPECT_GT(before, 0.97);
  // One that hangs is lifted towards the level.
  const auto hanging = wind_equilibrium(16, blade_k_prime(0.0), 0.0);
  const auto lifted = wind_equilibrium(16, blade_k_prime(0.0), 1000.0);
  EXPECT_GT(inclination(*hanging, 16), 2.2);
  EXPECT_LT(inclination(*lifted, 16), 1.7);
}

TEST(WindEquilibrium, BendsOneWay) {
  // What growth counts on when it looks for the contact with the ground at the tip alone.
  for (const double stiffness : {0.0, 0.3, 0.6, 1.0}) {
    for (const double wind : {0.5, 2.0, 8.0, 40.0}) {
      const auto phi = wind_equilibrium(16, blade_k_prime(stiffness), wind_load(wind, stiffness));
      ASSERT_TRUE(phi);
      for (const double angle : *phi) EXPECT_GE(angle, -1e-9) << stiffness << ' ' << wind;
    }
  }
}

TEST(WindEquilibrium, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double load : {-1.0, nan, infinity}) EXPECT_FALSE(wind_equilibrium(16, 400.0, load));
  EXPECT_FALSE(wind_equilibrium(65, 400.0, 1.0));
  EXPECT_FALSE(wind_equilibrium(16, 600.0, 1.0));
}

class WindTable : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = make_wind_shapes();
    ASSERT_TRUE(made) << made.error().message;
    shapes_ = std::move(*made);
    ASSERT_EQ(shapes_.texels.size(), size_t(k_wind_layers * k_blade_rows * k_blade_columns));
  }
  glm::vec4 at(int layer, int row, int column) const {
    return shapes_.texels[size_t((layer * k_blade_rows + row) * k_blade_columns + column)];
  }
  WindShapes shapes_;
};

TEST_F(WindTable, CalmLayerIsTheCalmTableBitByBit) {
  const auto calm = make_blade_shapes();
  ASSERT_TRUE(calm);
  for (int row = 0; row < k_blade_rows; ++row) {
    for (int column = 0; column < k_blade_columns; ++column) {
      const glm::vec4 still = calm->texels[size_t(row * k_blade_columns + column)];
      EXPECT_EQ(glm::vec3(at(k_calm_layer, row, column)), glm::vec3(still)) << row << ' ' << column;
      EXPECT_EQ(at(k_calm_layer, row, column).w, 1.0f);
    }
  }
}

TEST_F(WindTable, LayersRunFromStraightToFlat) {
  for (int column = 0; column < k_blade_columns; ++column) {
    EXPECT_EQ(at(0, 16, column).x, 0.0f);
    EXPECT_FLOAT_EQ(at(0, 16, column).y, 1.0f);
    EXPECT_GT(at(k_wind_layers - 1, 16, column).x, 0.8f) << column;
  }
  EXPECT_EQ(wind_of_layer(k_calm_layer), 0.0);
  EXPECT_NEAR(wind_of_layer(k_wind_layers - 1), 40.0, 1e-9);
}

TEST_F(WindTable, KeepsLengthsAboveTheGround) {
  for (int layer = 0; layer < k_wind_layers; ++layer) {
    for (int column = 0; column < k_blade_columns; ++column) {
      for (int row = 1; row < k_blade_rows; ++row) {
        const glm::vec2 step = glm::vec2(at(layer, row, column)) - glm::vec2(at(layer, row - 1, column));
        EXPECT_NEAR(glm::length(step), 1.0f / 16.0f, 1e-6f) << layer << ' ' << row << ' ' << column;
        EXPECT_GE(at(layer, row, column).y, 0.0f);
      }
    }
  }
}

TEST_F(WindTable, BendsFartherLayerByLayer) {
  for (int column = 0; column < k_blade_columns; ++column) {
    for (int layer = 1; layer < k_wind_layers; ++layer) {
      // The softest hang to the ground in calm: rising and lifting take their tips back a little.
      const float slack = column < 16 ? 0.012f : 0.0f;
      EXPECT_GE(at(layer, 16, column).x, at(layer - 1, 16, column).x - slack) << layer << ' ' << column;
    }
  }
}

}  // namespace
}  // namespace sward
