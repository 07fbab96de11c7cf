// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding on the GPU over a clipmap against the CPU's: the same triangles, records and plants.
#include <sward/terrain/roam_mesh.h>
#include <sward/vegetation/clipmap_seeding.h>

#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "clipmap_support.h"
#include "gl/twins.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class ClipmapSeeding : public GlTest {};

/// Green with brown patches.
ColorMap patches(const HeightField& field) {
  ColorMap map = plain_map(1, 96, k_green);
  for (int row = 0; row < 96; ++row)
    for (int column = 0; column < 96; ++column)
      if ((column / 5 + row / 7) % 3 == 0) map.texels[size_t(row * 96 + column)] = k_brown;
  map.min_corner = field.min_corner();
  map.size = field.max_corner() - map.min_corner;
  map.bounds = bound_colors(map);
  return map;
}

Layer meadow(float triangle_area_m2, float horizon_m = 40) {
  Layer layer;
  layer.species = {grass_of("grass", k_green), grass_of("sedge", {120, 120, 60, 255}), bare_of("soil", k_brown)};
  // Nothing can be fed in the middle of a brown patch.
  layer.species[0].max_distance = layer.species[1].max_distance = 0.12f;
  layer.triangle_area_m2 = triangle_area_m2;
  layer.horizon_m = horizon_m;
  layer.density = 12;
  layer.full_distance_m = 6;
  return layer;
}

/// A layer over a clipmap, and over a mesh of the same ground.
struct Meadow {
  ClipmapGround ground;
  ColorMap map;
  Layer layer;
  gl::GroundTextures textures;
  gl::Clipmap clipmap;
  ClipmapSeeder seeder;
  VegetationRenderer renderer;
  gl::Frame frame;
  gl::Lighting light;
  Exclusions exclusions;
  View view;
  FixedTriangles triangles;
  Seeding seeding;

  Meadow(const ClipmapField& from, Layer of, int texels = 128)
      : ground(from),
        map(patches(*ground.field)),
        layer(std::move(of)),
        textures(gl::GroundTextures::create(*ground.field, map).value()),
        clipmap(gl::Clipmap::create(*ground.surface, {texels}).value()),
        seeder(ClipmapSeeder::create(layer, *ground.surface, map, gl::ShaderLibrary()).value()),
        renderer(VegetationRenderer::create_for_clipmap(layer, gl::ShaderLibrary()).value()),
        frame(gl::Frame::create().value()) {}

  void look(const View& at) {
    view = at;
    clipmap.follow(view);
    frame.upload(view, light, 0, 1);
    const auto seeded = seeder.seed(view, clipmap, &exclusions);
    ASSERT_TRUE(seeded) << seeded.error().message;
    renderer.upload(seeder, clipmap, view);
    seeder.read_back(view, clipmap, triangles, seeding);
  }

  std::vector<Plant> gpu() {
    renderer.classify(frame, textures, 0);
    auto plants = renderer.read_back(frame, textures, view, seeding, 0);
    EXPECT_TRUE(plants) << plants.error().message;
    EXPECT_FALSE(renderer.stats(true).overflow);
    sort_plants(*plants);
    return std::move(*plants);
  }
  std::vector<Plant> twin() const {
    std::vector<Plant> plants = grow_plants(layer, view, map, triangles, seeding, light.sun_azimuth);
    sort_plants(plants);
    return plants;
  }
};

/// The CPU's seeding of the same view over a fine mesh.
struct OnMesh {
  FixedTriangles triangles;
  Seeding seeding;
  std::vector<Plant> plants;

  explicit OnMesh(const Meadow& meadow) {
    RoamOptions options;
    options.max_triangles = 60000;
    RoamMesh mesh = RoamMesh::create(*meadow.ground.bounds, options).value();
    EXPECT_TRUE(mesh.update(meadow.view));
    FixedLevelOptions level;
    level.level = level_for_area(*meadow.ground.field, double(meadow.layer.triangle_area_m2));
    level.horizon_m = meadow.layer.horizon_m * float(meadow.view.zoom());
    level.canopy_m = canopy_height(meadow.layer);
    level.spread_m = canopy_spread(meadow.layer);
    level.skip_back_faces = meadow.layer.plain;
    level.altitudes = needs_altitudes(meadow.layer);
    mesh.fixed_level_triangles(level, triangles);
    seed(meadow.layer, meadow.view, meadow.map, triangles, seeding, &meadow.exclusions);
    plants = grow_plants(meadow.layer, meadow.view, meadow.map, triangles, seeding, meadow.light.sun_azimuth);
    sort_plants(plants);
  }
};

uint64_t id_of(const TriangleRecord& record) {
  return uint64_t(record.id_high) << 32 | record.id_low;
}

