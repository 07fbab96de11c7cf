// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding of the fixed-level triangles of a low flight: counts, bins, records.
//   bench_seeding [--benchmark_filter=...]
#include <sward/vegetation/seeding.h>

#include "flight.h"

namespace {

sward::ColorMap colors_of(const sward::HeightField& field) {
  sward::ColorMap map;
  map.width = map.height = 2048;
  map.min_corner = field.min_corner();
  map.size = field.max_corner() - field.min_corner();
  map.texels.assign(size_t(map.width) * size_t(map.height), {90, 130, 50, 255});
  return map;
}

// Arguments: horizon in metres, area of a triangle in hundredths of a square metre.
void seeding(benchmark::State& state) {
  const sward::HeightField& field = *flight::terrain().field;
  const sward::ColorMap map = colors_of(field);
  sward::Layer layer;
  layer.horizon_m = float(state.range(0));
  const int level = sward::level_for_area(field, 0.01 * double(state.range(1)));
  sward::RoamOptions options;
  options.max_triangles = 50000;
  for (auto _ : state) {
    auto mesh = sward::RoamMesh::create(*flight::terrain().bounds, options);
    sward::FixedTriangles triangles;
    sward::Seeding out;
    std::vector<double> seed_ms, records;
    for (int frame = 0; frame < flight::k_frames; frame += 5) {
      const sward::View view = flight::low_view(frame);
      if (!mesh->update(view)) return state.SkipWithError("the view is not valid");
      mesh->fixed_level_triangles({level, layer.horizon_m, 1, true}, triangles);
      double best = 1e9;
      for (int repeat = 0; repeat < 5; ++repeat) {
        const double start = flight::thread_ms();
        sward::seed(layer, view, map, triangles, out);
        best = std::min(best, flight::thread_ms() - start);
      }
      seed_ms.push_back(best);
      records.push_back(double(out.records.size()));
    }
    flight::report(state, "seed_ms", seed_ms);
    state.counters["records_mean"] = flight::mean(records);
    state.counters["ns_per_record"] = 1e6 * flight::mean(seed_ms) / flight::mean(records);
  }
}

BENCHMARK(seeding)->Args({100, 160})->Args({400, 160})->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
