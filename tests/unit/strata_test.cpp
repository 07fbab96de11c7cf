// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <array>

#include "unit/plant_fixtures.h"
#include "vegetation/shared_glsl.h"

namespace sward {
namespace {

using shared::Cluster;
using shared::uvec2;
using shared::vec2;

uvec2 some_id(uint32_t i) {
  const uint64_t id = (uint64_t(24) << 58) | (uint64_t(1024) << 46) | (uint64_t(1030) << 35) | (uint64_t(i) << 11);
  return {uint32_t(id), uint32_t(id >> 32)};
}

/// Equation 21 as the paper's erratum has it, the only real root of P_n = i. Its second cube root would cancel: both
/// cube roots multiply to 1/12.
double exact_root(double i) {
  const double half = 1.5 * i;
  const double first = std::cbrt(half + std::sqrt(half * half - 1.0 / 1728.0));
  return first + 1.0 / (12.0 * first) - 0.5;
}

TEST(Strata, SideIsTheRootOfTheSquarePyramidalNumbers) {
  // Near i the root moves by 1/n^2 > 1e-5 from one i to the next, so 1e-7 forgives rounding and no error.
  for (uint32_t i = 1; i <= 1000000; ++i) {
    const uint32_t expected = uint32_t(std::ceil(exact_root(i) - 1.0e-7));
    ASSERT_EQ(shared::strata_side(i - 1), expected) << "cluster " << i;
  }
}

TEST(Strata, SideIsTheShortFormulaWhereTrianglesHaveTheirClusters) {
  // Equation 22 leaves out terms that matter from side 12 on, for the first few clusters of a side.
  for (uint32_t i = 1; i <= 650; ++i) {
    ASSERT_EQ(shared::strata_side(i - 1), uint32_t(std::ceil(std::cbrt(3.0 * i) - 0.5 - 1.0e-9))) << "cluster " << i;
  }
  for (uint32_t i = 651; i <= 100000; ++i) {
    const int difference = int(shared::strata_side(i - 1)) - int(std::ceil(std::cbrt(3.0 * i) - 0.5));
    ASSERT_TRUE(difference == 0 || difference == 1) << "cluster " << i;
  }
}

TEST(Strata, EverySideGetsItsSquareOfClusters) {
  std::array<int, 20> clusters{};
  for (uint32_t i = 0; i < 2470; ++i) ++clusters[shared::strata_side(i) - 1];
  for (int n = 1; n < 20; ++n) EXPECT_EQ(clusters[n - 1], n * n);
}

TEST(Strata, ClustersPickStrataEvenly) {
  // The 20 clusters of index 30..49 lie on 5 x 5 strata.
  std::array<int, 25> cells{};
  for (uint32_t t = 0; t < 20000; ++t) {
    for (uint32_t i = 30; i < 50; ++i) {
      const Cluster c = shared::make_cluster(some_id(t), i);
      ASSERT_EQ(c.side, 5u);
      ASSERT_LT(c.stratum.x, 5u);
      ASSERT_LT(c.stratum.y, 5u);
      ++cells[c.stratum.y * 5 + c.stratum.x];
    }
  }
  EXPECT_LT(test::chi_square(cells), test::chi_square_limit(24, 3.09));
}

/// Which of 4^depth triangles of equal area, by repeated halving of the edges, holds the point (a, b).
int sub_triangle(double a, double b, int depth) {
  int cell = 0;
  for (int i = 0; i < depth; ++i) {
    a *= 2.0;
    b *= 2.0;
    int part = 0;
    if (a >= 1.0) {
      part = 1;
      a -= 1.0;
    } else if (b >= 1.0) {
      part = 2;
      b -= 1.0;
    } else if (a + b >= 1.0) {
      part = 3;
      a = 1.0 - a;
      b = 1.0 - b;
    }
    cell = 4 * cell + part;
  }
  return cell;
}

TEST(Strata, PointsCoverTheTriangleEvenly) {
  // One seed a cluster, one cluster a triangle: independent points. For a single stratum and for many.
  for (const uint32_t cluster : {0u, 20u, 100u}) {
    std::array<int, 64> seeds{}, centres{};
    for (uint32_t t = 0; t < 100000; ++t) {
      const uvec2 id = some_id(t);
      const Cluster c = shared::make_cluster(id, cluster);
      const vec2 seed = shared::seed_point(id, cluster * 8, c);
      const vec2 centre = shared::cluster_centre(id, cluster, c);
      ++seeds[sub_triangle(seed.x, seed.y, 3)];
      ++centres[sub_triangle(centre.x, centre.y, 3)];
    }
    EXPECT_LT(test::chi_square(seeds), test::chi_square_limit(63, 3.09)) << cluster;
    EXPECT_LT(test::chi_square(centres), test::chi_square_limit(63, 3.09)) << cluster;
  }
}

TEST(Strata, PointsStayInTheTriangleAndInTheirStratum) {
  for (uint32_t t = 0; t < 2000; ++t) {
    const uvec2 id = some_id(t);
    for (uint32_t cluster = 0; cluster < 40; ++cluster) {
      const Cluster c = shared::make_cluster(id, cluster);
      const vec2 p = shared::seed_point(id, cluster * 8 + 3, c);
      ASSERT_GE(p.x, 0.0f);
      ASSERT_GE(p.y, 0.0f);
      ASSERT_LE(double(p.x) + double(p.y), 1.0 + 1e-7);
      // Either the point or its mirror image lies in the stratum.
      const auto within = [&](double x, double y) {
        const double side = c.side, slack = 1e-5;
        return x * side >= c.stratum.x - slack && x * side <= c.stratum.x + 1 + slack &&
               y * side >= c.stratum.y - slack && y * side <= c.stratum.y + 1 + slack;
      };
      ASSERT_TRUE(within(p.x, p.y) || within(1.0 - double(p.y), 1.0 - double(p.x)));
    }
  }
}

TEST(Strata, ReflectionFollowsEquations23And24) {
  const vec2 cases[][2] = {{{0.2f, 0.3f}, {0.2f, 0.3f}},
                           {{0.75f, 0.5f}, {0.5f, 0.25f}},
                           {{0.5f, 0.5f}, {0.5f, 0.5f}},
                           {{0.25f, 1.0f}, {0.0f, 0.75f}},
                           {{0.875f, 0.0f}, {0.875f, 0.0f}}};
  for (const auto& pair : cases) {
    const vec2 r = shared::reflect_onto_triangle(pair[0]);
    EXPECT_EQ(r.x, pair[1].x);
    EXPECT_EQ(r.y, pair[1].y);
  }
}

TEST(Strata, ExtremeRandomNumbersStayInTheTriangle) {
  for (const uint32_t side : {1u, 3u, 7u, 100u}) {
    Cluster c{};
    c.side = side;
    c.stratum = uvec2(side - 1, side - 1);
    const vec2 p = shared::point_in_stratum(c, uvec2(0xffffffff, 0xffffffff));
    EXPECT_GE(p.x, 0.0f);
    EXPECT_GE(p.y, 0.0f);
    EXPECT_LE(p.x + p.y, 1.0f);
  }
}

TEST(SurfaceWalk, LeadsToTheLeafAndItsHeight) {
  // m = (1/2, 1/2) at 10; its child 0, (m, apex, left), is split once more: at (1/2, 0), height 20.
  shared::SurfaceWalk w = shared::begin_walk(0.0f, 0.0f, 0.0f, vec2(0.5f, 0.0f));
  EXPECT_EQ(shared::walk_turn(w), 0u);
  w = shared::walk_down(w, 10.0f);
  EXPECT_EQ(w.w_left, 0.5f);
  EXPECT_EQ(w.w_right, 0.5f);
  EXPECT_EQ(w.w_apex, 0.0f);
  EXPECT_EQ(shared::walk_height(w), 0.0f);
  w = shared::walk_down(w, 20.0f);
  EXPECT_EQ(shared::walk_height(w), 20.0f);
  // On the other side, half-way from m to right.
  w = shared::begin_walk(0.0f, 0.0f, 4.0f, vec2(0.25f, 0.75f));
  EXPECT_EQ(shared::walk_turn(w), 1u);
  w = shared::walk_down(w, 10.0f);
  EXPECT_EQ(shared::walk_height(w), 7.0f);
}

}  // namespace
}  // namespace sward
