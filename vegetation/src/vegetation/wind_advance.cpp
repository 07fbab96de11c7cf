// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How the wind goes on in time.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vegetation/wind_state.h"

namespace sward {

namespace {

// The noise drifts in calm, and with the wind slower than it: at its full speed it would only flicker.
constexpr glm::dvec2 k_drift[2] = {{0.21, 0.13}, {-0.17, 0.19}};  // m/s
constexpr double k_carried[2] = {0.22, 0.13};                     // share of the wind
constexpr double k_turning[2] = {0.23, -0.17};                    // radians a second
constexpr int64_t k_most_steps = 1200;                            // of an advance: 10 s
constexpr double k_jump_m_s = 500;
constexpr double k_passing = 1.5;

double wrapped_turn(double radians) {
  return std::remainder(radians, 2.0 * std::numbers::pi);
}

/// The share of its wind that reaches the ground.
float share_at_ground(const WindMover& mover) {
  const float ratio = mover.above_ground_m / (2.0f * mover.radius_m);
  return 1.0f / (1.0f + ratio * ratio);
}

/// A mover that does something in this advance.
struct Course {
  WindGrid::Push push;
  glm::dvec2 from{0}, to{0};
  bool coarse = false;
};

/// False when it does nothing.
bool make_course(const MovingMover& each, double seconds, Course& course) {
  const WindMover& mover = each.mover;
  course.from = each.from;
  course.to = mover.position;
  course.push.radius_m = mover.radius_m;
  course.coarse = mover.radius_m >= 1.6f;
  course.push.speed = mover.strength * share_at_ground(mover);
  const glm::dvec2 way = course.to - course.from;
  const double pace = glm::length(way) / seconds;
  if (mover.kind == WindMover::Kind::body) {
    if (!(pace > 0)) return false;
    course.push.ahead = glm::vec2(way / (pace * seconds));
    // Air has the time of passing by to take up speed: a push in proportion to pace^2 gives it the body's.
    course.push.speed *= float(pace * (1.0 + k_passing * pace * k_wind_rest_s / double(mover.radius_m)));
  }
  return pace <= k_jump_m_s && course.push.speed > 0;
}

}  // namespace

glm::dvec2 WindMapLayer::place(glm::dvec2 world) const {
  const double c = std::cos(turn) / tile_m, s = std::sin(turn) / tile_m;
  return glm::dvec2(c * world.x + s * world.y, c * world.y - s * world.x) - moved;
}

void WindMapLayer::carry(glm::dvec2 metres) {
  const double c = std::cos(turn) / tile_m, s = std::sin(turn) / tile_m;
  moved += glm::dvec2(c * metres.x + s * metres.y, c * metres.y - s * metres.x);
  moved -= glm::floor(moved);
}

void WindMapLayer::scale(double to_tile_m, glm::dvec2 about) {
  const glm::dvec2 stays = place(about);
  tile_m = to_tile_m;
  moved += place(about) - stays;
  moved -= glm::floor(moved);
}

void carry_wind_maps(WindState& state, double seconds) {
  for (size_t i = 0; i < 2; ++i) {
    state.gusts[i].carry(state.mean * seconds);
    state.noise[i].carry((state.mean * k_carried[i] + k_drift[i]) * seconds);
    state.noise_turn[i] = wrapped_turn(state.noise_turn[i] + k_turning[i] * seconds);
  }
}

void step_wind_grids(WindState& state, double seconds) {
  const glm::dvec2 eye(state.eye);
  state.fine.follow(eye);
  state.coarse.follow(eye);
  const auto last = int64_t(std::floor((state.time + seconds) / k_wind_step_s + 1e-6));
  std::vector<Course> courses;
  state.movers.for_each([&](MovingMover& each, WindMoverId) {
    Course course;
    if (seconds > 0 && make_course(each, seconds, course)) courses.push_back(course);
    each.from = each.mover.position;
  });
  int64_t step = state.steps;
  state.steps = last;
  if (last - step > k_most_steps) {
    step = last - k_most_steps;
    state.fine.clear();
    state.coarse.clear();
  }
  if (courses.empty() && state.fine.at_rest() && state.coarse.at_rest()) return;
  while (++step <= last) {
    const double way = std::clamp((double(step) * k_wind_step_s - state.time) / seconds, 0.0, 1.0);
    for (Course& course : courses) {
      course.push.at = glm::mix(course.from, course.to, way);
      state.fine.push(course.push);
      if (course.coarse) state.coarse.push(course.push);
    }
    state.fine.step();
    state.coarse.step();
  }
}

void choose_wind_sources(WindState& state) {
  std::vector<WindSourceId> over;
  std::vector<std::pair<double, const WindSource*>> going;
  const glm::dvec2 eye(state.eye);
  state.sources.for_each([&](const WindSource& source, WindSourceId id) {
    const double age = state.time - source.start_s;
    const double last = source.duration_s + double(source.reach_m / source.travel_m_s);
    if (source.repeat_s <= 0 && age > last) return over.push_back(id);
    if (age < 0) return;
    const double d = glm::length(source.position + source.velocity_m_s * age - eye);
    const double left = std::max(1.0 - d / double(source.reach_m), 1e-3 / (1.0 + d));
    const double speed = std::hypot(double(source.outward_m_s), double(source.around_m_s));
    going.emplace_back(speed * left * std::pow(std::max(d / double(source.radius_m), 1.0), -double(source.falloff)),
                       &source);
  });
  const size_t count = std::min(going.size(), size_t(k_wind_sources_at_once));
  std::partial_sort(going.begin(), going.begin() + std::ptrdiff_t(count), going.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
  state.blowing.clear();
  for (size_t i = 0; i < count; ++i) state.blowing.push_back(*going[i].second);
  for (const WindSourceId id : over) state.sources.remove(id);
}

}  // namespace sward
