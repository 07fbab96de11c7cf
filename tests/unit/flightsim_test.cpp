// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The flight simulator's aircraft and pilot, over ground of formulas and over sward's.
#include <gtest/gtest.h>
#include <sward/terrain/bounds.h>

#include <cmath>
#include <random>

#include "flightsim/pilot.h"
#include "flightsim/place.h"

namespace flightsim {
namespace {

constexpr double k_step = 1.0 / 240;

GroundBelow plane(double height, glm::dvec2 slope) {
  return [=](glm::dvec2 xy) { return Ground{height + glm::dot(slope, xy), glm::normalize(glm::dvec3(-slope, 1))}; };
}

Aircraft rest(Aircraft aircraft, const GroundBelow& ground, double seconds) {
  Controls brakes;
  brakes.brake = 1;
  for (int i = 0; i < int(seconds / k_step); ++i) aircraft.step(brakes, k_step, ground);
  return aircraft;
}

struct Circuit {
  bool stopped = false, crashed = false;
  glm::dvec2 touch_down{0}, at_rest{0};
  double sinking = 0, highest = 0;
  glm::dvec3 last{0};
};

Circuit fly(const Strip& strip, const GroundBelow& ground, double step) {
  Aircraft aircraft = Aircraft::standing(strip.at(30, 0), strip.heading, ground);
  Pilot pilot(strip);
  Circuit flown;
  bool in_air = false;
  for (int i = 0; i < int(400 / step); ++i) {
    const double sinking = -aircraft.state().velocity.z;
    aircraft.step(pilot.fly(aircraft, step), step, ground);
    const glm::dvec2 local = strip.local(glm::dvec2(aircraft.state().position));
    flown.highest = std::max(flown.highest, aircraft.state().position.z - strip.height_m);
    if (in_air && aircraft.on_ground() && pilot.phase() == Pilot::Phase::flare) {
      flown.touch_down = local;
      flown.sinking = sinking;
    }
    in_air = !aircraft.on_ground();
    flown.crashed = aircraft.crashed();
    flown.stopped = pilot.phase() == Pilot::Phase::stopped;
    if (flown.crashed || flown.stopped) break;
  }
  flown.at_rest = strip.local(glm::dvec2(aircraft.state().position));
  flown.last = aircraft.state().position;
  return flown;
}

TEST(Aircraft, StandsOnItsWheelsAndStaysThere) {
  for (const glm::dvec2 slope : {glm::dvec2(0, 0), glm::dvec2(0.08, 0), glm::dvec2(0, -0.1), glm::dvec2(0.06, 0.07)}) {
    const GroundBelow ground = plane(100, slope);
    const Aircraft before = rest(Aircraft::standing({20, 30}, 0.7, ground), ground, 4);
    const Aircraft after = rest(before, ground, 4);
    ASSERT_FALSE(after.crashed());
    EXPECT_LT(glm::length(after.state().position - before.state().position), 1.0) << slope.x << ' ' << slope.y;
    double weight = 0;
    for (const Wheel& wheel : after.wheels()) {
      EXPECT_GT(wheel.compression, 0);
      EXPECT_LT(wheel.compression, 0.2);
      EXPECT_NEAR(wheel.contact.z, 100 + glm::dot(slope, glm::dvec2(wheel.contact)), 1e-9);
      weight += wheel.spring * wheel.compression;
    }
    const double upright = 1 / std::sqrt(1 + glm::dot(slope, slope));
    EXPECT_NEAR(weight, 1043 * 9.80665 * upright, 500);
    // It stands as the ground does, but for what the springs give way.
    const glm::dvec3 up = after.state().attitude * glm::dvec3(0, 0, 1);
    EXPECT_GT(glm::dot(up, ground({0, 0})->normal), std::cos(0.1));
  }
}

TEST(Aircraft, RollsOnSwardsGround) {
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = 129;
  desc.spacing = glm::dvec2(4);
  std::vector<float> heights;
  for (int i = 0; i < 129 * 129; ++i)
    heights.push_back(float(1.2 * std::sin(0.2 * (i % 129)) + 0.9 * std::cos(0.17 * (i / 129))));
  const auto field = sward::HeightField::create(desc, std::move(heights));
  ASSERT_TRUE(field);
  const sward::Bounds bounds = sward::Bounds::create(*field);
  const sward::FieldSurface surface(bounds);
  const GroundBelow ground = ground_below(surface);
  EXPECT_FALSE(ground({1e6, 0}));
  Aircraft aircraft = Aircraft::standing({-60, 0}, 0, ground);
  Controls idle;
  idle.throttle = 0.55;
  for (int i = 0; i < int(12 / k_step); ++i) {
    aircraft.step(idle, k_step, ground);
    for (const Wheel& wheel : aircraft.wheels()) {
      EXPECT_EQ(wheel.contact.z, surface.height(glm::dvec2(wheel.contact)));
      EXPECT_LT(wheel.compression, 0.4);
    }
  }
  EXPECT_FALSE(aircraft.crashed());
  EXPECT_GT(aircraft.state().position.x, -40);
}

TEST(Aircraft, FliesOnlyOverGround) {
  const GroundBelow end = [](glm::dvec2 xy) { return xy.x < 50 ? std::optional(Ground{}) : std::nullopt; };
  Aircraft aircraft = Aircraft::standing({0, 0}, 0, end);
  Controls full;
  full.throttle = 1;
  for (int i = 0; i < int(60 / k_step); ++i) aircraft.step(full, k_step, end);
  EXPECT_TRUE(aircraft.crashed());
  EXPECT_LT(aircraft.state().position.x, 51);
}

TEST(Aircraft, ANoseDiveEndsAtTheGround) {
  const GroundBelow ground = plane(0, {0, 0});
  Strip strip;
  Aircraft aircraft = Aircraft::standing({0, 0}, 0, ground);
  Pilot pilot(strip);
  for (int i = 0; i < int(60 / k_step); ++i) aircraft.step(pilot.fly(aircraft, k_step), k_step, ground);
  Controls down;
  down.elevator = -1;
  for (int i = 0; i < int(60 / k_step); ++i) aircraft.step(down, k_step, ground);
  EXPECT_TRUE(aircraft.crashed());
  EXPECT_LT(aircraft.state().position.z, 6);
  EXPECT_TRUE(std::isfinite(aircraft.state().position.x));
}

TEST(Pilot, LandsWhereItTookOff) {
  for (const double heading : {0.0, 0.9, 2.5, -1.7}) {
    Strip strip;
    strip.threshold = {100, -200};
    strip.heading = heading;
    strip.length_m = 700;
    strip.height_m = 35;
    const Circuit flown = fly(strip, plane(35, {0, 0}), k_step);
    EXPECT_TRUE(flown.stopped && !flown.crashed) << heading;
    EXPECT_GT(flown.highest, 110);
    EXPECT_GT(flown.touch_down.x, 0);
    EXPECT_LT(flown.touch_down.x, 250);
    EXPECT_LT(std::abs(flown.touch_down.y), 3);
    EXPECT_LT(flown.sinking, 1.5);
    EXPECT_LT(flown.at_rest.x, strip.length_m);
    EXPECT_LT(std::abs(flown.at_rest.y), 2);
  }
}

TEST(Pilot, FliesTheSameAgainAndNearlySoInHalfSteps) {
  Strip strip;
  strip.length_m = 700;
  const GroundBelow ground = plane(0, {0, 0});
  const Circuit one = fly(strip, ground, k_step), again = fly(strip, ground, k_step),
                half = fly(strip, ground, k_step / 2);
  EXPECT_EQ(one.last, again.last);
  EXPECT_LT(glm::distance(one.touch_down, half.touch_down), 8);
  EXPECT_LT(glm::distance(one.at_rest, half.at_rest), 12);
}

}  // namespace
}  // namespace flightsim
