// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "flightsim/pilot.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace flightsim {

namespace {

constexpr double k_rotate_m_s = 28, k_climb_m_s = 36, k_cruise_m_s = 42, k_approach_m_s = 32;
constexpr double k_wheels_m = 1.3;  // centre of mass above the ground, on its wheels
constexpr double k_glide = 0.075;   // slope of the approach, some four degrees
constexpr double k_aim_m = 40;      // beyond the threshold
constexpr double k_flare_m = 7;     // wheels above the strip
constexpr double k_most_bank = 0.45, k_most_pitch = 0.22;
constexpr double k_out_m = 900, k_beside_m = 700, k_back_m = 1500;  // corners of the circuit, metres

double wrapped(double angle) {
  return std::remainder(angle, glm::two_pi<double>());
}

}  // namespace

double Pilot::wanted_speed() const {
  switch (phase_) {
    case Phase::climb:
      return k_climb_m_s;
    case Phase::circuit:
      return k_cruise_m_s;
    case Phase::final_approach:
      return k_approach_m_s;
    default:
      return 0;
  }
}

// Along the line through the next corner: to it while it is far, along it when near.
double Pilot::wanted_heading(glm::dvec2 local) {
  const auto line = [&](double off, double course) { return course - std::clamp(off * 0.006, -0.8, 0.8); };
  const double pi = glm::pi<double>();
  double course = 0;
  if (phase_ == Phase::circuit) {
    const double end = strip_.length_m + k_out_m;
    if (corner_ == 0 && local.x > end) corner_ = 1;
    if (corner_ == 1 && local.y > k_beside_m - 220) corner_ = 2;
    if (corner_ == 2 && local.x < -k_back_m) corner_ = 3;
    if (corner_ == 0) course = line(local.y, 0);
    if (corner_ == 1) course = pi / 2;
    if (corner_ == 2) course = pi + std::clamp((local.y - k_beside_m) * 0.006, -0.8, 0.8);
    if (corner_ == 3) course = -pi / 2;
  } else {
    course = -std::clamp(local.y * 0.012, -0.8, 0.8);
  }
  return strip_.heading + course;
}

double Pilot::wanted_climb(const Aircraft& aircraft, glm::dvec2 local) const {
  const double above = aircraft.state().position.z - strip_.height_m - k_wheels_m;
  if (phase_ == Phase::climb) return 4;
  if (phase_ == Phase::circuit) return std::clamp(0.25 * (height_ - above), -3.0, 4.0);
  if (phase_ == Phase::flare) return -std::clamp(0.32 * above, 0.3, 2.2);
  const double glide = std::max(k_aim_m - local.x, 0.0) * k_glide;
  const double down = k_glide * glm::length(glm::dvec2(aircraft.state().velocity));
  return above > height_ - 5 && glide > height_ ? 0.25 * (height_ - above)
                                                : std::clamp(-down + 0.3 * (glide - above), -5.0, 1.0);
}

void Pilot::hold_heading(const Aircraft& aircraft, double heading, Controls& controls) const {
  // Left turns are positive headings and negative banks.
  const double bank = std::clamp(-1.2 * wrapped(heading - aircraft.heading()), -k_most_bank, k_most_bank);
  controls.aileron = std::clamp(2.2 * (bank - aircraft.roll()) - 0.9 * aircraft.state().rates.x, -1.0, 1.0);
  const glm::dvec3 body = glm::inverse(aircraft.state().attitude) * aircraft.state().velocity;
  controls.rudder = std::clamp(-0.08 * body.y, -0.5, 0.5);
}

void Pilot::hold_climb(const Aircraft& aircraft, double climb_m_s, double seconds, Controls& controls) {
  const double error = climb_m_s - aircraft.state().velocity.z;
  pitch_trim_ = std::clamp(pitch_trim_ + 0.012 * error * seconds, -0.15, k_most_pitch);
  const double gain = phase_ == Phase::flare ? 0.075 : 0.028;
  const double pitch = std::clamp(pitch_trim_ + gain * error, -0.15, k_most_pitch);
  const double rate = -aircraft.state().rates.y;
  controls.elevator =
      std::clamp(2.6 * (pitch - aircraft.pitch()) - 1.1 * rate + 0.15 * std::abs(aircraft.roll()), -1.0, 1.0);
}

void Pilot::hold_speed(const Aircraft& aircraft, double speed, double seconds, Controls& controls) {
  const double error = speed - aircraft.airspeed();
  throttle_trim_ = std::clamp(throttle_trim_ + 0.02 * error * seconds, 0.0, 1.0);
  controls.throttle = std::clamp(throttle_trim_ + 0.12 * error, 0.0, 1.0);
}

Controls Pilot::on_strip(const Aircraft& aircraft, glm::dvec2 local, bool taking_off) const {
  Controls controls;
  const double course = strip_.heading - std::clamp(0.05 * local.y, -0.3, 0.3);
  const double left = wrapped(course - aircraft.heading());
  controls.rudder = std::clamp(-2.0 * left + 0.8 * aircraft.state().rates.z, -1.0, 1.0);
  controls.aileron = std::clamp(-2 * aircraft.roll(), -1.0, 1.0);
  if (taking_off) {
    controls.throttle = 1;
    const double pitch = aircraft.airspeed() > k_rotate_m_s ? 0.14 : 0.0;
    controls.elevator = std::clamp(6 * (pitch - aircraft.pitch()) + 1.5 * aircraft.state().rates.y, -0.2, 1.0);
  } else {
    controls.flaps = 1;
    controls.brake = aircraft.airspeed() < 24 ? 0.8 : 0.0;
    controls.elevator = aircraft.airspeed() > 12 ? 0.1 : 0.0;
  }
  return controls;
}

void Pilot::next_phase(const Aircraft& aircraft, glm::dvec2 local) {
  const double above = aircraft.state().position.z - strip_.height_m - k_wheels_m;
  if (phase_ == Phase::take_off && above > 4) phase_ = Phase::climb;
  if (phase_ == Phase::climb && above > 0.6 * height_) phase_ = Phase::circuit;
  if (phase_ == Phase::circuit && corner_ == 3 && local.y < 260) phase_ = Phase::final_approach;
  if (phase_ == Phase::final_approach && above < k_flare_m) phase_ = Phase::flare;
  if (phase_ == Phase::flare && aircraft.on_ground()) phase_ = Phase::roll_out;
  if (phase_ == Phase::roll_out && aircraft.airspeed() < 0.3) phase_ = Phase::stopped;
}

Controls Pilot::fly(const Aircraft& aircraft, double seconds) {
  const glm::dvec2 local = strip_.local(glm::dvec2(aircraft.state().position));
  next_phase(aircraft, local);
  if (phase_ == Phase::take_off || phase_ == Phase::roll_out)
    return on_strip(aircraft, local, phase_ == Phase::take_off);
  Controls controls;
  if (phase_ == Phase::stopped) {
    controls.brake = 1;
    return controls;
  }
  hold_heading(aircraft, wanted_heading(local), controls);
  hold_climb(aircraft, wanted_climb(aircraft, local), seconds, controls);
  if (phase_ == Phase::climb) {
    controls.throttle = 1;
  } else if (phase_ != Phase::flare) {
    hold_speed(aircraft, wanted_speed(), seconds, controls);
  }
  controls.flaps = phase_ == Phase::final_approach || phase_ == Phase::flare ? 1 : 0;
  return controls;
}

}  // namespace flightsim
