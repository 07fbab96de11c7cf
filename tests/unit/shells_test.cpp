// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Layers over the ground bent by the wind keep the length of their plants (common_shells.glsl).
#include <gtest/gtest.h>

#include "vegetation/curve_twin.h"

namespace sward {
namespace {

using namespace shared;

TEST(Shells, KeepTheirLength) {
  for (const int layers : {1, 4, 9, 32}) {
    for (float intensity = 0; intensity <= 1.001f; intensity += 0.1f) {
      vec2 before = shell_place(0, layers, intensity);
      EXPECT_EQ(before, vec2(0.0f));  // the ground stays
      for (int i = 1; i <= layers; ++i) {
        const vec2 here = shell_place(i, layers, intensity);
        EXPECT_NEAR(glm::distance(before, here), 1.0f, 1e-5f) << i << " of " << layers;
        EXPECT_GT(here.y, before.y - 1e-5f);  // none crosses the one below it
        before = here;
      }
    }
  }
}

TEST(Shells, StandInStillAirAndLieDownInTheStrongestWind) {
  EXPECT_EQ(shell_place(8, 8, 0.0f), vec2(0.0f, 8.0f));
  const vec2 last = shell_step(8, 8, 1.0f);
  EXPECT_NEAR(last.x, 1.0f, 1e-6f);
  EXPECT_NEAR(last.y, 0.0f, 1e-6f);
  float before = 0;
  for (float intensity = 0.1f; intensity <= 1.001f; intensity += 0.1f) {
    EXPECT_GT(shell_place(8, 8, intensity).x, before);
    before = shell_place(8, 8, intensity).x;
  }
}

TEST(Shells, SumByHand) {
  // Two layers at intensity 1: 45 and 90 degrees.
  const vec2 tip = shell_place(2, 2, 1.0f);
  EXPECT_NEAR(tip.x, 0.70710678f + 1.0f, 1e-6f);
  EXPECT_NEAR(tip.y, 0.70710678f, 1e-6f);
}

TEST(Shells, WindBlowsAlongTheSurfaceAwayFromItsSource) {
  const vec3 normal = glm::normalize(vec3(0.3f, -0.2f, 0.9f));
  for (const vec3 to_source : {vec3(10, 0, 2), vec3(-3, 40, -1), vec3(0, -0.01f, 0.5f)}) {
    const vec3 wind = shell_wind(to_source, normal);
    EXPECT_NEAR(glm::length(wind), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(wind, normal), 0.0f, 1e-5f);
    EXPECT_LT(glm::dot(wind, to_source), 0.0f);
  }
  EXPECT_EQ(shell_wind(5.0f * normal, normal), vec3(0.0f));
}

}  // namespace
}  // namespace sward
