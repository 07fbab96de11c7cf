// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding of the fixed-level triangles of a low flight: counts, bins, records.
//   bench_seeding [--benchmark_filter=...]
#include <sward/vegetation/seeding.h>

#include <cmath>

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

// A winding road of 400 corners from west to east through the eye's way, and discs all around it.
sward::Exclusions shapes_around(const sward::View& view, int count) {
  sward::Exclusions shapes;
  if (count == 0) return shapes;
  std::vector<glm::dvec2> road;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < 200; ++i) {
      const double x = 10.0 * (side == 0 ? i - 100 : 99 - i);
      road.emplace_back(view.eye.x + x, view.eye.y + 20 * std::sin(0.02 * x) + 3 * (side == 0 ? -1 : 1));
    }
  }
  (void)shapes.add(sward::ExclusionShape::polygon(road));
  uint32_t state = 1;
  const auto random = [&state] { return double((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0 - 0.5; };
  for (int i = 1; i < count; ++i) {
    const glm::dvec2 centre = glm::dvec2(view.eye) + 1000.0 * glm::dvec2(random(), random());
    (void)shapes.add(sward::ExclusionShape::disc(centre, 4 + 6 * (random() + 0.5)));
  }
  return shapes;
}

// Arguments: horizon in metres, area of a triangle in hundredths of a square metre, excluded shapes.
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
    std::vector<double> seed_ms, first_ms, records, shape_texels;
    const sward::Exclusions shapes = shapes_around(flight::low_view(0), int(state.range(2)));
    for (int frame = 0; frame < flight::k_frames; frame += 5) {
      const sward::View view = flight::low_view(frame);
      if (!mesh->update(view)) return state.SkipWithError("the view is not valid");
      mesh->fixed_level_triangles({level, layer.horizon_m, 1, true}, triangles);
      double best = 1e9;
      for (int repeat = 0; repeat < 5; ++repeat) {
        const double start = flight::thread_ms();
        sward::seed(layer, view, map, triangles, out, &shapes);
        if (repeat == 0) first_ms.push_back(flight::thread_ms() - start);
        best = std::min(best, flight::thread_ms() - start);
      }
      seed_ms.push_back(best);
      records.push_back(double(out.records.size()));
      shape_texels.push_back(double(out.exclusions.size()));
    }
    flight::report(state, "seed_ms", seed_ms);
    flight::report(state, "first_ms", first_ms);
    state.counters["shape_texels_mean"] = flight::mean(shape_texels);
    state.counters["records_mean"] = flight::mean(records);
    state.counters["ns_per_record"] = 1e6 * flight::mean(seed_ms) / flight::mean(records);
  }
}

BENCHMARK(seeding)
    ->Args({100, 160, 0})
    ->Args({100, 160, 1})
    ->Args({100, 160, 100})
    ->Args({100, 160, 1000})
    ->Args({400, 160, 0})
    ->Args({400, 160, 100})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
