// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "roam_support.h"

/// What benchmarks of flights share: 4097 x 4097 samples at 5 m, the course of roam_bench.cpp's flight and its low leg,
/// the clock and the figures reported.
namespace flight {

constexpr int k_frames = 600;

inline const roam_support::Terrain& terrain() {
  static const roam_support::Terrain made = [] {
    roam_support::TerrainOptions options;
    options.columns = options.rows = 4097;
    options.spacing = 5;
    options.relief_m = 350;
    options.octaves = 10;
    options.wavelength = 700;
    return roam_support::make_terrain(options);
  }();
  return made;
}

/// At 200 m/s on a winding course, so high above the ground and pitched so far (radians), 1920 x 1080.
inline sward::View view_at(double t, double above, double pitch, const sward::HeightField& field) {
  const double heading = 0.4 + 0.35 * std::sin(0.3 * t);
  const glm::dvec2 xy = glm::dvec2(-4000, -2500) + 200.0 * t * glm::dvec2(std::cos(0.5), std::sin(0.5)) +
                        120.0 * glm::dvec2(std::sin(0.3 * t), std::cos(0.2 * t));
  return sward::View::look({xy, field.height(xy) + above}, heading, pitch, 0.87, {1920, 1080}, 0.5, 60000);
}

/// 3 m above the ground, 60 frames a second.
inline sward::View low_view(int frame, const sward::HeightField& field) {
  return view_at(10 + frame / 60.0, 3, -0.05, field);
}

inline sward::View low_view(int frame) {
  return low_view(frame, *terrain().field);
}

/// CPU time of this thread: what other processes take does not count.
inline double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

/// Counters name_mean, name_median, name_p99.
inline void report(benchmark::State& state, const std::string& name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1))]; };
  state.counters[name + "_mean"] = mean(values);
  state.counters[name + "_median"] = at(0.5);
  state.counters[name + "_p99"] = at(0.99);
}

}  // namespace flight
