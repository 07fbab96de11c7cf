// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/view.h>
#include <string>
#include <vector>

#include "flightsim/pilot.h"
#include "host/scene_terrain.h"

namespace flightsim {

/// What the pilot saw in a frame, and how the aircraft was.
struct Frame {
  double time_s = 0;
  sward::View view;
  Pilot::Phase phase = Pilot::Phase::take_off;
};

struct Report {
  double take_off_s = 0, landing_s = 0, stopped_s = 0;  ///< Wheels off the ground, on it again, standing.
  double touch_down_m_s = 0;                            ///< How fast it sank then.
  glm::dvec2 touch_down{0}, stopped{0};                 ///< Metres along the strip and to its left.
  double lowest_m = 0;         ///< Above the ground between the end of the climb and the approach.
  double deepest_wheel_m = 0;  ///< Most that a wheel's spring was pressed together.
  bool crashed = false, arrived = false;
};

struct Flight {
  std::vector<Frame> frames;
  Report report;
};

/// Flies the circuit over a scene's ground, `fps` frames a second in fixed steps of 1/240 s, until the aircraft stands
/// again, has crashed, or `longest_s` is over. Where the ground is a world every frame waits for the squares that it
/// wants, so that each run gives the same flight. Fails where a square cannot be loaded.
sward::Expected<Flight> fly_circuit(const sward::host::SceneTerrain& terrain, const Strip& strip, int fps,
                                    glm::ivec2 viewport, double longest_s, const sward::Progress& progress = {});

/// Writes the frames as `sward fly --flight` reads them: eye, view matrix and projection a row.
sward::Expected<void> save_flight(const std::string& path, const std::vector<Frame>& frames);

}  // namespace flightsim