std::map<uint64_t, TriangleRecord> by_id(const Seeding& seeding) {
  std::map<uint64_t, TriangleRecord> records;
  for (const TriangleRecord& record : seeding.records) EXPECT_TRUE(records.emplace(id_of(record), record).second);
  return records;
}

bool same_bits(glm::vec2 a, glm::vec2 b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

/// What is static is the same to the bit, whatever surface is drawn.
void expect_same_records(const Seeding& gpu, const Seeding& cpu, DensityLaw law) {
  const auto ours = by_id(gpu), theirs = by_id(cpu);
  size_t common = 0, wrong = 0;
  for (const auto& [id, a] : ours) {
    const auto found = theirs.find(id);
    if (found == theirs.end()) continue;
    const TriangleRecord& b = found->second;
    ++common;
    wrong += !same_bits(glm::vec2(a.apex), glm::vec2(b.apex)) ||
             !same_bits(glm::vec2(a.to_left), glm::vec2(b.to_left)) ||
             !same_bits(glm::vec2(a.to_right), glm::vec2(b.to_right)) || a.texel != b.texel ||
             !same_bits(a.texel_fraction, b.texel_fraction) || a.slope != b.slope || a.altitude != b.altitude ||
             (a.exclusions == 0) != (b.exclusions == 0);
    if (law == DensityLaw::distance) wrong += a.limit != b.limit;
  }
  EXPECT_EQ(wrong, 0u);
  // All but a few at the frustum's sides, where the one or the other knows its ground's height a little better.
  EXPECT_GE(double(common), 0.97 * double(theirs.size()));
}

bool in_picture(const View& view, glm::dvec3 place) {
  const glm::dvec4 c = view.clip_from_relative() * glm::dvec4(place - view.eye, 1);
  return c.w > 0.2 && std::abs(c.x) < c.w && std::abs(c.y) < c.w;
}

struct Compared {
  size_t matched = 0, missing = 0, extra = 0, wrong = 0;
};

/// Plants that are in the picture and more than a hint, of either list, in the other.
Compared compare(const View& view, const std::vector<Plant>& ours, const std::vector<Plant>& theirs) {
  Compared result;
  const auto counts = [&](const Plant& p) { return p.fade > 0.02f && in_picture(view, p.position); };
  const auto find = [](const std::vector<Plant>& in, const Plant& p) -> const Plant* {
    const auto at = std::lower_bound(in.begin(), in.end(), p,
                                     [](const Plant& a, const Plant& b) { return plant_key(a) < plant_key(b); });
    return at != in.end() && plant_key(*at) == plant_key(p) ? &*at : nullptr;
  };
  for (const Plant& p : ours) {
    if (!counts(p)) continue;
    const Plant* q = find(theirs, p);
    if (q == nullptr) {
      ++result.extra;
      continue;
    }
    ++result.matched;
    result.wrong += glm::length(glm::dvec2(p.position - q->position)) > 1e-3 ||
                    std::abs(p.height - q->height) > 1e-4f * q->height ||
                    std::abs(p.width - q->width) > 1e-4f * q->width || std::abs(p.score - q->score) > 1e-4f ||
                    std::abs(p.azimuth - q->azimuth) > 1e-4f;
  }
  for (const Plant& q : theirs)
    if (counts(q)) result.missing += find(ours, q) == nullptr;
  return result;
}

/// Bins as the CPU lays them out: geometric, largest first, all of what is asked for submitted.
void expect_good_bins(const Meadow& meadow) {
  const Seeding& s = meadow.seeding;
  uint32_t first = 0, clusters = 0, least = UINT32_MAX, most = 0;
  for (const TriangleRecord& record : s.records) {
    least = std::min(least, record.submitted);
    most = std::max(most, record.submitted);
  }
  ASSERT_FALSE(s.records.empty());
  EXPECT_EQ(s.n_min, float(least));
  EXPECT_EQ(s.n_max, float(most));
  const auto edges = bin_edges(s.n_min, s.n_max);
  for (int i = 0; i < k_density_bins; ++i) {
    const DensityBin& bin = s.bins[size_t(i)];
    EXPECT_EQ(bin.first, first);
    const float edge = edges[size_t(k_density_bins - 1 - i)];
    if (bin.triangles > 0) {
      EXPECT_NEAR(bin.clusters, std::ceil(edge / float(meadow.layer.cluster_size)), 1.0) << "an edge rounds elsewhere";
    }
    for (uint32_t k = first; k < first + bin.triangles; ++k) {
      EXPECT_LE(float(s.records[k].submitted), edge * 1.00001f);
      EXPECT_GE(bin.clusters * uint32_t(meadow.layer.cluster_size), s.records[k].submitted);
    }
    first += bin.triangles;
    clusters += bin.triangles * bin.clusters;
  }
  EXPECT_EQ(first, s.records.size());
  EXPECT_EQ(clusters, s.clusters);
  EXPECT_LE(s.clusters, meadow.seeder.most_clusters());
}

/// Returns how many plants were compared.
size_t expect_same_as_everywhere(Meadow& meadow, size_t at_least) {
  expect_good_bins(meadow);
  const std::vector<Plant> gpu = meadow.gpu(), twin = meadow.twin();
  const OnMesh mesh(meadow);
  expect_same_records(meadow.seeding, mesh.seeding, meadow.layer.law);
  const Compared with_twin = compare(meadow.view, gpu, twin), with_mesh = compare(meadow.view, gpu, mesh.plants);
  EXPECT_GE(with_twin.matched, at_least);
  EXPECT_EQ(with_twin.wrong, 0u);
  EXPECT_LE(double(with_twin.missing + with_twin.extra), 0.001 * double(with_twin.matched) + 0.5);
  EXPECT_EQ(with_mesh.wrong, 0u);
  // Distances follow the drawn height, and the mesh's is not the rings': a plant may be a hint here and none there.
  EXPECT_LE(double(with_mesh.missing + with_mesh.extra), 0.002 * double(with_mesh.matched) + 0.5)
      << with_mesh.missing << " missing, " << with_mesh.extra << " extra of " << with_mesh.matched;
  for (const Plant& plant : gpu)
    EXPECT_NEAR(plant.position.z, meadow.clipmap.rings().height(glm::dvec2(plant.position)), 1e-3);
  return with_twin.matched;
}

TEST_F(ClipmapSeeding, TheSamePlantsAtEvenAndOddLevels) {
  // Some larger than the rings' cells by far, and some so small that there are several runs of work groups.
  for (const float area : {16.0f, 8.0f, 4.0f, 2.0f, 0.5f, 128.0f}) {
    SCOPED_TRACE(area);
    Meadow meadow_of({}, meadow(area));
    meadow_of.look(view_over(meadow_of.ground, {12, -31}, 1.7, 40, -15));
    expect_same_as_everywhere(meadow_of, 200);
  }
}

TEST_F(ClipmapSeeding, TheSamePlantsFromAnyEye) {
  Meadow at({.samples = {97, 65}, .holes = true}, meadow(4));  // two root squares wide and more
  ASSERT_TRUE(at.exclusions.add(ExclusionShape::disc({-20, 10}, 12)));
  ASSERT_TRUE(at.exclusions.add(ExclusionShape::polygon({{10, -30}, {40, -25}, {30, 5}})));
  std::mt19937 random(23);
  size_t compared = 0;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 14; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec2 xy((unit(random) - 0.5) * 370, (unit(random) - 0.5) * 240);
    at.look(
        view_over(at.ground, xy, 1 + 12 * unit(random) * unit(random), 360 * unit(random), -10 - 50 * unit(random)));
    if (at.seeding.records.size() < 60) continue;  // out over the edge
    compared += expect_same_as_everywhere(at, 0);
  }
  EXPECT_GT(compared, 2000u);
}

