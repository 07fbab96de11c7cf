// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The replay of a scene's wind, and its arrows.
#include <sward/terrain/bounds.h>

#include <cmath>

#include "gl/gl_fixture.h"
#include "host/render_target.h"
#include "host/scene_wind.h"
#include "host/wind_overlay.h"

namespace sward {
namespace {

using namespace test;
using host::SceneWindReplay;

SceneWind scene() {
  SceneWind wind;
  wind.weather.speed_m_s = 6;
  WindSource gust;
  gust.position = {-30, 0};
  gust.start_s = 3;
  wind.sources = {gust, whirlwind({20, 5}, 4, 12, 1)};
  SceneWindMover walker;
  walker.path = {{2, -4, 0, 0}, {5, 2, 0, 0}, {8, 2, 6, 0}};
  SceneWindMover rotor;
  rotor.mover.kind = WindMover::Kind::rotor;
  rotor.mover.radius_m = 6;
  rotor.mover.strength = 14;
  rotor.path = {{4, 30, 30, 5}};
  wind.movers = {walker, rotor};
  return wind;
}

/// Root mean square of the difference of two winds over what is around, against the first's.
double apart(const Wind& a, const Wind& b) {
  double off = 0, all = 0;
  for (int i = 0; i < 3600; ++i) {
    const glm::dvec3 at(1.1 * (i % 60) - 30, 1.3 * (i / 60) - 35, 0);
    const WindHere p = a.at(at), q = b.at(at);
    off += double(glm::dot(p.velocity - q.velocity, p.velocity - q.velocity));
    off += double(glm::dot(p.ambient - q.ambient, p.ambient - q.ambient));
    all += double(glm::dot(p.velocity, p.velocity) + glm::dot(p.ambient, p.ambient));
  }
  return std::sqrt(off / all);
}

TEST(SceneWindReplay, AMomentIsTheSameByFramesAndAtOnce) {
  auto frames = SceneWindReplay::create(scene(), {0, 0}, {1, 1}),
       once = SceneWindReplay::create(scene(), {0, 0}, {1, 1});
  ASSERT_TRUE(frames && once);
  const glm::dvec3 eye(0, 0, 2);
  for (int i = 0; i <= 7 * 60; ++i) ASSERT_TRUE(frames->follow(i / 60.0, eye));
  ASSERT_TRUE(once->follow(7, eye));
  EXPECT_LT(apart(frames->wind(), once->wind()), 0.02);
  EXPECT_GT(glm::length(once->wind().at({2, 4.2, 0}).velocity - once->wind().at({2, 24, 0}).velocity), 0.3f);
  EXPECT_EQ(once->wind().movers(), 2u);
  // The walker's path ends; the rotor stays.
  ASSERT_TRUE(once->follow(8.5, eye));
  EXPECT_EQ(once->wind().movers(), 1u);
  // Back in time: the same again.
  ASSERT_TRUE(once->follow(7, eye));
  EXPECT_LT(apart(frames->wind(), once->wind()), 0.02);
  EXPECT_NEAR(once->wind().time(), 7, 1e-9);
  // A moment far away costs seconds of steps, not hours.
  ASSERT_TRUE(once->follow(1e7, eye));
  EXPECT_NEAR(once->wind().time(), 1e7, 1e-3);
  EXPECT_FALSE(once->follow(1e12, eye));
}

TEST(SceneWindReplay, NegativeTimeIsTheStart) {
  auto replay = SceneWindReplay::create(scene(), {0, 0}, {1, 1});
  ASSERT_TRUE(replay && replay->follow(-3, {0, 0, 2}));
  EXPECT_EQ(replay->wind().time(), 0);
}

class WindArrows : public GlTest {};

/// Pixels of storms and of calm.
struct Seen {
  int red = 0, blue = 0;
};

Seen seen(Wind& wind, const Surface& ground, host::WindOverlay& overlay) {
  const View view = View::look({0, 0, 12}, 0.4, -0.9, 0.9, {160, 120}, 0.1, 1000);
  EXPECT_TRUE(wind.advance(1, view.eye));
  auto target = host::RenderTarget::create({160, 120}, 1);
  auto frame = gl::Frame::create();
  EXPECT_TRUE(target && frame);
  frame->upload(view, gl::Lighting(), 0, 1);
  target->begin();
  const GlState before = capture_state();
  overlay.draw(*frame, view, wind, ground);
  expect_only_changed(before, capture_state(), {});
  Seen seen;
  const std::vector<uint8_t> rgb = target->read_rgb();
  for (size_t i = 0; i < rgb.size(); i += 3) {
    seen.red += rgb[i] > 200 && rgb[i + 2] < 60 && rgb[i + 1] < 120;
    seen.blue += rgb[i] < 80 && rgb[i + 2] > 180;
  }
  return seen;
}

TEST_F(WindArrows, ShowTheWindAndLeaveNothingBound) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 5;
  desc.spacing = glm::dvec2(100);
  auto field = HeightField::create(desc, std::vector<float>(25, 0.0f));
  ASSERT_TRUE(field);
  const Bounds bounds = Bounds::create(*field);
  const FieldSurface ground(bounds);
  auto overlay = host::WindOverlay::create(gl::ShaderLibrary());
  ASSERT_TRUE(overlay) << overlay.error().message;
  Wind wind;
  Weather weather;
  weather.ambient_m_s = 0;
  ASSERT_TRUE(wind.set_weather(weather));
  const Seen dead = seen(wind, ground, *overlay);
  EXPECT_EQ(dead.red + dead.blue, 0);
  weather.speed_m_s = 0.5f;
  ASSERT_TRUE(wind.set_weather(weather));
  const Seen calm = seen(wind, ground, *overlay);
  EXPECT_GT(calm.blue, 40);
  EXPECT_EQ(calm.red, 0);
  weather.speed_m_s = 40;
  ASSERT_TRUE(wind.set_weather(weather));
  const Seen storm = seen(wind, ground, *overlay);
  EXPECT_GT(storm.red, 1000);
  EXPECT_EQ(storm.blue, 0);
}

}  // namespace
}  // namespace sward
