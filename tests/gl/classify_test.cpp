// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Classification and growth on the GPU against their CPU twin (CONTRACT: CPU and GPU twins).
#include <algorithm>
#include <random>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class Classify : public GlTest {};

/// Share of plants whose species or presence may differ between the twins.
constexpr double k_allowed_share = 0.001;

struct Comparison {
  size_t matched = 0, unmatched = 0;
};

auto key_of(const Plant& p) {
  return std::tuple(p.triangle.bits, p.rank, p.species);
}

void expect_same_plant(const Plant& gpu, const Plant& cpu) {
  EXPECT_LE(glm::length(gpu.position - cpu.position), 1e-3);
  EXPECT_NEAR(gpu.height, cpu.height, 1e-4 * cpu.height);
  EXPECT_NEAR(gpu.width, cpu.width, 1e-4 * cpu.width);
  EXPECT_NEAR(gpu.stiffness, cpu.stiffness, 1e-4);
  EXPECT_NEAR(gpu.azimuth, cpu.azimuth, 1e-4);
  EXPECT_NEAR(gpu.score, cpu.score, 1e-4);
  EXPECT_NEAR(gpu.fade, cpu.fade, 1e-3);
}

Comparison compare(std::vector<Plant> gpu, std::vector<Plant> cpu) {
  const auto before = [](const Plant& a, const Plant& b) { return key_of(a) < key_of(b); };
  std::sort(gpu.begin(), gpu.end(), before);
  std::sort(cpu.begin(), cpu.end(), before);
  Comparison result;
  for (size_t i = 0, j = 0; i < gpu.size() || j < cpu.size();) {
    if (i < gpu.size() && j < cpu.size() && key_of(gpu[i]) == key_of(cpu[j])) {
      expect_same_plant(gpu[i++], cpu[j++]);
      ++result.matched;
      continue;
    }
    ++result.unmatched;
    const bool gpu_first = j == cpu.size() || (i < gpu.size() && before(gpu[i], cpu[j]));
    gpu_first ? ++i : ++j;
  }
  return result;
}

/// Looks, classifies, reads back and compares; returns the plants of the GPU.
std::vector<Plant> expect_twins(Patch& patch, const View& view, size_t at_least) {
  patch.look(view);
  patch.classify();
  std::vector<Plant> gpu = patch.plants_of_gpu();
  const Comparison result = compare(gpu, patch.plants_of_cpu());
  EXPECT_GE(result.matched, at_least);
  EXPECT_LE(double(result.unmatched), k_allowed_share * double(result.matched + result.unmatched) + 0.5);
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
  return gpu;
}

/// Colours that vary from texel to texel, the seed fixed.
ColorMap mottled_map(int texels, std::vector<glm::u8vec4> palette) {
  std::mt19937 random(7);
  return painted_map(texels, [&](int, int) {
    glm::u8vec4 color = palette[random() % palette.size()];
    for (int i = 0; i < 3; ++i) color[i] = uint8_t(std::clamp(int(color[i]) + int(random() % 21) - 10, 0, 255));
    return color;
  });
}

const View k_view = eye_level_view({8.0, -15.0, 1.7}, {320, 180});

TEST_F(Classify, GrassAndSoilEqualTheTwin) {
  Patch patch(grass_and_soil(), mottled_map(32, {k_green, k_brown}));
  const std::vector<Plant> plants = expect_twins(patch, k_view, 500);
  for (const Plant& plant : plants) EXPECT_EQ(plant.species, 0u);
}

TEST_F(Classify, EveryLawEqualsTheTwin) {
  for (const DensityLaw law : {DensityLaw::distance, DensityLaw::screen_area, DensityLaw::world_area}) {
    for (const bool plain : {false, true}) {
      SCOPED_TRACE(testing::Message() << "law " << int(law) << " plain " << plain);
      Layer layer = grass_and_soil();
      layer.law = law;
      layer.plain = plain;
      if (law != DensityLaw::distance) layer.density = 3000;
      layer.ceiling = 100;
      Patch patch(layer, mottled_map(32, {k_green, k_brown}));
      expect_twins(patch, k_view, 500);
    }
  }
}

TEST_F(Classify, SixSpeciesNeedTwoPasses) {
  const std::vector<glm::u8vec4> colors{{200, 60, 60, 255},  {60, 200, 60, 255},  {60, 60, 200, 255},
                                        {200, 200, 60, 255}, {60, 200, 200, 255}, {200, 60, 200, 255}};
  Layer layer = grass_and_soil();
  layer.species.clear();
  layer.species.push_back(bare_of("grey", {128, 128, 128, 255}));
  for (const glm::u8vec4 color : colors) layer.species.push_back(grass_of("grass", color));
  Patch patch(layer, mottled_map(32, colors));
  const std::vector<Plant> plants = expect_twins(patch, k_view, 500);
  std::array<size_t, 7> counts{};
  for (const Plant& plant : plants) ++counts[plant.species];
  EXPECT_EQ(counts[0], 0u);
  for (size_t species = 1; species < counts.size(); ++species) EXPECT_GT(counts[species], 20u) << species;
}

TEST_F(Classify, OtherClusterSizesEqualTheTwin) {
  for (const int size : {1, 3, 32}) {
    SCOPED_TRACE(size);
    Layer layer = grass_and_soil();
    layer.cluster_size = size;
    Patch patch(layer, mottled_map(32, {k_green, k_brown}));
    expect_twins(patch, k_view, 300);
  }
}