TEST_F(ClipmapSeeding, TheSamePlantsUnderEveryLaw) {
  for (const DensityLaw law : {DensityLaw::screen_area, DensityLaw::world_area}) {
    for (const bool plain : {false, true}) {
      SCOPED_TRACE(std::to_string(int(law)) + (plain ? " plain" : ""));
      Layer layer = meadow(4);
      layer.law = law;
      layer.plain = plain;
      layer.density = 3000;
      layer.ceiling = 60;
      Meadow at({}, layer);
      at.look(view_over(at.ground, {12, -31}, 2.5, 40, -15));
      expect_good_bins(at);
      const std::vector<Plant> gpu = at.gpu(), twin = at.twin();
      const Compared with_twin = compare(at.view, gpu, twin);
      EXPECT_GE(with_twin.matched, 200u);
      EXPECT_EQ(with_twin.wrong, 0u);
      EXPECT_LE(double(with_twin.missing + with_twin.extra), 0.001 * double(with_twin.matched) + 0.5);
      // The laws measure drawn triangles: seed_limit() of the same ones.
      for (size_t i = 0; i < at.seeding.records.size(); ++i) {
        FixedTriangle t = at.triangles[i];
        t.distance = 0;
        if (plain && law == DensityLaw::screen_area) continue;  // FixedTriangle::screen_area is not read back
        const float limit = seed_limit(layer, at.view, t);
        ASSERT_NEAR(at.seeding.records[i].limit, limit, 1e-3f * limit + 1e-4f);
      }
    }
  }
}

TEST_F(ClipmapSeeding, PlainLayersByDistance) {
  Layer layer = meadow(4);
  layer.plain = true;
  Meadow at({}, layer);
  at.look(view_over(at.ground, {12, -31}, 2.5, 40, -15));
  expect_same_records(at.seeding, OnMesh(at).seeding, layer.law);
  EXPECT_EQ(compare(at.view, at.gpu(), at.twin()).wrong, 0u);
}

