// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace flightsim {

/// The ground below a place, as the simulator asks sward for it.
struct Ground {
  double height = 0;           ///< Metres, world.
  glm::dvec3 normal{0, 0, 1};  ///< Unit, upwards.
};

/// Nothing where there is no ground.
using GroundBelow = std::function<std::optional<Ground>(glm::dvec2 xy)>;

/// What a pilot moves.
struct Controls {
  double elevator = 0;  ///< -1..1; 1 pulls: nose up.
  double aileron = 0;   ///< -1..1; 1 rolls to the right.
  double rudder = 0;    ///< -1..1; 1 turns to the right, the nose wheel too.
  double throttle = 0;  ///< 0..1.
  double flaps = 0;     ///< 0..1.
  double brake = 0;     ///< 0..1, main wheels.
};

/// Where an aircraft is and how it moves. World axes: x east, y north, z up. Body axes: x forward, y left, z up.
struct AircraftState {
  glm::dvec3 position{0};           ///< Of the centre of mass, metres.
  glm::dvec3 velocity{0};           ///< m/s, world.
  glm::dquat attitude{1, 0, 0, 0};  ///< From body to world.
  glm::dvec3 rates{0};              ///< rad/s, body.
};

/// A wheel in body axes and what it stood on in the last step.
struct Wheel {
  glm::dvec3 offset{0};    ///< Where it touches the ground when nothing presses on it, metres.
  double spring = 0;       ///< N/m.
  double damper = 0;       ///< Ns/m.
  bool steered = false;    ///< Turns with the rudder and has no brake.
  double compression = 0;  ///< Metres, 0 in the air.
  glm::dvec3 contact{0};   ///< World, on the ground below the wheel.
};

/// A light single-engined aeroplane as a rigid body: linear aerodynamics with a stall, a propeller's thrust, three
/// sprung wheels that roll, brake and hold sideways. Coefficients are of the class of a four-seat high-wing trainer
/// (1043 kg, 16.2 m2), rounded. It asks for the ground below its wheels and nothing else; equal steps from equal states
/// give equal states. One thread.
class Aircraft {
 public:
  /// Standing on the ground at a place, level with it, nose towards `heading` (radians counter-clockwise from east).
  static Aircraft standing(glm::dvec2 place, double heading, const GroundBelow& ground);

  /// Goes on by a fixed step; 1/240 s is what springs and dampers are made for.
  void step(const Controls& controls, double seconds, const GroundBelow& ground);

  const AircraftState& state() const { return state_; }
  const std::array<Wheel, 3>& wheels() const { return wheels_; }  ///< Nose, left, right.
  bool on_ground() const;
  /// Another part than a wheel has touched the ground, or there was no ground below a wheel: it moves no more.
  bool crashed() const { return crashed_; }

  double airspeed() const { return glm::length(state_.velocity); }  ///< m/s; the air is still.
  double pitch() const;                                             ///< Radians, nose up.
  double roll() const;                                              ///< Radians, right wing down.
  double heading() const;                                           ///< Radians counter-clockwise from east.
  /// Eye of the pilot, world.
  glm::dvec3 eye() const;

 private:
  struct Load {
    glm::dvec3 force{0};   // world
    glm::dvec3 moment{0};  // body
  };
  Load air(const Controls& controls) const;
  Load wheel(Wheel& wheel, const Controls& controls, const GroundBelow& ground);
  bool touches(const GroundBelow& ground) const;

  AircraftState state_;
  std::array<Wheel, 3> wheels_;
  bool crashed_ = false;
};

}  // namespace flightsim
