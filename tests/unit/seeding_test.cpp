// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/seeding.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <random>

#include "counted_allocations.h"
#include "unit/plant_fixtures.h"
#include "vegetation/layer_params.h"

namespace sward {
namespace {

Layer law_layer(DensityLaw law, float density) {
  Layer layer;
  layer.species.resize(1);
  layer.law = law;
  layer.density = density;
  layer.full_distance_m = 5.0f;
  layer.horizon_m = 100.0f;
  return layer;
}

FixedTriangle triangle_at(float area, float distance) {
  FixedTriangle t;
  t.area = area;
  t.distance = distance;
  return t;
}

TEST(DistanceLaw, IsFullNearAndFallsAsDistance) {
  Layer layer = law_layer(DensityLaw::distance, 50.0f);
  const View view = test::view_at({0, 0, 0});
  EXPECT_FLOAT_EQ(seed_limit(layer, view, triangle_at(2.0f, 0.0f)), 100.0f);
  EXPECT_FLOAT_EQ(seed_limit(layer, view, triangle_at(2.0f, 5.0f)), 100.0f);
  EXPECT_FLOAT_EQ(seed_limit(layer, view, triangle_at(2.0f, 10.0f)), 50.0f);
  EXPECT_FLOAT_EQ(seed_limit(layer, view, triangle_at(2.0f, 80.0f)), 6.25f);
  EXPECT_EQ(seed_limit(layer, view, triangle_at(2.0f, 100.5f)), 0.0f);
  layer.falloff = 2.0f;
  EXPECT_FLOAT_EQ(seed_limit(layer, view, triangle_at(2.0f, 10.0f)), 25.0f);
}

TEST(DistanceLaw, ZoomScalesFullDistanceAndHorizon) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  const View view = test::view_at({0, 0, 0}, 2.0);
  EXPECT_NEAR(seed_limit(layer, view, triangle_at(2.0f, 10.0f)), 100.0f, 1e-3f);
  EXPECT_NEAR(seed_limit(layer, view, triangle_at(2.0f, 40.0f)), 25.0f, 1e-3f);
  EXPECT_GT(seed_limit(layer, view, triangle_at(2.0f, 199.0f)), 0.0f);
  EXPECT_EQ(seed_limit(layer, view, triangle_at(2.0f, 201.0f)), 0.0f);
}

TEST(ScreenLaw, IsEquation1) {
  Layer layer = law_layer(DensityLaw::screen_area, 50000.0f);
  layer.ceiling = 1000;
  layer.plain = true;
  const View view = test::view_at({0, 0, 0});
  FixedTriangle t = triangle_at(1.6f, 10.0f);
  t.screen_area = 0.001f;
  EXPECT_FLOAT_EQ(seed_limit(layer, view, t), 50.0f);
  t.screen_area = 0.5f;
  EXPECT_EQ(seed_limit(layer, view, t), 1000.0f);
  t.screen_area = std::numeric_limits<float>::infinity();
  EXPECT_EQ(seed_limit(layer, view, t), 1000.0f);
  t.screen_area = 0.0001f;
  layer.falloff = 0.5f;
  layer.density = 5000.0f;
  EXPECT_FLOAT_EQ(seed_limit(layer, view, t), 50.0f);
  t.distance = 101.0f;
  EXPECT_EQ(seed_limit(layer, view, t), 0.0f);
}

TEST(WorldLaw, IsEquation2WithItsSignMended) {
  Layer layer = law_layer(DensityLaw::world_area, 5000.0f);
  layer.ceiling = 1000;
  layer.plain = true;
  // Area 4.5 in the plane z = 0, centre (1, 1, 0).
  FixedTriangle t = triangle_at(4.5f, 1.0f);
  t.to_left = {3, 0, 0};
  t.to_right = {0, 3, 0};
  // Straight above: 5000 * 4.5 / 15^2 = 100.
  EXPECT_NEAR(seed_limit(layer, test::view_at({1, 1, 15}), t), 100.0f, 1e-3f);
  // At 45 degrees: the cosine, and twice the distance squared.
  EXPECT_NEAR(seed_limit(layer, test::view_at({1, 16, 15}), t), 100.0f / 2.0f * std::sqrt(0.5f), 1e-3f);
  EXPECT_EQ(seed_limit(layer, test::view_at({1, 1, -15}), t), 0.0f);
  EXPECT_EQ(seed_limit(layer, test::view_at({1, 1, 0.01}), t), 1000.0f);
}

// Outside of plain layers, too, they are the equations where the ground is far and faces the eye.
TEST(LawsOfArea, AreSteadyNearAndTheEquationsFarAway) {
  Layer layer = law_layer(DensityLaw::world_area, 5000.0f);
  FixedTriangle t = triangle_at(4.5f, 1.0f);
  t.to_left = {3, 0, 0};
  t.to_right = {0, 3, 0};
  const float facing = 0.5f * (1.0f + std::sqrt(1.25f)), edge = 0.25f;
  EXPECT_NEAR(seed_limit(layer, test::view_at({1, 1, 15}), t), 100.0f * facing, 1e-3f);
  EXPECT_NEAR(seed_limit(layer, test::view_at({1, 1, 0.01}), t), 225.0f * facing, 1e-2f);
  EXPECT_NEAR(seed_limit(layer, test::view_at({16, 1, 0}), t), 100.0f * edge, 1e-3f);
  EXPECT_LT(seed_limit(layer, test::view_at({1, 1, -15}), t), 6.0f);
  layer.law = DensityLaw::screen_area;
  const View view = test::view_at({1, 1, 15});
  const double focal = view.clip_from_eye[1][1];
  EXPECT_NEAR(seed_limit(layer, view, t), 100.0 * focal * focal * double(facing), 1e-2);
}

TEST(Bins, EdgesAreGeometricAndEndAtTheLargestCount) {
  for (const auto& [low, high] : {std::pair{1.0f, 4096.0f}, {1.0f, 2.0f}, {3.0f, 799.0f}, {17.0f, 16777215.0f}}) {
    const auto edges = bin_edges(low, high);
    EXPECT_EQ(edges[31], high);
    double before = low;
    for (const float edge : edges) {
      EXPECT_NEAR(edge / before, std::exp(std::log(double(high) / low) / 32.0), 1e-5);
      before = edge;
    }
  }
  for (const float edge : bin_edges(7.0f, 7.0f)) EXPECT_EQ(edge, 7.0f);
  EXPECT_NEAR(bin_edges(1.0f, 4294967296.0f)[3], 16.0f, 1e-4f);
}

/// Triangles with areas and distances from everywhere within and beyond the horizon.
FixedTriangles random_triangles(int count, uint32_t key) {
  std::mt19937 random(key);
  std::uniform_real_distribution<float> distance(0.0f, 120.0f), area(0.5f, 3.0f);
  FixedTriangles triangles;
  for (int i = 0; i < count; ++i) {
    FixedTriangle t = triangle_at(area(random), distance(random));
    t.apex = {double(i), -1.0, 3.0};
    t.to_left = {0, -1, 0};
    t.to_right = {1, 0, 0};
    t.id.bits = (uint64_t(24) << 58) + uint64_t(i);
    triangles.push_back(t);
  }
  return triangles;
}

uint32_t expected_seeds(const Layer& layer, const FixedTriangle& t) {
  if (t.distance > layer.horizon_m) return 0;
  const double thinning = std::max(double(t.distance) / layer.full_distance_m, 1.0);
  return uint32_t(std::ceil(double(t.area) * layer.density / thinning - 1e-4));
}

TEST(Seed, PutsEveryTriangleIntoTheBinOfItsCount) {
  const Layer layer = law_layer(DensityLaw::distance, 300.0f);
  const FixedTriangles triangles = random_triangles(5000, 1);
  const ColorMap map = test::plain_map(100.0, 8, {90, 120, 60, 255});
  Seeding seeding;
  seed(layer, test::view_at({0, 0, 0}), map, triangles, seeding);
  const auto edges = bin_edges(seeding.n_min, seeding.n_max);
  std::vector<bool> seen(triangles.size(), false);
  uint32_t next = 0, clusters = 0;
  float largest = 0.0f, smallest = 1e9f;
  for (int i = 0; i < k_density_bins; ++i) {
    const DensityBin& bin = seeding.bins[i];
    EXPECT_EQ(bin.first, next);
    next += bin.triangles;
    clusters += bin.triangles * bin.clusters;
    const float upper = edges[31 - i], lower = i < 31 ? edges[30 - i] : 0.0f;
    EXPECT_EQ(bin.clusters, bin.triangles == 0 ? 0u : uint32_t(std::ceil(upper / 8.0f)));
    for (uint32_t r = bin.first; r < bin.first + bin.triangles; ++r) {
      const TriangleRecord& record = seeding.records[r];
      const FixedTriangle t = triangles[seeding.source[r]];
      EXPECT_FALSE(seen[seeding.source[r]]);
      seen[seeding.source[r]] = true;
      EXPECT_EQ(record.id_low, t.id.low());
      EXPECT_EQ(record.submitted, expected_seeds(layer, t));
      EXPECT_FLOAT_EQ(record.limit, t.area * 300.0f);
      EXPECT_LE(float(record.submitted), upper);
      EXPECT_GT(float(record.submitted), lower);
      largest = std::max(largest, float(record.submitted));
      smallest = std::min(smallest, float(record.submitted));
    }
  }
  EXPECT_EQ(next, seeding.records.size());
  EXPECT_EQ(clusters, seeding.clusters);
  EXPECT_EQ(largest, seeding.n_max);
  EXPECT_EQ(smallest, seeding.n_min);
  for (size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], triangles.distance()[i] <= 100.0f) << i;
}

