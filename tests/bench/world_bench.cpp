// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A flight over a world of 64 x 64 squares of 2049 x 2049 samples at 1 m (131
// km a side), 300 m/s for a minute at 60 frames a second, in real time: the
// background thread has as long as it would have. Squares are generated: noise
// that repeats every four squares, so that the coarse data can be computed from
// thirty-six of them.
//   bench_world [--benchmark_filter=...]
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include "../world_support.h"

namespace {

constexpr int k_squares = 64, k_period = 4, k_root_bits = 11, k_coarse_bits = 5;
constexpr int k_cells = 1 << k_root_bits, k_frames = 3600, k_cold_frames = 900, k_fps = 60;
constexpr double k_speed = 300;

sward::WorldDesc desc_of(int squares) {
  sward::WorldDesc desc = world_support::make_desc(glm::ivec2(squares), k_root_bits, k_coarse_bits);
  desc.spacing = {1, 1};
  desc.scale = 0.01;
  return desc;
}

float node(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h ^= h >> 12;
  return float(h & 0xffff) * (1.0f / 65536.0f);
}

// One octave of value noise, period k_period squares, added to a row.
void add_octave(int row, int first, int cell, float amplitude, std::span<float> heights) {
  const uint32_t nodes = uint32_t(k_period * k_cells / cell);
  const uint32_t y = uint32_t(row / cell) % nodes;
  const float v = float(row % cell) / float(cell), t = v * v * (3 - 2 * v);
  for (size_t i = 0; i < heights.size();) {
    const int column = first + int(i);
    const uint32_t x = uint32_t(column / cell) % nodes;
    const auto side = [&](uint32_t at) {
      return (1 - t) * node(at % nodes, y, uint32_t(cell)) + t * node(at % nodes, (y + 1) % nodes, uint32_t(cell));
    };
    const float west = side(x), east = side(x + 1);
    for (int k = column % cell; k < cell && i < heights.size(); ++k, ++i) {
      const float u = float(k) / float(cell);
      heights[i] += amplitude * (west + u * u * (3 - 2 * u) * (east - west));
    }
  }
}

sward::Expected<void> read(const sward::SampleBox& box, std::span<float> heights, std::span<uint8_t>) {
  for (int row = 0; row < box.size.y; ++row) {
    const auto line = heights.subspan(size_t(row) * size_t(box.size.x), size_t(box.size.x));
    std::fill(line.begin(), line.end(), 0.0f);
    for (int cell = 2048; cell >= 8; cell /= 4)
      add_octave(box.first.y + row, box.first.x, cell, 20.0f * float(cell), line);
    for (float& height : line) height = std::floor(std::min(height, 65535.0f));
  }
  return {};
}

// The coarse data of the four by four squares in the middle of six by six,
// repeated.
const sward::WorldCoarse& repeated_coarse() {
  static const sward::WorldCoarse made = [] {
    constexpr int k_cut = k_period + 2, k_across = 1 << k_coarse_bits;
    const sward::WorldCoarse part = sward::build_coarse(desc_of(k_cut), read).value();
    constexpr int k_side = k_squares * k_across, k_part = k_cut * k_across;
    sward::WorldCoarse all;
    const auto from = [](int i) { return i % (k_period * k_across) + k_across; };
    for (int row = 0; row <= k_side; ++row)
      for (int column = 0; column <= k_side; ++column) {
        const size_t at = size_t(from(row)) * (k_part + 1) + size_t(from(column));
        all.heights.push_back(part.heights[at]);
        all.bounds.push_back(part.bounds[at]);
        if (row < k_side && column < k_side)
          all.cell_bounds.push_back(part.cell_bounds[size_t(from(row)) * k_part + size_t(from(column))]);
      }
    return all;
  }();
  return made;
}

sward::Expected<sward::SquareData> generate(const sward::SquareRequest& request) {
  return sward::build_square(desc_of(k_period + 2), request.square % k_period + 1, read);
}

sward::View view_of(const sward::World& world, double seconds) {
  const glm::dvec2 xy(-9000 + k_speed * seconds, 3000 + 800 * std::sin(0.1 * seconds));
  return sward::View::look({xy, world.height_range().y + 50}, 0.08 * std::cos(0.1 * seconds), -0.15, 0.87, {1920, 1080},
                           1, 200000);
}

// CPU time of this thread: what other threads and processes take does not
// count.
double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / double(values.size());
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

struct Flight {
  std::vector<double> with_change,
      without;                                 // milliseconds of follow, poll, update
  double changes_ms = 0, most_changes_ms = 0;  // of follow and poll alone
  size_t most_bytes = 0;
  std::vector<double> bounds;      // pixels
  std::vector<double> operations;  // splits and merges
  int following = 0;               // frames that went on with what a square had set free
  int late = 0;                    // frames in which the square under the eye was not resident
};

Flight fly(sward::World& world, sward::RoamMesh& mesh, int frames) {
  Flight flight;
  bool going_on = false;
  auto due = std::chrono::steady_clock::now();
  for (int frame = 0; frame < frames; ++frame) {
    const double seconds = double(frame) / k_fps;
    const sward::View view = view_of(world, seconds);
    const double begin = thread_ms();
    world.follow({&view, 1});
    const auto boxes = world.poll();
    const double polled = thread_ms();
    for (const sward::LatticeBox& box : boxes) mesh.residency_changed(box);
    const auto stats = mesh.update(view, seconds);
    const double end = thread_ms();
    flight.operations.push_back(stats->splits + stats->merges);
    flight.changes_ms += polled - begin;
    flight.most_changes_ms = std::max(flight.most_changes_ms, polled - begin);
    flight.most_bytes = std::max(flight.most_bytes, world.stats().bytes);
    flight.bounds.push_back(double(mesh.bound_px()));
    const glm::dvec2 at = world.lattice().from_world(glm::dvec2(view.eye)) / double(sward::k_root_side);
    flight.late += !world.resident(glm::ivec2(at));
    // Frames that go on with what came are because of loading, too.
    const bool changed = !boxes.empty() || going_on;
    going_on = stats->capped;
    flight.following += boxes.empty() && changed;
    if (frame > 0) (changed ? flight.with_change : flight.without).push_back(end - begin);
    due += std::chrono::microseconds(1000000 / k_fps);
    std::this_thread::sleep_until(due);
  }
  return flight;
}

void world_flight(benchmark::State& state) {
  for (auto _ : state) {
    sward::WorldOptions options;
    options.memory_bytes = size_t(state.range(0)) << 20;
    const auto world = sward::World::create(desc_of(k_squares), repeated_coarse(), generate, options).value();
    sward::RoamOptions roam;
    roam.max_triangles = uint32_t(state.range(1));
    roam.time_cap_s = double(state.range(2)) * 1e-3;
    auto mesh = sward::RoamMesh::create(*world, roam).value();
    // Cold: nothing is resident at first, and what arrives in the first seconds lies under the eye.
    const bool cold = state.range(3) != 0;
    const int frames = cold ? k_cold_frames : k_frames;
    if (!cold) world_support::settle(*world, view_of(*world, 0));
    (void)mesh.update(view_of(*world, 0), 0);
    const sward::WorldStats before = world->stats();
    Flight flight = fly(*world, mesh, frames);
    const sward::WorldStats after = world->stats();
    std::vector<double> all = flight.with_change;
    all.insert(all.end(), flight.without.begin(), flight.without.end());
    const double average = mean(all);
    std::sort(all.begin(), all.end());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["cap_MB"] = double(options.memory_bytes) / 1048576;
    state.counters["most_MB"] = double(flight.most_bytes) / 1048576;
    state.counters["peak_rss_MB"] = double(usage.ru_maxrss) / 1024;
    state.counters["loads"] = double(after.loads - before.loads);
    state.counters["drops"] = double(after.drops - before.drops);
    state.counters["failures"] = double(after.failures);
    state.counters["frame_ms_mean"] = average;
    state.counters["frame_ms_p99"] = all[all.size() * 99 / 100];
    state.counters["frame_ms_max"] = all.back();
    state.counters["changed_frames"] = double(flight.with_change.size());
    state.counters["changed_ms_mean"] = mean(flight.with_change);
    state.counters["changed_ms_max"] = largest(flight.with_change);
    state.counters["unchanged_ms_max"] = largest(flight.without);
    state.counters["changed_max_over_mean"] = largest(flight.with_change) / average;
    state.counters["follow_poll_ms_mean"] = flight.changes_ms / frames;
    state.counters["follow_poll_ms_max"] = flight.most_changes_ms;
    std::sort(flight.bounds.begin(), flight.bounds.end());
    state.counters["bound_px_median"] = flight.bounds[flight.bounds.size() / 2];
    state.counters["bound_px_p99"] = flight.bounds[flight.bounds.size() * 99 / 100];
    state.counters["late_frames"] = flight.late;
    state.counters["following_frames"] = flight.following;
    state.counters["operations_mean"] = mean(flight.operations);
    state.counters["operations_max"] = largest(flight.operations);
  }
}

BENCHMARK(world_flight)
    ->ArgNames({"cap_MB", "triangles", "time_cap_ms", "cold"})
    ->Args({512, 50000, 0, 0})
    ->Args({512, 50000, 4, 0})
    ->Args({512, 50000, 0, 1})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
