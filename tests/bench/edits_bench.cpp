// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Cost of an edit (samples, relief, bounds) by the samples it covers, on 2049 x 2049 samples at 5 m.
//   bench_edits [--benchmark_filter=...]
#include <benchmark/benchmark.h>
#include <sward/terrain/edits.h>

#include "roam_support.h"

namespace {

roam_support::Terrain& terrain(bool detail) {
  const auto make = [](bool relief) {
    roam_support::TerrainOptions options;
    options.columns = options.rows = 2049;
    options.spacing = 5;
    options.relief_m = 350;
    options.octaves = 10;
    options.wavelength = 700;
    options.detail = relief;
    return roam_support::make_terrain(options);
  };
  static roam_support::Terrain plain = make(false), relief = make(true);
  return detail ? relief : plain;
}

// A square of state.range(0) samples a side, raised and lowered again at one of many places.
void edits(benchmark::State& state, bool detail) {
  roam_support::Terrain& ground = terrain(detail);
  roam_support::Random random(1);
  const double half = 2.5 * double(state.range(0)) - 0.1;
  int64_t samples = 0;
  for (auto _ : state) {
    const glm::dvec2 centre(random.uniform(-2500, 2500), random.uniform(-2500, 2500));
    sward::Edit edit;
    edit.region = sward::EditRegion::rectangle(centre - half, centre + half, 0.2 * half);
    for (const auto kind : {sward::Edit::Kind::raise, sward::Edit::Kind::lower}) {
      edit.kind = kind;
      samples += sward::edit(*ground.field, *ground.bounds, edit)->samples;
    }
  }
  state.SetItemsProcessed(samples);
}

void from_scratch(benchmark::State& state, bool detail) {
  for (auto _ : state) benchmark::DoNotOptimize(sward::Bounds::create(*terrain(detail).field, 1));
}

BENCHMARK_CAPTURE(edits, plain, false)->Arg(1)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(edits, relief, true)->Arg(1)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(from_scratch, plain, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(from_scratch, relief, true)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