TEST(Seed, RecordsOfABinStandNearToFar) {
  const View view = test::view_at({40.0, -40.0, 2.0});
  const FixedTriangles ground = test::level_ground(128.0, 12, view.eye, 60.0);
  Layer layer;
  layer.horizon_m = 60.0f;
  Seeding seeding;
  seed(layer, view, ColorMap{1, 1, {glm::u8vec4(90, 120, 40, 255)}, {0.0, -128.0}, {128.0, 128.0}}, ground, seeding);
  ASSERT_GT(seeding.records.size(), 1000u);
  for (const DensityBin& bin : seeding.bins)
    for (uint32_t i = 1; i < bin.triangles; ++i) {
      const float before = ground.distance()[seeding.source[bin.first + i - 1]];
      const float here = ground.distance()[seeding.source[bin.first + i]];
      EXPECT_GE(here, before - 2.0f * std::sqrt(before * 60.0f) / 1024.0f - 1.0e-4f);
    }
}

TEST(Seed, OneCountFillsOneBin) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  FixedTriangles triangles;
  for (int i = 0; i < 9; ++i) triangles.push_back(triangle_at(2.0f, 1.0f));
  Seeding seeding;
  seed(layer, test::view_at({0, 0, 0}), test::plain_map(1.0, 1, {}), triangles, seeding);
  EXPECT_EQ(seeding.n_min, 100.0f);
  EXPECT_EQ(seeding.n_max, 100.0f);
  int filled = 0;
  for (const DensityBin& bin : seeding.bins) {
    if (bin.triangles == 0) continue;
    ++filled;
    EXPECT_EQ(bin.triangles, 9u);
    EXPECT_EQ(bin.clusters, 13u);
  }
  EXPECT_EQ(filled, 1);
  EXPECT_EQ(seeding.clusters, 117u);
}

