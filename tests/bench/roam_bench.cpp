// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Updates of the mesh and collection of fixed-level triangles along a flight of the 2015 paper's shape: from high above
// down to the ground within the first third, low over it for the second, up again in the last. 4097 x 4097 samples at
// 5 m, 1000 m of relief, 1920 x 1080.
//   bench_roam [--benchmark_filter=...]
#include <benchmark/benchmark.h>

#include <algorithm>

#include "flight.h"

namespace {

constexpr int k_frames = 1800;
constexpr double k_seconds = 30;

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
  const double above = height_above_ground(t);
  const double pitch = -0.05 - 0.35 * std::min(above / 800, 1.0);
  return flight::view_at(t, above, pitch, *flight::terrain().field);
}

void report(benchmark::State& state, const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1))]; };
  state.counters[std::string(name) + "_mean"] = flight::mean(values);
  state.counters[std::string(name) + "_median"] = at(0.5);
  state.counters[std::string(name) + "_p95"] = at(0.95);
  state.counters[std::string(name) + "_max"] = values.back();
}

void whole_flight(benchmark::State& state) {
  sward::RoamOptions options;
  options.max_triangles = uint32_t(state.range(0));
  const int level = sward::level_for_area(*flight::terrain().field, 1.6);
  for (auto _ : state) {
    auto mesh = sward::RoamMesh::create(*flight::terrain().bounds, options);
    sward::FixedTriangles fixed;
    std::vector<double> update_ms, fixed_ms, fixed_triangles, bound_px;
    double splits = 0, merges = 0;
    for (int frame = 0; frame < k_frames; ++frame) {
      const sward::View view = view_of_frame(frame);
      const double start = flight::thread_ms();
      const auto stats = mesh->update(view);
      const double middle = flight::thread_ms();
      mesh->fixed_level_triangles({level, 100, 1, true}, fixed);
      const double end = flight::thread_ms();
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

BENCHMARK(whole_flight)
    ->Name("flight")
    ->Arg(5000)
    ->Arg(15000)
    ->Arg(50000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
