// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a person does in the window: each key leaves in the wind and on the ground what it says, at the place looked at.
#include "sward/viewer/play.h"

#include <gtest/gtest.h>
#include <sward/terrain/bounds.h>

namespace sward {
namespace {

using tool::PlayInput;

class Hills final : public tool::Playground {
 public:
  const Surface& ground() const override { return surface_; }
  Wind& wind() override { return wind_; }
  Disturbance& disturbance() override { return disturbance_; }

 private:
  static HeightField make_field() {
    HeightFieldDesc desc;
    desc.columns = desc.rows = 65;
    desc.spacing = glm::dvec2(3);
    std::vector<float> heights;
    for (int i = 0; i < 65 * 65; ++i)
      heights.push_back(float(2 * std::sin(0.2 * (i % 65)) * std::cos(0.15 * (i / 65))));
    return *HeightField::create(desc, std::move(heights));
  }
  static Wind still() {
    Wind wind;
    Weather weather;
    weather.ambient_m_s = 0;
    EXPECT_TRUE(wind.set_weather(weather));
    return wind;
  }

  HeightField field_ = make_field();
  Bounds bounds_ = Bounds::create(field_);
  FieldSurface surface_{bounds_};
  Wind wind_ = still();
  Disturbance disturbance_ = *Disturbance::create();
};

class PlayTest : public testing::Test {
 protected:
  void SetUp() override {
    camera_.yaw = 0.3;
    camera_.pitch = -0.3;
    stand({0, 0});
    at_ = tool::looked_at(camera_, ground());
  }

  const Surface& ground() const { return place_.ground(); }
  void stand(glm::dvec2 place) { camera_.position = {place, ground().height(place) + camera_.eye_height_m}; }

  void press(const PlayInput& input, double seconds = 0) {
    const auto done = play_.follow(input, camera_, seconds, place_);
    EXPECT_TRUE(done) << done.error().message;
  }
  Disturbed touched(glm::dvec2 place) { return place_.disturbance().at(place); }
  Wind& wind() { return place_.wind(); }
  /// Strongest wind within 12 m of the place looked at, m/s.
  float strongest() {
    float most = 0;
    for (int i = 0; i < 625; ++i) {
      const glm::dvec2 place = at_ + glm::dvec2(i % 25 - 12, i / 25 - 12);
      most = std::max(most, glm::length(wind().at({place, ground().height(place)}).velocity));
    }
    return most;
  }
  void wait(double seconds) {
    for (double t = 0; t < seconds; t += 1.0 / 60) ASSERT_TRUE(wind().advance(1.0 / 60, camera_.position));
  }

  Hills place_;
  tool::WalkCamera camera_;
  tool::Play play_;
  glm::dvec2 at_{0};
};

TEST_F(PlayTest, LooksAtTheGroundAhead) {
  const double away = glm::distance(at_, glm::dvec2(camera_.position));
  EXPECT_GT(away, 3);
  EXPECT_LT(away, 12);
  // Into the sky: eight metres ahead.
  camera_.pitch = 1;
  EXPECT_NEAR(glm::distance(tool::looked_at(camera_, ground()), glm::dvec2(camera_.position)), 8, 1e-9);
}

TEST_F(PlayTest, NoKeyLeavesNothing) {
  const uint64_t before = place_.disturbance().revision();
  press({});
  press({}, 0.1);
  EXPECT_EQ(place_.disturbance().revision(), before);
  wait(1);
  EXPECT_EQ(strongest(), 0);
}

TEST_F(PlayTest, CutsBurnsBlastsAndLetsGrowAgain) {
  PlayInput cut, burn, blast, regrow;
  cut.cut = burn.burn = blast.explode = regrow.regrow = true;
  press(cut);
  const glm::dvec2 half = 0.5 * (at_ + glm::dvec2(camera_.position));
  EXPECT_GT(touched(half).cut, 0.7f);  // 6 cm are left
  EXPECT_EQ(touched(half).burn, 0);
  press(burn);
  EXPECT_GT(touched(at_).burn, 0.9f);
  EXPECT_EQ(touched(half).burn, 0);
  press(blast);
  const glm::dvec2 beside = at_ + glm::dvec2(3, 0);
  EXPECT_GT(glm::length(touched(beside).press) + touched(beside).burn, 0.3f);
  press(regrow);
  // Regrowth has a half-life: it is not there at once, but it comes.
  ASSERT_TRUE(place_.disturbance().advance(60));
  EXPECT_LT(touched(half).cut, 0.05f);
  EXPECT_LT(touched(at_).burn, 0.05f);
}

TEST_F(PlayTest, WalkingTramplesAndAJumpDoesNot) {
  for (int i = 0; i <= 10; ++i) {
    stand({0.2 * i, 0});
    press({}, 0.05);
  }
  EXPECT_GT(touched({1, 0}).press.x, 0.5f);  // plants lie the way that was walked
  EXPECT_EQ(glm::length(touched({1, 2}).press), 0);
  EXPECT_EQ(wind().movers(), 1u);
  stand({30, 0});
  press({}, 0.05);
  EXPECT_EQ(glm::length(touched({15, 0}).press), 0);
  // Whoever flies stirs no air and leaves no track.
  camera_.walking = false;
  stand({31, 0});
  press({}, 0.05);
  EXPECT_EQ(wind().movers(), 0u);
  EXPECT_EQ(glm::length(touched({30.5, 0}).press), 0);
}

TEST_F(PlayTest, GustAndWhirlwindReachThePlace) {
  PlayInput gust, whirl;
  gust.gust = whirl.whirlwind = true;
  press(gust);
  wait(2);
  EXPECT_GT(strongest(), 1);
  wait(60);
  EXPECT_LT(strongest(), 0.1f);  // a gust passes
  press(whirl);
  wait(3);
  EXPECT_GT(strongest(), 5);
}

TEST_F(PlayTest, RotorFollowsTheEyeUntilItIsSwitchedOff) {
  PlayInput rotor;
  rotor.rotor = true;
  press(rotor);
  EXPECT_EQ(wind().movers(), 2u);  // the walker's, the rotor's
  for (int i = 0; i < 60; ++i) {
    press({}, 1.0 / 60);
    wait(1.0 / 60);
  }
  EXPECT_GT(strongest(), 3);
  EXPECT_GT(glm::length(touched(at_ + glm::dvec2(5, 0)).press), 0.05f);
  press(rotor);
  EXPECT_EQ(wind().movers(), 1u);
}

TEST_F(PlayTest, ABallRollsDownATrackAndTheOldestOfMoreThanSixteenGoes) {
  PlayInput ball;
  ball.ball = true;
  press(ball);
  ASSERT_EQ(play_.balls().size(), 1u);
  for (int i = 0; i < 30; ++i) press({}, 1.0 / 60);
  const glm::dvec2 now(play_.balls()[0].centre);
  EXPECT_GT(glm::length(now), 2);
  EXPECT_GT(glm::length(touched(0.6 * now).press), 0.5f);
  for (int i = 0; i < 20; ++i) press(ball, 1.0 / 60);
  EXPECT_EQ(play_.balls().size(), 16u);
}

}  // namespace
}  // namespace sward
