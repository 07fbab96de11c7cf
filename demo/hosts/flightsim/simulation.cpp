// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "flightsim/simulation.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>

#include "flightsim/place.h"
#include "host/world_stream.h"

namespace flightsim {

namespace {

using sward::Expected;
using sward::View;

constexpr double k_step_s = 1.0 / 240;
constexpr double k_fov_y = 0.96, k_look_down = 0.05;  // radians

View view_from(const Aircraft& aircraft, glm::ivec2 viewport, double far_plane) {
  View view = View::look(aircraft.eye(), 0, 0, k_fov_y, viewport, sward::host::k_near_plane_m, far_plane);
  // Eye axes: x right, y up, -z ahead; body axes: x forward, y left, z up. The head is bent a little.
  const double c = std::cos(k_look_down), s = std::sin(k_look_down);
  const glm::dmat3 body_from_eye(glm::dvec3(0, -1, 0), glm::dvec3(s, 0, c), glm::dvec3(-c, 0, s));
  view.eye_from_world = glm::transpose(glm::mat3_cast(aircraft.state().attitude) * body_from_eye);
  return view;
}

// Keeps the figures of a flight as it goes.
class Observer {
 public:
  Observer(const Strip& strip, const GroundBelow& ground) : strip_(&strip), ground_(&ground) {}

  void look(const Aircraft& aircraft, const Pilot& pilot, double time_s, double sinking_m_s) {
    for (const Wheel& wheel : aircraft.wheels())
      report.deepest_wheel_m = std::max(report.deepest_wheel_m, wheel.compression);
    const glm::dvec2 place(aircraft.state().position);
    const bool flying = !aircraft.on_ground();
    if (flying && report.take_off_s == 0 && pilot.phase() == Pilot::Phase::climb) report.take_off_s = time_s;
    if (!flying && was_flying_ && report.take_off_s > 0 && report.landing_s == 0) {
      report.landing_s = time_s;
      report.touch_down_m_s = sinking_m_s;
      report.touch_down = strip_->local(place);
    }
    was_flying_ = flying;
    if (pilot.phase() == Pilot::Phase::circuit)
      if (const auto below = (*ground_)(place))
        lowest_ = std::min(lowest_, aircraft.state().position.z - below->height);
  }

  Report finish(const Aircraft& aircraft, const Pilot& pilot, double time_s) {
    report.crashed = aircraft.crashed();
    report.arrived = pilot.phase() == Pilot::Phase::stopped;
    report.stopped_s = report.arrived ? time_s : 0;
    report.stopped = strip_->local(glm::dvec2(aircraft.state().position));
    report.lowest_m = lowest_;
    return report;
  }

  Report report;

 private:
  const Strip* strip_;
  const GroundBelow* ground_;
  bool was_flying_ = false;
  double lowest_ = 1e9;
};

void write_matrix(std::ostream& file, const glm::dmat4& matrix) {
  for (int i = 0; i < 16; ++i) file << ',' << matrix[i / 4][i % 4];
}

}  // namespace

Expected<Flight> fly_circuit(const sward::host::SceneTerrain& terrain, const Strip& strip, int fps, glm::ivec2 viewport,
                             double longest_s, const sward::Progress& progress) {
  const GroundBelow ground = ground_below(terrain.surface());
  const double far_plane = sward::host::far_plane_m(terrain.surface());
  std::optional<sward::host::WorldStream> stream;
  if (terrain.world() != nullptr) stream.emplace(*terrain.world());
  Aircraft aircraft = Aircraft::standing(strip.at(30, 0), strip.heading, ground);
  Pilot pilot(strip);
  Observer observer(strip, ground);
  Flight flight;
  const int steps = std::max(1, int(std::lround(1 / (fps * k_step_s))));
  const auto frames = size_t(longest_s * fps);
  for (size_t i = 0; i < frames; ++i) {
    const View view = view_from(aircraft, viewport, far_plane);
    if (stream)
      if (auto there = stream->wait(view); !there) return tl::unexpected(there.error());
    flight.frames.push_back({double(i) / fps, view, pilot.phase()});
    for (int k = 0; k < steps; ++k) {
      const double sinking = -aircraft.state().velocity.z;
      aircraft.step(pilot.fly(aircraft, k_step_s), k_step_s, ground);
      observer.look(aircraft, pilot, double(i) / fps + (k + 1) * k_step_s, sinking);
    }
    if (aircraft.crashed() || pilot.phase() == Pilot::Phase::stopped) break;
    if (progress && i % 60 == 0) progress(float(i) / float(frames));
  }
  flight.report = observer.finish(aircraft, pilot, flight.frames.back().time_s);
  return flight;
}

Expected<void> save_flight(const std::string& path, const std::vector<Frame>& frames) {
  std::ofstream file(path);
  file << "frame,ex,ey,ez";
  for (const char* matrix : {"v", "p"})
    for (int i = 0; i < 16; ++i) file << ',' << matrix << i;
  file << ",vpw,vph\n" << std::setprecision(12);
  for (size_t i = 0; i < frames.size(); ++i) {
    const View& view = frames[i].view;
    file << i << ',' << view.eye.x << ',' << view.eye.y << ',' << view.eye.z;
    write_matrix(file, glm::dmat4(view.eye_from_world));
    write_matrix(file, view.clip_from_eye);
    file << ',' << view.viewport.x << ',' << view.viewport.y << '\n';
  }
  file.close();
  return file ? Expected<void>{} : sward::fail(path + ": the flight cannot be written");
}

}  // namespace flightsim
