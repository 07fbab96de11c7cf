// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Updates of the mesh and collection of fixed-level triangles along a flight of the 2015 paper's shape: from high above
// down to the ground within the first third, low over it for the second, up again in the last. 4097 x 4097 samples at
// 5 m, 1000 m of relief, 1920 x 1080.
//   bench_roam [--benchmark_filter=...]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "roam_support.h"

namespace {

constexpr int k_frames = 1800;
constexpr double k_seconds = 30;

const roam_support::Terrain& terrain() {
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

// Height above the ground by time, eased between the legs of the flight.
double height_above_ground(double t) {
  constexpr double k_high = 1500, k_low = 3;
  if (t > 10 && t < 20) return k_low;
  const double s = t <= 10 ? t / 10 : (k_seconds - t) / 10;
  const double eased = s * s * (3 - 2 * s);
  return k_high * std::pow(k_low / k_high, eased);
}

sward::View view_of_frame(int frame) {
  const double t = k_seconds * frame / k_frames;
  const double heading = 0.4 + 0.35 * std::sin(0.3 * t);
  const glm::dvec2 xy = glm::dvec2(-4000, -2500) + 200.0 * t * glm::dvec2(std::cos(0.5), std::sin(0.5)) +
                        120.0 * glm::dvec2(std::sin(0.3 * t), std::cos(0.2 * t));
  const double above = height_above_ground(t);
  const double pitch = -0.05 - 0.35 * std::min(above / 800, 1.0);
  return sward::View::look({xy, terrain().field->height(xy) + above}, heading, pitch, 0.87, {1920, 1080}, 0.5, 60000);
}

// CPU time of this thread: what other processes take does not count.
double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

void report(benchmark::State& state, const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1))]; };
  state.counters[std::string(name) + "_mean"] = sum / double(values.size());
  state.counters[std::string(name) + "_median"] = at(0.5);
  state.counters[std::string(name) + "_p95"] = at(0.95);
  state.counters[std::string(name) + "_max"] = values.back();
}

void flight(benchmark::State& state) {
  sward::RoamOptions options;
  options.max_triangles = uint32_t(state.range(0));
  const int level = sward::level_for_area(*terrain().field, 1.6);
  for (auto _ : state) {
    auto mesh = sward::RoamMesh::create(*terrain().bounds, options);
    sward::FixedTriangles fixed;
    std::vector<double> update_ms, fixed_ms, fixed_triangles, bound_px;
    double splits = 0, merges = 0;
    for (int frame = 0; frame < k_frames; ++frame) {
      const sward::View view = view_of_frame(frame);
      const double start = thread_ms();
      const auto stats = mesh->update(view);
      const double middle = thread_ms();
      mesh->fixed_level_triangles({level, 100, 1, true}, fixed);
      const double end = thread_ms();
      bound_px.push_back(double(mesh->bound_px()));
      if (frame == 0) {
        state.counters["first_ms"] = middle - start;
        continue;
      }
      update_ms.push_back(middle - start);
      fixed_ms.push_back(end - middle);
      fixed_triangles.push_back(double(fixed.size()));
      splits += stats->splits;
      merges += stats->merges;
    }
    report(state, "update_ms", update_ms);
    report(state, "fixed_ms", fixed_ms);
    report(state, "fixed_triangles", fixed_triangles);
    report(state, "bound_px", bound_px);
    state.counters["splits_per_frame"] = splits / (k_frames - 1);
    state.counters["merges_per_frame"] = merges / (k_frames - 1);
  }
}

BENCHMARK(flight)->Arg(5000)->Arg(15000)->Arg(50000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