TEST(Seed, NothingInSightIsNothingSubmitted) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  FixedTriangles triangles = random_triangles(20, 2);
  Seeding seeding;
  seed(layer, test::view_at({0, 0, 0}), test::plain_map(1.0, 1, {}), triangles, seeding);
  ASSERT_GT(seeding.records.size(), 0u);
  for (size_t i = 0; i < triangles.size(); ++i) {
    FixedTriangle t = triangles[i];
    t.distance = 1000.0f;
    triangles.set(i, t);
  }
  seed(layer, test::view_at({0, 0, 0}), test::plain_map(1.0, 1, {}), triangles, seeding);
  EXPECT_EQ(seeding.records.size(), 0u);
  EXPECT_EQ(seeding.clusters, 0u);
  EXPECT_EQ(seeding.n_max, 0.0f);
  for (const DensityBin& bin : seeding.bins) EXPECT_EQ(bin.triangles, 0u);
  seed(layer, test::view_at({0, 0, 0}), test::plain_map(1.0, 1, {}), FixedTriangles{}, seeding);
  EXPECT_EQ(seeding.records.size(), 0u);
}

TEST(Seed, RecordsAreRelativeToTheEyeAndTheMap) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  ColorMap map = test::plain_map(100.0, 50, {});
  map.min_corner = {1.0e7, 2.0e7};
  FixedTriangles triangles;
  triangles.set_surface_z(500.0);
  FixedTriangle t = triangle_at(2.0f, 3.0f);
  t.apex = {1.0e7 + 25.5, 2.0e7 + 69.5, 520.25};
  t.to_left = {-1, 0, 0.5f};
  t.to_right = {0, -2, 0.25f};
  t.id.bits = 0x123456789abcdef0;
  t.surface = 7;
  for (int i = 1; i < 7; ++i) triangles.add_node({});
  ASSERT_EQ(triangles.add_node({20.0f, {0, 0}, 0}), 7u);
  triangles.push_back(t);
  Seeding seeding;
  seed(layer, test::view_at({1.0e7 + 20.0, 2.0e7 + 70.0, 522.0}), map, triangles, seeding);
  ASSERT_EQ(seeding.records.size(), 1u);
  const TriangleRecord& r = seeding.records[0];
  EXPECT_EQ(r.apex, glm::vec3(5.5f, -0.5f, -1.75f));
  EXPECT_EQ(r.to_left, t.to_left);
  EXPECT_EQ(r.to_right, t.to_right);
  EXPECT_EQ(r.id_low, 0x9abcdef0u);
  EXPECT_EQ(r.id_high, 0x12345678u);
  EXPECT_EQ(r.surface, 7u);
  EXPECT_EQ(r.slope, 0.0f);  // no species asks for it
  EXPECT_EQ(r.surface_z, -22.0f);
  // 25.5 m from the west is texel 12.75; 30.5 m from the north row 15.25.
  EXPECT_EQ(r.texel, glm::ivec2(12, 15));
  EXPECT_EQ(r.texel_fraction, glm::vec2(0.75f, 0.25f));
  EXPECT_EQ(seeding.surface_z_origin, 500.0);
}

