// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The flight of D. Papavasiliou, "Real-Time Grass on Terrain" (2015), section 4: high, near the ground after ten seconds,
// climbing after the twentieth. The paper gives no more than that; the rest is chosen here so that the flight fits any
// field: a shallow S through the field's middle, at a speed that follows the height, scaled down where the field is
// too small for it.

#include <algorithm>
#include <cmath>

#include "host/flight.h"

namespace sward::host {

namespace {

constexpr double k_low_m = 2.0;           // height above the ground near the ground
constexpr double k_descent_s = 10.0;      // the low part begins
constexpr double k_ascent_s = 20.0;       // and ends
constexpr double k_step_s = 1.0 / 120.0;  // of the path's samples
constexpr int k_steps = int(k_paper_flight_s / k_step_s + 0.5);
constexpr int k_follow_steps = 60;  // half a second: the ground is followed through a window this wide on either side

double ground_height(const Surface& ground, glm::dvec2 xy) {
  const Lattice& lattice = ground.lattice();
  return ground.height(glm::clamp(xy, lattice.min_corner(), lattice.max_corner()));
}

// Height above the ground: a parabola down, level, a parabola up; its slope is continuous.
double clearance(double time_s, double high_m) {
  double share = 0;
  if (time_s < k_descent_s) share = 1 - time_s / k_descent_s;
  if (time_s > k_ascent_s) share = (time_s - k_ascent_s) / (k_paper_flight_s - k_ascent_s);
  return k_low_m + (high_m - k_low_m) * share * share;
}

struct Path {
  std::vector<glm::dvec2> position;  // one every k_step_s
  std::vector<double> yaw;
  std::vector<double> ground;  // smoothed, never below the true ground
};

// Integrates the speed along the S, then moves and scales it so that it passes through the field's middle half way.
void lay_out(const Surface& ground, double high_m, Path& path) {
  const glm::dvec2 low_corner = ground.lattice().min_corner(), high_corner = ground.lattice().max_corner();
  const glm::dvec2 extent = high_corner - low_corner;
  const double base_yaw = std::atan2(extent.y, extent.x);
  glm::dvec2 at(0);
  for (int i = 0; i <= k_steps; ++i) {
    const double time = i * k_step_s;
    const double speed = 12.0 + 0.25 * clearance(time, high_m);
    const double yaw = base_yaw + 0.35 * std::sin(2 * 3.14159265358979323846 * time / k_paper_flight_s);
    path.position.push_back(at);
    path.yaw.push_back(yaw);
    at += speed * k_step_s * glm::dvec2(std::cos(yaw), std::sin(yaw));
  }
  const glm::dvec2 middle = path.position[size_t(k_steps) / 2];
  double reach = 1.0;
  for (const glm::dvec2 p : path.position)
    for (int axis = 0; axis < 2; ++axis)
      reach = std::max(reach, std::abs(p[axis] - middle[axis]) / (0.45 * extent[axis]));
  for (glm::dvec2& p : path.position) p = (low_corner + high_corner) / 2.0 + (p - middle) / reach;
}

// The highest ground within the window, then the mean of that over the same window: smooth, and at every place at
// least as high as the ground there, because each of the averaged maxima has seen it.
void follow_ground(const Surface& ground, Path& path) {
  const int count = int(path.position.size());
  std::vector<double> height(path.position.size()), highest(path.position.size());
  for (int i = 0; i < count; ++i) height[size_t(i)] = ground_height(ground, path.position[size_t(i)]);
  const auto window = [count](int i) {
    return std::pair(std::max(i - k_follow_steps, 0), std::min(i + k_follow_steps, count - 1));
  };
  for (int i = 0; i < count; ++i) {
    const auto [first, last] = window(i);
    highest[size_t(i)] = *std::max_element(height.begin() + first, height.begin() + last + 1);
  }
  for (int i = 0; i < count; ++i) {
    const auto [first, last] = window(i);
    double sum = 0;
    for (int j = first; j <= last; ++j) sum += highest[size_t(j)];
    path.ground.push_back(sum / (last - first + 1));
  }
}

double between(const std::vector<double>& values, double place) {
  const size_t first = std::min(size_t(place), values.size() - 2);
  return std::lerp(values[first], values[first + 1], place - double(first));
}

}  // namespace

Expected<std::vector<FlightFrame>> paper_flight(const Surface& ground, double seconds, const FlightOptions& options) {
  if (!(seconds > 0 && seconds <= k_paper_flight_s))
    return fail("the paper flight is 30 s long; --seconds must be above 0 and at most 30");
  const glm::dvec2 low_corner = ground.lattice().min_corner(), high_corner = ground.lattice().max_corner();
  const glm::dvec2 extent = high_corner - low_corner;
  const double high_m = std::clamp(0.15 * std::min(extent.x, extent.y), 150.0, 600.0);
  Path path;
  lay_out(ground, high_m, path);
  follow_ground(ground, path);

  std::vector<FlightFrame> frames;
  const int count = std::max(1, int(std::lround(seconds * options.fps)));
  for (int i = 0; i < count; ++i) {
    const double time = i / options.fps, place = std::min(time / k_step_s, double(k_steps));
    const size_t first = std::min(size_t(place), path.position.size() - 2);
    const glm::dvec2 xy = glm::mix(path.position[first], path.position[first + 1], place - double(first));
    const double above = clearance(time, high_m);
    const double pitch = -glm::radians(6.0 + 16.0 * std::sqrt(above / high_m));
    const glm::dvec3 eye(xy, between(path.ground, place) + above);
    const View view = View::look(eye, between(path.yaw, place), pitch, options.fov_y, options.viewport,
                                 options.near_plane, options.far_plane);
    if (auto valid = view.validate(); !valid) return tl::unexpected(valid.error());
    frames.push_back({time, view});
  }
  return frames;
}

}  // namespace sward::host