TEST_F(Classify, PhototropicPlantsTurnToTheSun) {
  Layer layer = grass_and_soil();
  layer.species[0].phototropism = 0.9f;
  Patch patch(layer, mottled_map(32, {k_green}));
  patch.lighting.sun_azimuth = 1.1f;
  for (const Plant& plant : expect_twins(patch, k_view, 500)) EXPECT_NEAR(plant.azimuth, 1.1f, 0.1f * 3.15f);
}

/// Two splits below every triangle: a bump of `height` in the middle of its base, its children split again.
FixedTriangles bumpy_ground(const View& view, double reach, float height) {
  FixedTriangles ground = level_ground(k_side, 8, view.eye, reach);
  ground.set_surface_z(40.0);
  for (size_t i = 0; i < ground.size(); ++i) {
    FixedTriangle t = ground[i];
    const auto next = uint32_t(ground.nodes().size());
    t.surface = ground.add_node({float(height - 40.0), {next + 1, next + 2}, 0});
    ground.add_node({float(0.5 * height - 40.0), {0, 0}, 0});
    ground.add_node({float(0.8 * height - 40.0), {0, 0}, 0});
    ground.set(i, t);
  }
  return ground;
}

TEST_F(Classify, PlantsStandOnTheRefinedSurface) {
  Patch patch(grass_and_soil(), mottled_map(32, {k_green}));
  patch.look(k_view, bumpy_ground(k_view, 14, 0.3f));
  patch.classify();
  const std::vector<Plant> gpu = patch.plants_of_gpu();
  const Comparison result = compare(gpu, patch.plants_of_cpu());
  EXPECT_GE(result.matched, 500u);
  EXPECT_EQ(result.unmatched, 0u);
  double highest = 0;
  for (const Plant& plant : gpu) highest = std::max(highest, plant.position.z);
  EXPECT_GT(highest, 0.2);
  EXPECT_LE(highest, 0.3 + 1e-4);
}

TEST_F(Classify, NothingGrowsOnBareForbiddenOrMaskedGround) {
  const glm::u8vec4 water{40, 60, 140, 255}, masked{90, 130, 50, 0};
  for (const glm::u8vec4 color : {k_brown, water, masked}) {
    Layer layer = grass_and_soil();
    layer.species.push_back(bare_of("water", water));
    layer.species.back().forbids = true;
    Patch patch(layer, plain_map(k_side, 16, color));
    patch.look(k_view);
    patch.classify();
    EXPECT_TRUE(patch.plants_of_gpu().empty());
    EXPECT_EQ(patch.renderer().stats(true).clusters_fertile, 0u);
  }
}

TEST_F(Classify, NoPlantCrossesTheShore) {
  // Water in the western half: texels are a metre, so colours blend over one metre around x = 8.
  const glm::u8vec4 water{40, 60, 140, 255};
  Layer layer = grass_and_soil();
  layer.species[1] = bare_of("water", water);
  layer.species[1].forbids = true;
  Patch patch(layer, painted_map(16, [&](int column, int) { return column < 8 ? water : k_green; }));
  const std::vector<Plant> plants = expect_twins(patch, k_view, 300);
  double westernmost = k_side;
  for (const Plant& plant : plants) westernmost = std::min(westernmost, plant.position.x);
  EXPECT_GT(westernmost, 7.5);
  EXPECT_LT(westernmost, 8.6);
}

TEST_F(Classify, FarFromTheOriginThePlantsAreTheSame) {
  Patch patch(grass_and_soil(), mottled_map(32, {k_green}));
  const std::vector<Plant> near = expect_twins(patch, k_view, 500);
  View moved = k_view;
  moved.eye += glm::dvec3(0.5, 0.25, 0);
  const std::vector<Plant> again = expect_twins(patch, moved, 500);
  size_t shared = 0;
  for (const Plant& a : near) {
    const auto b = std::find_if(again.begin(), again.end(), [&](const Plant& p) { return key_of(p) == key_of(a); });
    if (b == again.end()) continue;
    ++shared;
    EXPECT_LE(glm::length(a.position - b->position), 1e-4);
    EXPECT_EQ(a.height, b->height);
    EXPECT_EQ(a.azimuth, b->azimuth);
  }
  EXPECT_GT(shared, 300u);
}

TEST_F(Classify, CountsAreTheTwins) {
  Patch patch(grass_and_soil(), plain_map(k_side, 8, k_green));
  patch.look(k_view);
  patch.classify();
  const VegetationStats stats = patch.renderer().stats(true);
  uint32_t clusters = 0;
  for (const TriangleRecord& record : patch.seeding().records) clusters += (record.submitted + 7) / 8;
  EXPECT_EQ(stats.clusters_submitted, patch.seeding().clusters);
  EXPECT_EQ(stats.clusters_fertile, clusters);  // all green
  EXPECT_FALSE(stats.overflow);
  EXPECT_EQ(stats.primitives, 0u);  // nothing drawn yet
}

TEST_F(Classify, AnEmptyFrameIsFine) {
  Patch patch(grass_and_soil(), mottled_map(16, {k_green}));
  auto target = host::RenderTarget::create({8, 8}, 1);
  ASSERT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(k_view, FixedTriangles{});
  patch.classify(target->framebuffer());
  patch.draw();
  EXPECT_TRUE(patch.plants_of_gpu().empty());
  EXPECT_EQ(patch.renderer().stats(true).primitives, 0u);
  expect_twins(patch, k_view, 500);
}

TEST_F(Classify, ReadingBackNeedsAClassification) {
  Patch patch(grass_and_soil(), mottled_map(16, {k_green}));
  patch.look(k_view);
  const auto plants = patch.renderer().read_back(patch.frame(), patch.ground(), k_view, patch.seeding(), 0);
  ASSERT_FALSE(plants);
  EXPECT_NE(plants.error().message.find("classified"), std::string::npos);
}

}  // namespace
}  // namespace sward
