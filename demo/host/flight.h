// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <string>
#include <vector>

namespace sward::host {

/// One frame of a recorded or computed camera path.
struct FlightFrame {
  double time_s = 0;
  View view;
};

struct FlightOptions {
  double fps = 60;                    ///< Frames a second of paths that have no times of their own. > 0.
  glm::ivec2 viewport{1920, 1080};    ///< Pixels, for paths that have no viewport of their own.
  double fov_y = 0.8726646259971648;  ///< Radians, for paths that have no projection of their own.
  double near_plane = 0.1;            ///< Metres.
  double far_plane = 50000;           ///< Metres.
};

/// Reads a CSV file with a header line, one row a frame, in either form:
///   frame,ex,ey,ez,v0..v15,p0..p15,vpw,vph   eye, view and projection matrix (column-major), viewport; rows are 1/fps
///                                            apart;
///   time,x,y,z,yaw,pitch                     seconds, metres, degrees; times must not run backwards.
/// Errors name file and line.
Expected<std::vector<FlightFrame>> load_flight(const std::string& path, const FlightOptions& options);

/// Length of the built-in flight, seconds.
inline constexpr double k_paper_flight_s = 30;

/// The flight of Papavasiliou (2015), section 4, over any ground: it begins high, where single plants are not drawn, is
/// near the ground from the tenth second to the twentieth and climbs again, following the ground, looking ahead and
/// slightly down. The first `seconds` of it (0 < seconds <= k_paper_flight_s), one frame every 1/fps. All of the
/// ground must be there: it is the finest that the flight follows.
Expected<std::vector<FlightFrame>> paper_flight(const Surface& ground, double seconds, const FlightOptions& options);

}  // namespace sward::host
