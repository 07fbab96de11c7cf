// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "flightsim/aircraft.h"

#include <algorithm>
#include <cmath>

namespace flightsim {

namespace {

constexpr double k_gravity = 9.80665, k_air_density = 1.225;
constexpr double k_mass = 1043, k_wing_m2 = 16.2, k_span_m = 11.0, k_chord_m = 1.49;
constexpr glm::dvec3 k_inertia{1285, 1825, 2667};  // kg m2, body axes
constexpr double k_stall_rad = 0.28;
constexpr double k_grass_rolls = 0.06, k_grass_brakes = 0.35, k_grass_holds = 0.6;  // of the load on a wheel
constexpr double k_slip_m_s = 0.4;                                                  // friction is in full from here on
constexpr double k_steering_rad = 0.35;

// What must stay clear of the ground: propeller, tail, wing tips.
constexpr glm::dvec3 k_parts[]{{1.9, 0, -0.85}, {-4.9, 0, -0.1}, {0, 5.5, 0.9}, {0, -5.5, 0.9}};

// Lift grows with the angle of attack up to the stall and is lost beyond it.
double lift_coefficient(double alpha, const Controls& controls, double pitch_rate) {
  const double held = std::clamp(alpha, -k_stall_rad, k_stall_rad);
  const double beyond = std::abs(alpha - held);
  return (0.31 + 4.8 * held + 0.65 * controls.flaps + 3.9 * pitch_rate - 0.35 * controls.elevator * 0.4) *
         std::exp(-4 * beyond);
}

double thrust(double throttle, double forward) {
  return throttle * std::clamp(2900 - 24 * forward, 0.0, 2900.0);
}

}  // namespace

Aircraft Aircraft::standing(glm::dvec2 place, double heading, const GroundBelow& ground) {
  Aircraft made;
  made.wheels_[0] = {{1.05, 0, -1.3}, 26000, 3200, true, 0, {}};
  made.wheels_[1] = {{-0.45, 1.25, -1.3}, 48000, 5600, false, 0, {}};
  made.wheels_[2] = {{-0.45, -1.25, -1.3}, 48000, 5600, false, 0, {}};
  const Ground here = ground(place).value_or(Ground{});
  const glm::dvec3 nose(std::cos(heading), std::sin(heading), 0);
  const glm::dvec3 up = here.normal, forward = glm::normalize(nose - glm::dot(nose, up) * up);
  made.state_.attitude = glm::quat_cast(glm::dmat3(forward, glm::cross(up, forward), up));
  made.state_.position = glm::dvec3(place, here.height) + 1.25 * up;  // springs settle within a second
  return made;
}

Aircraft::Load Aircraft::air(const Controls& controls) const {
  // The field's usual axes: x forward, y right, z down.
  const glm::dvec3 body = glm::inverse(state_.attitude) * state_.velocity;
  const double speed = std::max(glm::length(body), 0.1);
  const double alpha = std::atan2(-body.z, std::max(body.x, 0.1)),
               beta = std::asin(std::clamp(-body.y / speed, -1.0, 1.0));
  const double p = state_.rates.x * k_span_m / (2 * speed), r = -state_.rates.z * k_span_m / (2 * speed);
  const double q = -state_.rates.y * k_chord_m / (2 * speed);
  const double pressure = 0.5 * k_air_density * speed * speed * k_wing_m2;

  const double lift = lift_coefficient(alpha, controls, q);
  const double drag = 0.032 + 0.054 * lift * lift + 0.06 * controls.flaps + 0.3 * beta * beta;
  const double side = -0.4 * beta + 0.12 * controls.rudder * 0.3;
  const double roll = -0.09 * beta - 0.47 * p + 0.1 * r + 0.05 * controls.aileron;
  const double pitch = 0.02 - 0.9 * alpha - 12.4 * q + 0.45 * controls.elevator - 0.06 * controls.flaps;
  const double yaw = 0.065 * beta - 0.03 * p - 0.1 * r + 0.022 * controls.rudder - 0.004 * controls.aileron;

  const double cosine = std::cos(alpha), sine = std::sin(alpha);
  const glm::dvec3 force(pressure * (lift * sine - drag * cosine) + thrust(controls.throttle, body.x), -pressure * side,
                         pressure * (lift * cosine + drag * sine));
  const glm::dvec3 moment = pressure * glm::dvec3(k_span_m * roll, -k_chord_m * pitch, -k_span_m * yaw);
  return {state_.attitude * force, moment};
}

Aircraft::Load Aircraft::wheel(Wheel& wheel, const Controls& controls, const GroundBelow& ground) {
  const glm::dvec3 arm = state_.attitude * wheel.offset, at = state_.position + arm;
  const auto below = ground(glm::dvec2(at));
  wheel.compression = 0;
  if (!below) {
    crashed_ = true;
    return {};
  }
  wheel.contact = {glm::dvec2(at), below->height};
  const double depth = (below->height - at.z) * below->normal.z;
  if (depth <= 0) return {};
  wheel.compression = depth;
  const glm::dvec3 velocity = state_.velocity + state_.attitude * glm::cross(state_.rates, wheel.offset);
  const double load = std::max(wheel.spring * depth - wheel.damper * glm::dot(velocity, below->normal), 0.0);

  const double turned = wheel.steered ? -k_steering_rad * controls.rudder : 0.0;
  const glm::dvec3 pointing = state_.attitude * glm::dvec3(std::cos(turned), std::sin(turned), 0);
  const glm::dvec3 along = glm::normalize(pointing - glm::dot(pointing, below->normal) * below->normal);
  const glm::dvec3 across = glm::cross(below->normal, along);
  const auto share = [&](const glm::dvec3& way) { return std::clamp(glm::dot(velocity, way) / k_slip_m_s, -1.0, 1.0); };
  const double rolling = k_grass_rolls + (wheel.steered ? 0 : k_grass_brakes * controls.brake);
  const glm::dvec3 force =
      load * (below->normal - rolling * share(along) * along - k_grass_holds * share(across) * across);
  return {force, glm::cross(wheel.offset, glm::inverse(state_.attitude) * force)};
}

bool Aircraft::touches(const GroundBelow& ground) const {
  return std::any_of(std::begin(k_parts), std::end(k_parts), [&](const glm::dvec3& part) {
    const glm::dvec3 at = state_.position + state_.attitude * part;
    const auto below = ground(glm::dvec2(at));
    return !below || at.z < below->height;
  });
}

void Aircraft::step(const Controls& controls, double seconds, const GroundBelow& ground) {
  if (crashed_) return;
  Load load = air(controls);
  for (Wheel& each : wheels_) {
    const Load more = wheel(each, controls, ground);
    load.force += more.force;
    load.moment += more.moment;
  }
  if (touches(ground)) crashed_ = true;
  if (crashed_) return;
  // Semi-implicit: rates first, then places by the new rates.
  state_.velocity += seconds * (load.force / k_mass + glm::dvec3(0, 0, -k_gravity));
  state_.rates += seconds * (load.moment - glm::cross(state_.rates, k_inertia * state_.rates)) / k_inertia;
  state_.position += seconds * state_.velocity;
  const glm::dvec3 turn = 0.5 * seconds * state_.rates;
  state_.attitude = glm::normalize(state_.attitude + state_.attitude * glm::dquat(0, turn.x, turn.y, turn.z));
}

bool Aircraft::on_ground() const {
  return std::any_of(wheels_.begin(), wheels_.end(), [](const Wheel& each) { return each.compression > 0; });
}

double Aircraft::pitch() const {
  return std::asin(std::clamp((state_.attitude * glm::dvec3(1, 0, 0)).z, -1.0, 1.0));
}

double Aircraft::roll() const {
  return std::atan2((state_.attitude * glm::dvec3(0, 1, 0)).z, (state_.attitude * glm::dvec3(0, 0, 1)).z);
}

double Aircraft::heading() const {
  const glm::dvec3 nose = state_.attitude * glm::dvec3(1, 0, 0);
  return std::atan2(nose.y, nose.x);
}

glm::dvec3 Aircraft::eye() const {
  return state_.position + state_.attitude * glm::dvec3(0.35, 0.25, 0.75);
}

}  // namespace flightsim
