// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a frame of wind costs the CPU, 60 frames a second.
//   bench_wind [--benchmark_filter=...]
#include <sward/vegetation/wind.h>

#include <benchmark/benchmark.h>
#include <cmath>
#include <vector>

namespace {

// Arguments: walkers on circles within 28 m of the viewer; rotors; sources.
void advance(benchmark::State& state) {
  sward::Wind wind;
  (void)wind.set_weather({.speed_m_s = 8});
  std::vector<sward::WindMoverId> walkers;
  for (int i = 0; i < state.range(0); ++i) walkers.push_back(*wind.add_mover({}));
  for (int i = 0; i < state.range(1); ++i) {
    sward::WindMover rotor{.kind = sward::WindMover::Kind::rotor, .position = {10.0 * i, 5}};
    rotor.radius_m = 7;
    rotor.strength = 15;
    (void)wind.add_mover(rotor);
  }
  for (int i = 0; i < state.range(2); ++i) {
    sward::WindSource gust{.position = {-100, 10.0 * i}};
    gust.repeat_s = 5;
    (void)wind.add_source(gust);
  }
  const auto place = [](size_t i, double t) {
    const double radius = 2 + 26 * std::fmod(0.618 * double(i), 1.0), turn = 2.4 * double(i) + 1.5 * t / radius;
    return radius * glm::dvec2(std::cos(turn), std::sin(turn));
  };
  double time = 0;
  const auto frame = [&] {
    time += 1.0 / 60;
    for (size_t i = 0; i < walkers.size(); ++i) (void)wind.move(walkers[i], place(i, time), 0);
    (void)wind.advance(1.0 / 60, {0, 0, 1.7});
  };
  for (int i = 0; i < 120; ++i) frame();
  for (auto _ : state) frame();
}

// Argument: sources that blow.
void at(benchmark::State& state) {
  sward::Wind wind;
  (void)wind.set_weather({.speed_m_s = 8});
  for (int i = 0; i < state.range(0); ++i) (void)wind.add_source({.position = {-100, 10.0 * i}, .duration_s = 60});
  (void)wind.advance(10, {0, 0, 1.7});
  double x = 0;
  for (auto _ : state) {
    x += 0.37;
    benchmark::DoNotOptimize(wind.at({x, 0.71 * x, 0}));
  }
}

}  // namespace

BENCHMARK(advance)
    ->ArgNames({"walkers", "rotors", "sources"})
    ->Args({0, 0, 0})
    ->Args({1, 0, 0})
    ->Args({0, 1, 0})
    ->Args({100, 1, 16})
    ->Args({1000, 0, 0})
    ->Args({16000, 0, 0})
    ->Args({0, 0, 1000})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(at)->ArgName("sources")->Arg(0)->Arg(16);

BENCHMARK_MAIN();