TEST_F(ClipmapSeeding, PlantsAreThoseOfARegionsQuery) {
  Meadow at({}, meadow(2));
  at.look(view_over(at.ground, {3, 8}, 1.7, 70, -20));
  const std::vector<Plant> gpu = at.gpu();
  auto all = query_plants(at.layer, *at.ground.surface, at.map,
                          PlantRegion::disc(glm::dvec2(at.view.eye), double(at.layer.horizon_m) + 5));
  ASSERT_TRUE(all) << all.error().message;
  std::map<std::tuple<uint64_t, uint32_t, uint32_t>, Plant> known;
  for (const Plant& plant : *all) known.emplace(plant_key(plant), plant);
  size_t missing = 0, in_finest = 0;
  for (const Plant& plant : gpu) {
    const auto found = known.find(plant_key(plant));
    if (found == known.end()) {
      ++missing;
      continue;
    }
    EXPECT_NEAR(plant.position.x, found->second.position.x, 1e-3);
    EXPECT_NEAR(plant.position.y, found->second.position.y, 1e-3);
    EXPECT_NEAR(plant.height, found->second.height, 1e-4f * plant.height);
    const glm::dvec2 away = glm::abs(glm::dvec2(plant.position - at.view.eye));
    if (std::max(away.x, away.y) > 0.5 * at.clipmap.rings().melt_begin() - 0.5) continue;
    ++in_finest;
    EXPECT_NEAR(plant.position.z, found->second.position.z, 1e-3);
  }
  EXPECT_LE(double(missing), 0.001 * double(gpu.size()));
  EXPECT_GT(in_finest, 500u);
}

TEST_F(ClipmapSeeding, RulesOfPlacementFollowTheData) {
  Layer layer = meadow(4);
  layer.species[0].altitude_m = {-4.0f, 5.0f};
  layer.species[0].slope = {0.0f, 0.35f};
  Meadow at({}, layer);
  at.look(view_over(at.ground, {12, -31}, 2.5, 40, -15));
  expect_same_as_everywhere(at, 30);
}

TEST_F(ClipmapSeeding, FarFromTheOriginToo) {
  Meadow at({.origin = {1e7, -1e7, 500}}, meadow(4));
  at.look(view_over(at.ground, {12, -31}, 1.7, 40, -15));
  expect_same_as_everywhere(at, 200);
}

TEST_F(ClipmapSeeding, TheSameSeedingEveryTime) {
  Meadow at({}, meadow(2));
  const View view = view_over(at.ground, {12, -31}, 1.7, 40, -15);
  at.look(view);
  const Seeding first = at.seeding;
  at.look(view_over(at.ground, {40, 31}, 1.7, 140, -15));
  at.look(view);
  ASSERT_EQ(first.records.size(), at.seeding.records.size());
  for (size_t i = 0; i < first.records.size(); ++i) {
    ASSERT_EQ(id_of(first.records[i]), id_of(at.seeding.records[i]));
    ASSERT_EQ(first.records[i].submitted, at.seeding.records[i].submitted);
    ASSERT_EQ(first.records[i].apex, at.seeding.records[i].apex);
  }
  const ClipmapSeedingStats stats = at.seeder.stats(true);
  EXPECT_EQ(stats.seeded, first.records.size());
  EXPECT_EQ(stats.clusters, first.clusters);
  EXPECT_GE(stats.fixed_triangles, stats.seeded);
}

TEST_F(ClipmapSeeding, NothingInSightIsNoFault) {
  Meadow at({}, meadow(4));
  View view = view_over(at.ground, {0, 0}, 300, 40, -15);
  at.look(view);
  EXPECT_TRUE(at.seeding.records.empty());
  EXPECT_TRUE(at.gpu().empty());
  view.eye += glm::dvec3(5e5, 0, 0);
  at.look(view);
  EXPECT_TRUE(at.gpu().empty());
}

TEST_F(ClipmapSeeding, TooManyTrianglesAreAnError) {
  const ClipmapGround ground;
  const ColorMap map = patches(*ground.field);
  auto seeder = ClipmapSeeder::create(meadow(0.2f, 5000), *ground.surface, map, gl::ShaderLibrary());
  ASSERT_TRUE(seeder) << seeder.error().message;
  auto clipmap = gl::Clipmap::create(*ground.surface, {64});
  ASSERT_TRUE(clipmap);
  const View view = view_over(ground, {0, 0}, 2, 0, 0);
  clipmap->follow(view);
  const auto seeded = seeder->seed(view, *clipmap);
  ASSERT_FALSE(seeded);
  EXPECT_NE(seeded.error().message.find("horizon"), std::string::npos);
  EXPECT_FALSE(seeder->seeded());
}

}  // namespace
}  // namespace sward
