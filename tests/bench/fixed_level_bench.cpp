// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Fixed-level triangles of a low flight: rebuilt from nothing for each frame against frame-coherent, in turn on the
// same mesh. Milliseconds of CPU time of the calling thread with one thread, of wall time with more.
//   bench_fixed_level [--benchmark_filter=...]
#include <chrono>

#include "../../terrain/src/terrain/fixed_level.h"
#include "../../terrain/src/terrain/roam_engine.h"
#include "fixed_level_reference.h"
#include "flight.h"

namespace {

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double now_ms(bool one_thread) {
  return one_thread ? flight::thread_ms() : wall_ms();
}

sward::FixedLevelOptions options_of(const benchmark::State& state) {
  sward::FixedLevelOptions options;
  options.horizon_m = float(state.range(0));
  options.level = sward::level_for_area(*flight::terrain().field, 0.01 * double(state.range(1)));
  options.threads = int(state.range(2));
  return options;
}

// Arguments: horizon in metres, area of a triangle in hundredths of a square metre, threads, budget of the mesh.
void run(benchmark::State& state, bool moving) {
  const sward::FieldSurface surface(*flight::terrain().bounds);
  const sward::FixedLevelOptions options = options_of(state);
  const bool one_thread = options.threads == 1;
  sward::RoamOptions roam;
  roam.max_triangles = uint32_t(state.range(3));
  for (auto _ : state) {
    sward::roam::RoamEngine engine(surface, roam);
    fixed_level_reference::PlainTriangles plain;
    sward::FixedTriangles coherent;
    std::vector<double> plain_ms, coherent_ms, triangles;
    for (int frame = 0; frame < flight::k_frames; ++frame) {
      const sward::View view = flight::low_view(moving ? frame : 0);
      if (!engine.update(view)) return state.SkipWithError("the view is not valid");
      const double start = now_ms(one_thread);
      fixed_level_reference::collect(engine.tree(), view, options, plain);
      const double middle = now_ms(one_thread);
      sward::roam::collect_fixed_level(engine.tree(), view, options, sward::roam::SurfaceState{1, {}}, coherent);
      const double end = now_ms(one_thread);
      if (coherent.size() != plain.triangles.size()) return state.SkipWithError("the sets differ");
      if (frame == 0) {
        state.counters["first_ms"] = end - middle;
        continue;
      }
      plain_ms.push_back(middle - start);
      coherent_ms.push_back(end - middle);
      triangles.push_back(double(coherent.size()));
    }
    flight::report(state, "plain_ms", plain_ms);
    flight::report(state, "coherent_ms", coherent_ms);
    state.counters["triangles_mean"] = flight::mean(triangles);
    state.counters["ns_a_triangle"] = 1e6 * flight::mean(coherent_ms) / flight::mean(triangles);
    state.counters["plain_over_coherent"] = flight::mean(plain_ms) / flight::mean(coherent_ms);
  }
}

void moving(benchmark::State& state) {
  run(state, true);
}
void still(benchmark::State& state) {
  run(state, false);
}

// About 5 000 triangles, about 100 000 on the same ground, about as many as far as 450 m.
void sizes(benchmark::internal::Benchmark* bench) {
  for (const int budget : {5000, 50000}) bench->Args({100, 110, 1, budget});
  for (const int threads : {1, 2}) bench->Args({100, 5, threads, 50000})->Args({450, 80, threads, 50000});
  bench->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK(moving)->Apply(sizes);
BENCHMARK(still)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
