// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rays and lines of sight a second on 2049 x 2049 samples at 5 m (350 m of relief), with and without relief below the
// data, and the same by stepping along the ray at the sample spacing (which, unlike them, is not exact). One thread.
//   bench_queries [--benchmark_filter=...]
#include <benchmark/benchmark.h>
#include <sward/terrain/queries.h>

#include "roam_support.h"

namespace {

constexpr int k_questions = 4096;
constexpr double k_spacing = 5;

const roam_support::Terrain& terrain(bool detail) {
  const auto make = [](bool relief) {
    roam_support::TerrainOptions options;
    options.columns = options.rows = 2049;
    options.spacing = k_spacing;
    options.relief_m = 350;
    options.octaves = 10;
    options.wavelength = 700;
    options.detail = relief;
    return roam_support::make_terrain(options);
  };
  static const roam_support::Terrain plain = make(false), relief = make(true);
  return detail ? relief : plain;
}

enum Kind { k_pick, k_eye_level };

// Picks: from 300 m above the ground downwards at random. Eye level: from 2 m, within 3 degrees of the horizon.
std::vector<sward::Ray> make_rays(const sward::HeightField& field, Kind kind) {
  roam_support::Random random(1);
  std::vector<sward::Ray> rays(k_questions);
  for (sward::Ray& ray : rays) {
    const glm::dvec2 xy(random.uniform(-4000, 4000), random.uniform(-4000, 4000));
    const double azimuth = random.uniform(-3.14, 3.14);
    const double pitch = kind == k_pick ? random.uniform(-1.4, -0.1) : random.uniform(-0.05, 0.05);
    ray.origin = {xy, field.height(xy) + (kind == k_pick ? 300 : 2)};
    ray.direction = {std::cos(azimuth) * std::cos(pitch), std::sin(azimuth) * std::cos(pitch), std::sin(pitch)};
  }
  return rays;
}

// Between points 10 m above the ground, up to 3 km apart.
std::vector<sward::Sight> make_sights(const sward::HeightField& field) {
  roam_support::Random random(2);
  std::vector<sward::Sight> sights(k_questions);
  const auto lifted = [&](glm::dvec2 xy) { return glm::dvec3(xy, field.height(xy) + 10); };
  for (sward::Sight& sight : sights) {
    const glm::dvec2 xy(random.uniform(-2500, 2500), random.uniform(-2500, 2500));
    const double azimuth = random.uniform(-3.14, 3.14), distance = random.uniform(50, 3000);
    sight = {lifted(xy), lifted(xy + distance * glm::dvec2(std::cos(azimuth), std::sin(azimuth)))};
  }
  return sights;
}

// First step that is in the ground; negative when it leaves the field or its heights.
double step_along(const sward::HeightField& field, const glm::dvec3& from, const glm::dvec3& unit, double length) {
  const double across = std::max(glm::length(glm::dvec2(unit)), 0.05);
  for (double t = 0; t <= length; t += k_spacing / across) {
    const glm::dvec3 p = from + t * unit;
    const double z = field.height(glm::dvec2(p));
    if (std::isnan(z) || p.z > field.height_range()[1]) {
      if (unit.z >= 0 || std::isnan(z)) return -1;
      continue;
    }
    if (p.z < z) return t;
  }
  return -1;
}

void rays(benchmark::State& state, Kind kind, bool detail, bool stepping) {
  const roam_support::Terrain& ground = terrain(detail);
  const sward::TerrainQueries queries(*ground.bounds);
  const std::vector<sward::Ray> asked = make_rays(*ground.field, kind);
  std::vector<std::optional<sward::RayHit>> hits(asked.size());
  for (auto _ : state) {
    if (stepping) {
      for (const sward::Ray& ray : asked)
        benchmark::DoNotOptimize(step_along(*ground.field, ray.origin, ray.direction, 1e9));
    } else {
      queries.rays(asked, hits, 1);
    }
  }
  state.SetItemsProcessed(int64_t(state.iterations()) * k_questions);
}

void sights(benchmark::State& state, bool detail, bool stepping) {
  const roam_support::Terrain& ground = terrain(detail);
  const sward::TerrainQueries queries(*ground.bounds);
  const std::vector<sward::Sight> asked = make_sights(*ground.field);
  std::vector<sward::SightResult> seen(asked.size());
  for (auto _ : state) {
    if (stepping) {
      for (const sward::Sight& sight : asked) {
        const double length = glm::distance(sight.from, sight.to);
        benchmark::DoNotOptimize(step_along(*ground.field, sight.from, (sight.to - sight.from) / length, length));
      }
    } else {
      queries.lines_of_sight(asked, seen, 1);
    }
  }
  double visible = 0;
  for (const sward::SightResult& result : seen) visible += result.visible ? 1.0 / k_questions : 0;
  if (!stepping) state.counters["visible"] = visible;
  state.SetItemsProcessed(int64_t(state.iterations()) * k_questions);
}

void heights(benchmark::State& state, bool detail) {
  const roam_support::Terrain& ground = terrain(detail);
  const sward::TerrainQueries queries(*ground.bounds);
  roam_support::Random random(3);
  std::vector<glm::dvec2> places(1 << 16);
  for (glm::dvec2& place : places) place = {random.uniform(-5000, 5000), random.uniform(-5000, 5000)};
  std::vector<double> out(places.size());
  for (auto _ : state) queries.heights(places, out, 1);
  state.SetItemsProcessed(int64_t(state.iterations() * places.size()));
}

BENCHMARK_CAPTURE(rays, pick, k_pick, false, false);
BENCHMARK_CAPTURE(rays, pick_stepping, k_pick, false, true);
BENCHMARK_CAPTURE(rays, pick_relief, k_pick, true, false);
BENCHMARK_CAPTURE(rays, pick_relief_stepping, k_pick, true, true);
BENCHMARK_CAPTURE(rays, eye_level, k_eye_level, false, false);
BENCHMARK_CAPTURE(rays, eye_level_stepping, k_eye_level, false, true);
BENCHMARK_CAPTURE(rays, eye_level_relief, k_eye_level, true, false);
BENCHMARK_CAPTURE(rays, eye_level_relief_stepping, k_eye_level, true, true);
BENCHMARK_CAPTURE(sights, plain, false, false);
BENCHMARK_CAPTURE(sights, plain_stepping, false, true);
BENCHMARK_CAPTURE(sights, relief, true, false);
BENCHMARK_CAPTURE(sights, relief_stepping, true, true);
BENCHMARK_CAPTURE(heights, plain, false);
BENCHMARK_CAPTURE(heights, relief, true);

}  // namespace

BENCHMARK_MAIN();
