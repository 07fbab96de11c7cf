// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What moves among the plants: the grids of velocity and acceleration around the viewer.
#include <sward/vegetation/wind.h>

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "vegetation/wind_grid.h"
#include "vegetation/wind_state.h"

namespace sward {
namespace {

Wind dead_air() {
  Wind wind;
  Weather weather;
  weather.ambient_m_s = 0;
  EXPECT_TRUE(wind.set_weather(weather));
  return wind;
}

WindMover walker(glm::dvec2 at) {
  WindMover mover;
  mover.position = at;
  return mover;
}

double energy(const WindGrid& grid) {
  double sum = 0;
  for (const glm::vec2 v : grid.velocity()) sum += double(glm::dot(v, v));
  return sum;
}

/// Walks for `seconds` along a circle of 12 m at `pace`, in frames; near a rotor, where there is one.
Wind walked(double seconds, double pace, int frames_a_second, bool rotor_too = true) {
  Wind wind = dead_air();
  const auto place = [&](double t) {
    return glm::dvec2(500, 300) + 12.0 * glm::dvec2(std::cos(pace * t / 12), std::sin(pace * t / 12));
  };
  const auto id = wind.add_mover(walker(place(0)));
  WindMover rotor{.kind = WindMover::Kind::rotor, .position = {520, 290}};
  rotor.radius_m = 6;
  rotor.strength = 15;
  EXPECT_TRUE(id && (!rotor_too || wind.add_mover(rotor)));
  const int frames = int(std::lround(seconds * frames_a_second));
  for (int i = 1; i <= frames; ++i) {
    const glm::dvec2 at = place(double(i) / frames_a_second);
    EXPECT_TRUE(wind.move(*id, at, 0));
    EXPECT_TRUE(wind.advance(1.0 / frames_a_second, {at, 1.7}));
  }
  return wind;
}

/// Root mean square of their difference, against the second's.
double apart(const Wind& a, const Wind& b) {
  double squares = 0, off = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 at(485 + 0.7 * (i % 63), 270 + 0.9 * (i / 63), 0);
    const glm::vec2 v = b.at(at).velocity, by = a.at(at).velocity - v;
    squares += double(glm::dot(v, v));
    off += double(glm::dot(by, by));
  }
  EXPECT_GT(squares, 10);
  return std::sqrt(off / squares);
}

TEST(WindMovers, FieldsAreEqualAt30And60And240FramesASecond) {
  for (const bool rotor : {false, true}) {
    const Wind fast = walked(10, 8, 240, rotor);
    EXPECT_LT(apart(walked(10, 8, 30, rotor), fast), 0.02);
    EXPECT_LT(apart(walked(10, 8, 60, rotor), fast), 0.02);
  }
}

TEST(WindMovers, AirMovesAheadOfABodyAndNotBehind) {
  Wind wind = dead_air();
  const auto id = wind.add_mover(walker({0, 0}));
  for (int i = 1; i <= 120; ++i) {
    ASSERT_TRUE(wind.move(*id, {i / 60.0 * 1.5, 0}, 0));
    ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 1.7}));
  }
  const glm::vec2 ahead = wind.at({3.5, 0, 0}).velocity, behind = wind.at({1.0, 0, 0}).velocity;
  EXPECT_GT(ahead.x, 0.5f);
  EXPECT_LT(behind.x, 0.3f * ahead.x);
  EXPECT_GT(wind.at({3.3, 0.8, 0}).velocity.y, 0.1f) << "outwards to the left";
  EXPECT_LT(wind.at({3.3, -0.8, 0}).velocity.y, -0.1f) << "and to the right";
  EXPECT_LT(glm::length(wind.at({-4, 0, 0}).velocity), 1e-4f);
}

TEST(WindMovers, AirTakesUpAboutTheSpeedOfWhatPasses) {
  for (const float radius : {0.6f, 2.0f, 5.0f})
    for (const double pace : {1.5, 5.0, 20.0}) {
      Wind wind = dead_air();
      WindMover mover = walker({-20, 0});
      mover.radius_m = radius;
      const auto id = wind.add_mover(mover);
      double most = 0;
      for (double x = -20; x < 10; x += pace / 60) {
        ASSERT_TRUE(wind.move(*id, {x, 0}, 0));
        ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 1.7}));
        for (double by = -2; by < 2; by += 0.1)
          most = std::max(most, double(wind.at({x + by * double(radius), 0, 0}).velocity.x));
      }
      EXPECT_GT(most, 0.6 * pace) << radius;
      EXPECT_LT(most, 1.5 * pace) << radius;
    }
}

