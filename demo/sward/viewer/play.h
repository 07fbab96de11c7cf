// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/vegetation/disturbance.h>
#include <sward/vegetation/wind.h>
#include <optional>
#include <vector>

#include "host/rolling_ball.h"
#include "sward/viewer/camera.h"

namespace sward::tool {

/// Keys that went down in this frame.
struct PlayInput {
  bool cut = false, burn = false, explode = false, regrow = false;
  bool gust = false, whirlwind = false, rotor = false, ball = false;
  bool any() const { return cut || burn || explode || regrow || gust || whirlwind || rotor || ball; }
};

/// What is played with. Wind and disturbance are asked for when something is done to them, not before: a scene without
/// wind need not have one until then.
class Playground {
 public:
  virtual ~Playground() = default;
  virtual const Surface& ground() const = 0;
  virtual Wind& wind() = 0;
  virtual Disturbance& disturbance() = 0;
};

/// What a person does to the wind and to the ground: walking tramples and stirs the air, keys act on the place looked
/// at. Belongs to one playground: begin anew when that is replaced.
class Play {
 public:
  /// Once a frame, before it is drawn. Fails where the wind or the ground refuses, with its reason; goes on all the
  /// same.
  Expected<void> follow(const PlayInput& input, const WalkCamera& camera, double seconds, Playground& place);
  const std::vector<host::RollingBall>& balls() const { return balls_; }

 private:
  Expected<void> walk(const WalkCamera& camera, Playground& place);
  Expected<void> roll(double seconds, Playground& place);
  Expected<void> hover(bool toggled, const WalkCamera& camera, Playground& place);
  Expected<void> act(const PlayInput& input, const WalkCamera& camera, Playground& place);

  std::optional<glm::dvec2> feet_;  // where they stood while walking
  std::optional<WindMoverId> walker_, rotor_;
  std::vector<host::RollingBall> balls_;
};

/// Where the view's middle meets the ground, at most 100 m away; 8 m ahead where it does not.
glm::dvec2 looked_at(const WalkCamera& camera, const Surface& ground);

}  // namespace sward::tool
