// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include "flightsim/aircraft.h"

namespace flightsim {

/// A straight strip to take off from and to land on.
struct Strip {
  glm::dvec2 threshold{0};  ///< Where it begins, middle of its width, world.
  double heading = 0;       ///< Radians counter-clockwise from east, along it.
  double length_m = 600, width_m = 20;
  double height_m = 0;  ///< World.

  glm::dvec2 along() const { return {std::cos(heading), std::sin(heading)}; }
  glm::dvec2 left() const { return {-std::sin(heading), std::cos(heading)}; }
  glm::dvec2 at(double along_m, double left_m) const { return threshold + along_m * along() + left_m * left(); }
  /// Metres along the strip and to its left.
  glm::dvec2 local(glm::dvec2 place) const {
    return {glm::dot(place - threshold, along()), glm::dot(place - threshold, left())};
  }
};

/// Flies a left-hand circuit: takes off, climbs, turns back, lands on the same strip and stops. One thread.
class Pilot {
 public:
  enum class Phase { take_off, climb, circuit, final_approach, flare, roll_out, stopped };

  /// `circuit_height_m` above the strip.
  explicit Pilot(const Strip& strip, double circuit_height_m = 120) : strip_(strip), height_(circuit_height_m) {}

  /// What it does in the next step of `seconds`.
  Controls fly(const Aircraft& aircraft, double seconds);
  Phase phase() const { return phase_; }

 private:
  void next_phase(const Aircraft& aircraft, glm::dvec2 local);
  Controls on_strip(const Aircraft& aircraft, glm::dvec2 local, bool taking_off) const;
  double wanted_heading(glm::dvec2 local);
  double wanted_climb(const Aircraft& aircraft, glm::dvec2 local) const;
  double wanted_speed() const;
  void hold_heading(const Aircraft& aircraft, double heading, Controls& controls) const;
  void hold_climb(const Aircraft& aircraft, double climb_m_s, double seconds, Controls& controls);
  void hold_speed(const Aircraft& aircraft, double speed, double seconds, Controls& controls);

  Strip strip_;
  double height_;
  Phase phase_ = Phase::take_off;
  int corner_ = 0;           // of the circuit, the next one
  double pitch_trim_ = 0.1;  // integrals of the two loops
  double throttle_trim_ = 0.6;
};

}  // namespace flightsim