TEST(Seed, ApexFarFromTheMapStaysOutside) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  FixedTriangles triangles;
  FixedTriangle t = triangle_at(2.0f, 3.0f);
  t.apex = {1.0e15, -1.0e15, 0.0};
  triangles.push_back(t);
  Seeding seeding;
  seed(layer, test::view_at({0, 0, 0}), test::plain_map(1.0, 16, {}), triangles, seeding);
  ASSERT_EQ(seeding.records.size(), 1u);
  EXPECT_GT(seeding.records[0].texel.x, 16);
  EXPECT_GT(seeding.records[0].texel.y, 16);
}

TEST(Seed, FinerGroundThatComesNearerGetsMoreSeeds) {
  const Layer layer = law_layer(DensityLaw::distance, 50.0f);
  FixedTriangles triangles;
  FixedTriangle t = triangle_at(2.0f, 20.0f);
  t.to_left = {2, 0, 0};
  t.to_right = {0, 2, 0};
  t.surface = 1;
  triangles.add_node({0.0f, {0, 2}, 0});
  triangles.add_node({10.0f, {0, 0}, 0});
  triangles.push_back(t);
  Seeding seeding;
  seed(layer, test::view_at({0, 0, 20}), test::plain_map(1.0, 1, {}), triangles, seeding);
  ASSERT_EQ(seeding.records.size(), 1u);
  // 10 m nearer than its plane: 2 * 50 / 2 instead of / 4.
  EXPECT_EQ(seeding.records[0].submitted, 50u);
}

TEST(Seed, SteadyFramesAllocateNothing) {
  const Layer layer = law_layer(DensityLaw::distance, 300.0f);
  const FixedTriangles triangles = random_triangles(3000, 3), fewer = random_triangles(2500, 4);
  const ColorMap map = test::plain_map(100.0, 8, {});
  const View view = test::view_at({0, 0, 0});
  Seeding seeding;
  seed(layer, view, map, triangles, seeding);
  const long before = g_allocations;
  ASSERT_GT(before, 0);
  seed(layer, view, map, triangles, seeding);
  seed(layer, view, map, fewer, seeding);
  seed(layer, view, map, triangles, seeding);
  EXPECT_EQ(g_allocations, before);
}

shared::LayerParams params_of(const Layer& layer) {
  return make_layer_params(layer, test::view_at({0, 0, 0}), MapGeometry{}, 0.0f);
}

shared::uvec2 id_of(uint32_t i) {
  return {i << 11, 0x60400000u};
}

TEST(Presence, FadesWithoutJumps) {
  const shared::LayerParams layer = params_of(law_layer(DensityLaw::distance, 50.0f));
  for (uint32_t i = 0; i < 10; ++i) {
    for (const uint32_t rank : {0u, 1u, 5u, 20u, 60u, 99u}) {
      float before = shared::seed_presence(layer, 100.0f, id_of(i), rank, 0.0f).fade;
      for (float d = 0.01f; d < 101.0f; d += 0.01f) {
        const float fade = shared::seed_presence(layer, 100.0f, id_of(i), rank, d).fade;
        EXPECT_LE(fade, before + 1e-6f);
        EXPECT_LT(before - fade, 0.011f) << rank << ' ' << d;
        before = fade;
      }
      EXPECT_EQ(before, 0.0f);
    }
  }
}

