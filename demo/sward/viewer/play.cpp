// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/viewer/play.h"

#include <cmath>

namespace sward::tool {

namespace {

constexpr double k_foot_m = 0.28;  // half the width of a walker's track
constexpr float k_foot_depth = 0.75f;
constexpr double k_longest_step_m = 5;  // a longer one is a jump, which leaves no track
constexpr double k_rotor_above_m = 12, k_rotor_m = 7;
constexpr float k_rotor_m_s = 18;
constexpr double k_throw_m_s = 9;
constexpr size_t k_most_balls = 16;

glm::dvec3 ahead(const WalkCamera& camera) {
  return {std::cos(camera.yaw) * std::cos(camera.pitch), std::sin(camera.yaw) * std::cos(camera.pitch),
          std::sin(camera.pitch)};
}

// The first failure of several.
void note(Expected<void>& first, Expected<void> next) {
  if (first && !next) first = std::move(next);
}

template <class Id>
Expected<void> keep(std::optional<Id>& id, Expected<Id> added) {
  if (!added) return tl::unexpected(added.error());
  id = *added;
  return {};
}

}  // namespace

glm::dvec2 looked_at(const WalkCamera& camera, const Surface& ground) {
  const glm::dvec3 way = ahead(camera);
  for (double far = 0.5; far < 100; far *= 1.05) {
    const glm::dvec3 at = camera.position + far * way;
    if (ground.height(glm::dvec2(at)) >= at.z) return glm::dvec2(at);
  }
  return glm::dvec2(camera.position) + 8.0 * glm::dvec2(std::cos(camera.yaw), std::sin(camera.yaw));
}

Expected<void> Play::walk(const WalkCamera& camera, Playground& place) {
  const glm::dvec2 here(camera.position);
  if (!camera.walking) {
    feet_.reset();
    if (walker_) place.wind().remove_mover(*walker_);
    walker_.reset();
    return {};
  }
  const glm::dvec2 before = feet_.value_or(here);
  feet_ = here;
  Expected<void> done;
  if (!walker_) {
    WindMover body;
    body.position = here;
    note(done, keep(walker_, place.wind().add_mover(body)));
  } else {
    note(done, place.wind().move(*walker_, here, 0));
  }
  const double step = glm::distance(before, here);
  if (step > 0 && step < k_longest_step_m)
    note(done, place.disturbance().press_capsule(before, here, k_foot_m, k_foot_depth));
  return done;
}

Expected<void> Play::roll(double seconds, Playground& place) {
  Expected<void> done;
  for (host::RollingBall& ball : balls_) {
    const glm::dvec2 before(ball.centre);
    ball.roll(seconds, place.ground());
    if (ball.rests()) continue;
    note(done, place.disturbance().press_capsule(before, glm::dvec2(ball.centre), 0.8 * ball.radius_m, 1.0f));
  }
  return done;
}

Expected<void> Play::hover(bool toggled, const WalkCamera& camera, Playground& place) {
  if (toggled && rotor_) {
    place.wind().remove_mover(*rotor_);
    rotor_.reset();
    return {};
  }
  if (!toggled && !rotor_) return {};
  const glm::dvec2 below = looked_at(camera, place.ground());
  if (toggled) {
    WindMover rotor;
    rotor.kind = WindMover::Kind::rotor;
    rotor.position = below;
    rotor.above_ground_m = float(k_rotor_above_m);
    rotor.radius_m = float(k_rotor_m);
    rotor.strength = k_rotor_m_s;
    return keep(rotor_, place.wind().add_mover(rotor));
  }
  Expected<void> done = place.wind().move(*rotor_, below, float(k_rotor_above_m));
  note(done, place.disturbance().rotor_wash(below, 1.5 * k_rotor_m, 0.35f));
  return done;
}

Expected<void> Play::act(const PlayInput& input, const WalkCamera& camera, Playground& place) {
  if (!input.any()) return {};
  const glm::dvec2 at = looked_at(camera, place.ground()), here(camera.position);
  Disturbance& disturbance = place.disturbance();
  Expected<void> done;
  if (input.cut) note(done, disturbance.cut_capsule(here, at, 0.6, 0.06f));
  if (input.burn) note(done, disturbance.burn_disc(at, 1.5, 1.0f));
  if (input.explode) note(done, disturbance.explode(at, 5));
  if (input.regrow) note(done, disturbance.regrow(at, 30, 10));
  const double now = place.wind().time();
  if (input.gust) {
    WindSource gust;
    gust.position = here;
    gust.start_s = now;
    if (auto added = place.wind().add_source(gust); !added) note(done, tl::unexpected(added.error()));
  }
  if (input.whirlwind)
    if (auto added = place.wind().add_source(whirlwind(at, 4, 14, now)); !added)
      note(done, tl::unexpected(added.error()));
  if (input.ball) {
    if (balls_.size() == k_most_balls) balls_.erase(balls_.begin());
    host::RollingBall ball;
    const glm::dvec2 way(std::cos(camera.yaw), std::sin(camera.yaw));
    ball.centre = glm::dvec3(here + way, 0);
    ball.velocity = k_throw_m_s * way;
    balls_.push_back(ball);
  }
  return done;
}

Expected<void> Play::follow(const PlayInput& input, const WalkCamera& camera, double seconds, Playground& place) {
  Expected<void> done = walk(camera, place);
  note(done, act(input, camera, place));
  note(done, hover(input.rotor, camera, place));
  note(done, roll(seconds, place));
  return done;
}

}  // namespace sward::tool