// A kilometre across both axes of the torus, against a grid that holds all of the way and never shifts.
TEST(WindMovers, AKilometreOfWalkingLeavesNoSeam) {
  WindGrid follows(128, 0.5), stays(2048, 0.5);
  constexpr double k_pace = 8;
  const glm::dvec2 way = glm::normalize(glm::dvec2(1, 0.3));
  const glm::dvec2 start = -500.0 * way;
  float worst = 0, strongest = 0;
  int shifts = 0;
  glm::dvec2 cell{0};
  const auto compare = [&](glm::dvec2 eye) {
    for (int y = -24; y <= 24; y += 2)
      for (int x = -24; x <= 24; x += 2) {
        const glm::dvec2 at = eye + 0.97 * glm::dvec2(x, y);
        const glm::vec2 exact = stays.sample(glm::vec2(at / 1024.0)), here = follows.sample(glm::vec2(at / 64.0));
        worst = std::max(worst, glm::length(exact - here));
        strongest = std::max(strongest, glm::length(exact));
      }
  };
  const auto steps = int(1000 / (k_pace * k_wind_step_s));
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 eye = start + way * (k_pace * k_wind_step_s * i);
    follows.follow(eye);
    const bool shifted = glm::floor(eye / 0.5) != cell;
    cell = glm::floor(eye / 0.5);
    for (WindGrid* grid : {&follows, &stays}) {
      grid->push({eye, glm::vec2(way), 0.8f, 40});
      grid->step();
    }
    shifts += shifted;
    if (shifted && i % 7 == 0) compare(eye);
  }
  EXPECT_GT(shifts, 2000);
  EXPECT_GT(strongest, 2.0f);
  EXPECT_LT(worst, 1e-3f * strongest);
}

TEST(WindMovers, WhatTheGridLeavesDoesNotComeBackOnItsOtherSide) {
  for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
    WindGrid grid(128, 0.5);
    const glm::dvec2 place = -28.0 * way;
    for (int i = 0; i < 30; ++i) {
      grid.push({place, glm::vec2(0), 2, 10});
      grid.step();
    }
    const auto most = [&] {
      float speed = 0;
      for (const glm::vec2 v : grid.velocity()) speed = std::max(speed, glm::length(v));
      return speed;
    };
    EXPECT_GT(most(), 1);
    for (int i = 1; i <= 20; ++i) grid.follow(way * (0.5 * i));
    EXPECT_LT(most(), 1e-4f);
    grid.step();
    EXPECT_TRUE(grid.at_rest());
  }
}

TEST(WindMovers, AirDoesNotFlowAroundTheTorus) {
  for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
    WindGrid grid(128, 0.5);
    for (int i = 0; i < 120; ++i) {
      grid.push({31.0 * way, glm::vec2(0), 1, 20});
      grid.step();
    }
    EXPECT_GT(glm::length(grid.sample(glm::vec2(30.2 * way / 64.0))), 1);
    EXPECT_EQ(glm::length(grid.sample(glm::vec2(-31.0 * way / 64.0))), 0);
  }
}

TEST(WindMovers, EnergyDecaysToZeroAfterTheyStop) {
  Wind wind = walked(5, 4, 60);
  const WindState& state = wind.state();
  // The rotor goes on: away with it, by going far from it and back.
  Wind alone = dead_air();
  const auto id = alone.add_mover(walker({500, 300}));
  for (int i = 1; i <= 120; ++i) {
    ASSERT_TRUE(alone.move(*id, {500 + 0.05 * i, 300}, 0));
    ASSERT_TRUE(alone.advance(1 / 60.0, {500, 300, 0}));
  }
  EXPECT_GT(energy(state.coarse), 10) << "the rotor's";
  double before = energy(alone.state().fine);
  EXPECT_GT(before, 1);
  for (int second = 0; second < 12; ++second) {
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(alone.advance(1 / 60.0, {500, 300, 0}));
    const double now = energy(alone.state().fine);
    EXPECT_LE(now, second == 0 ? before : 0.5 * before) << second;
    before = now;
  }
  EXPECT_EQ(before, 0);
  EXPECT_TRUE(alone.state().fine.at_rest());
}

TEST(WindMovers, RotorsBlowOutwardsAndAreSeenFromAfar) {
  for (const double away : {0.0, 90.0}) {
    Wind wind = dead_air();
    WindMover rotor{.kind = WindMover::Kind::rotor, .position = {away, 0}};
    rotor.radius_m = 7;
    rotor.strength = 16;
    ASSERT_TRUE(wind.add_mover(rotor));
    for (int i = 0; i < 240; ++i) ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 2}));
    const auto outwards = [&](double d, double turn) {
      const glm::dvec2 to(std::cos(turn), std::sin(turn));
      return glm::dot(glm::dvec2(wind.at({away + d * to.x, d * to.y, 0}).velocity), to);
    };
    for (const double turn : {0.3, 2.0, 4.4}) {
      EXPECT_NEAR(outwards(5, turn), 16, 2.5) << away;
      EXPECT_LT(outwards(14, turn), 4) << away;
    }
    EXPECT_LT(glm::length(wind.at({away, 0, 0}).velocity), 1.5f);
  }
}