TEST(Presence, GrowsInOverTheLastFortyPercent) {
  const shared::LayerParams layer = params_of(law_layer(DensityLaw::distance, 50.0f));
  const float start = shared::first_rank(id_of(3));
  ASSERT_GE(start, 0.0f);
  ASSERT_LT(start, 1.0f);
  // At 10 m 50 seeds of 100 are due: full to 30, half at 40.
  for (const auto& [rank, fade] : {std::pair{0u, 1.0f}, {28u, 1.0f}, {40u, 0.5f}, {48u, 0.1f}, {50u, 0.0f}}) {
    const float expected = rank == 0 || rank == 28 || rank == 50 ? fade : fade - start / 20.0f;
    EXPECT_NEAR(shared::seed_presence(layer, 100.0f, id_of(3), rank, 10.0f).fade, expected, 1e-5f) << rank;
  }
}

TEST(Presence, SinksAndThinsOutOverTheLastFifthOfTheHorizon) {
  const shared::LayerParams layer = params_of(law_layer(DensityLaw::distance, 50.0f));
  // Ten seeds are due at 100 m for a limit of 200; at 90 m half of 11.1.
  int shown = 0;
  for (uint32_t rank = 0; rank < 12; ++rank) {
    const shared::Presence p = shared::seed_presence(layer, 200.0f, id_of(1), rank, 90.0f);
    EXPECT_LE(p.fade, 0.5f + 1e-6f);
    shown += p.fade > 0.0f ? 1 : 0;
  }
  EXPECT_GE(shown, 5);
  EXPECT_LE(shown, 6);
  EXPECT_EQ(shared::seed_presence(layer, 200.0f, id_of(1), 0, 100.0f).fade, 0.0f);
}

TEST(Presence, WidensByTheThinningUpToEight) {
  const shared::LayerParams layer = params_of(law_layer(DensityLaw::distance, 50.0f));
  EXPECT_FLOAT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 3.0f).widen, 1.0f);
  EXPECT_FLOAT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 15.0f).widen, 3.0f);
  EXPECT_FLOAT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 70.0f).widen, 8.0f);
  Layer screen = law_layer(DensityLaw::screen_area, 50.0f);
  screen.ceiling = 1000;
  EXPECT_FLOAT_EQ(shared::seed_presence(params_of(screen), 250.0f, id_of(1), 0, 3.0f).widen, 4.0f);
}

TEST(Presence, PlainIsAllOrNothing) {
  Layer plain = law_layer(DensityLaw::distance, 50.0f);
  plain.plain = true;
  const shared::LayerParams layer = params_of(plain);
  EXPECT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 49, 10.0f).fade, 1.0f);
  EXPECT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 50, 10.0f).fade, 0.0f);
  EXPECT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 99.9f).fade, 1.0f);
  EXPECT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 100.1f).fade, 0.0f);
  EXPECT_EQ(shared::seed_presence(layer, 100.0f, id_of(1), 0, 60.0f).widen, 1.0f);
}

TEST(Presence, ShowsOnAverageWhatTheLawSays) {
  const shared::LayerParams layer = params_of(law_layer(DensityLaw::distance, 50.0f));
  constexpr int k_triangles = 20000;
  for (const float due : {0.3f, 2.6f}) {
    int shown = 0;
    for (uint32_t i = 0; i < k_triangles; ++i) {
      for (uint32_t rank = 0; rank < 4; ++rank) {
        shown += shared::seed_presence(layer, due, id_of(i), rank, 1.0f).fade > 0.0f ? 1 : 0;
      }
    }
    // The whole part is certain; the fraction is a coin a triangle. Four standard deviations.
    const double fraction = due - std::floor(due);
    EXPECT_NEAR(shown, due * k_triangles, 4.0 * std::sqrt(fraction * (1.0 - fraction) * k_triangles));
  }
}

TEST(Segments, FollowEquation4) {
  Layer layer = law_layer(DensityLaw::distance, 50.0f);
  layer.full_segments_m = 6.0f;
  layer.species[0].max_segments = 8;
  const auto species = make_species_params(layer)[0];
  EXPECT_FLOAT_EQ(shared::segment_count(species, params_of(layer), 3.0f), 8.0f);
  EXPECT_FLOAT_EQ(shared::segment_count(species, params_of(layer), 12.0f), 2.0f);
  EXPECT_FLOAT_EQ(shared::segment_count(species, params_of(layer), 50.0f), 1.0f);
}

}  // namespace
}  // namespace sward