TEST(WindMovers, TheHigherTheLess) {
  const auto speed = [](float above) {
    Wind wind = dead_air();
    WindMover rotor{.kind = WindMover::Kind::rotor};
    rotor.radius_m = 7;
    rotor.strength = 16;
    rotor.above_ground_m = above;
    EXPECT_TRUE(wind.add_mover(rotor));
    for (int i = 0; i < 240; ++i) EXPECT_TRUE(wind.advance(1 / 60.0, {0, 0, 2}));
    return wind.at({5, 0, 0}).velocity.x;
  };
  EXPECT_NEAR(speed(14) / speed(0), 0.5f, 0.01f);
  EXPECT_LT(speed(100), 0.05f * speed(0));
}

TEST(WindMovers, AJumpStirsNothingAndNeitherDoesFarAway) {
  Wind wind = dead_air();
  const auto near = wind.add_mover(walker({0, 0})), far = wind.add_mover(walker({5000, 0}));
  ASSERT_TRUE(wind.move(*near, {20, 0}, 0));
  ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 0}));
  EXPECT_TRUE(wind.state().fine.at_rest());
  ASSERT_TRUE(wind.move(*far, {5000.1, 0}, 0));
  ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 0}));
  EXPECT_TRUE(wind.state().fine.at_rest());
  ASSERT_TRUE(wind.move(*near, {20.1, 0}, 0));
  ASSERT_TRUE(wind.advance(1 / 60.0, {0, 0, 0}));
  EXPECT_FALSE(wind.state().fine.at_rest());
  // And the viewer's jump leaves that behind.
  ASSERT_TRUE(wind.advance(1 / 60.0, {9000, 0, 0}));
  EXPECT_TRUE(wind.state().fine.at_rest());
}

TEST(WindMovers, ALongAdvanceIsBounded) {
  Wind wind = dead_air();
  const auto id = wind.add_mover(walker({0, 0}));
  ASSERT_TRUE(wind.move(*id, {10, 0}, 0));
  ASSERT_TRUE(wind.advance(1e9, {0, 0, 0}));  // would be 1.2e11 steps
  EXPECT_EQ(wind.time(), 1e9);
}

TEST(WindMovers, ThousandsAreFiniteAndMoreAreRefused) {
  Wind wind = dead_air();
  std::vector<WindMoverId> ids;
  for (uint32_t i = 0; i < k_most_wind_movers; ++i) {
    const auto id = wind.add_mover(walker({0.001 * i, 0}));
    ASSERT_TRUE(id);
    ids.push_back(*id);
  }
  const auto refused = wind.add_mover(walker({0, 0}));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("remove one first"), std::string::npos);
  for (size_t i = 0; i < ids.size(); ++i) ASSERT_TRUE(wind.move(ids[i], {0.001 * double(i), 0.5}, 0));
  ASSERT_TRUE(wind.advance(0.1, {8, 0, 0}));
  for (const glm::vec2 v : wind.state().fine.velocity()) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y));
  EXPECT_TRUE(wind.remove_mover(ids[0]));
  EXPECT_FALSE(wind.remove_mover(ids[0]));
  EXPECT_FALSE(wind.move(ids[0], {0, 0}, 0)) << "a removed one";
  EXPECT_TRUE(wind.add_mover(walker({0, 0})));
}

TEST(WindMovers, BadOnesAreRefusedAndNothingChanges) {
  Wind wind = dead_air();
  const auto id = wind.add_mover(walker({1, 2}));
  const float bads[] = {-1, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  for (const float bad : bads) {
    for (float WindMover::*member : {&WindMover::radius_m, &WindMover::strength, &WindMover::above_ground_m}) {
      WindMover mover = walker({0, 0});
      mover.*member = bad;
      EXPECT_FALSE(wind.add_mover(mover));
    }
    EXPECT_FALSE(wind.move(*id, {0, 0}, bad));
    if (bad != -1) {
      EXPECT_FALSE(wind.move(*id, {bad, 0}, 0));
    }
  }
  WindMover point = walker({0, 0});
  point.radius_m = 0;
  EXPECT_FALSE(wind.add_mover(point));
  EXPECT_EQ(wind.movers(), 1u);
  ASSERT_TRUE(wind.advance(1, {0, 0, 0}));
  EXPECT_TRUE(wind.state().fine.at_rest()) << "it never moved";
}

}  // namespace
}  // namespace sward
