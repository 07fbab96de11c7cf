// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rules of placement and seasons on the GPU against the CPU twin; many species at once.
#include <sward/terrain/bounds.h>
#include <sward/terrain/roam_mesh.h>

#include <map>
#include <random>

#include "gl/twins.h"

namespace sward {
namespace {

using namespace test;

class Placement : public GlTest {};

const View k_view = eye_level_view({8.0, -15.0, 1.7}, {320, 180});

std::shared_ptr<const GrayMap> random_mask(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  auto mask = std::make_shared<GrayMap>();
  mask->width = width;
  mask->height = height;
  for (int i = 0; i < width * height; ++i) mask->values.push_back(random() % 3 ? uint8_t(random()) : 0);
  return mask;
}

uint8_t grey_at(const GrayMap& mask, glm::dvec3 place) {
  const auto column = std::clamp(int(place.x / k_side * mask.width), 0, mask.width - 1);
  const auto row = std::clamp(int(-place.y / k_side * mask.height), 0, mask.height - 1);
  return mask.values[size_t(row * mask.width + column)];
}

TEST_F(Placement, MasksEqualTheTwinAndForbidToTheTexel) {
  Layer layer = grass_and_soil();
  layer.species.insert(layer.species.begin() + 1, grass_of("straw", {170, 150, 80, 255}));
  layer.mask = random_mask(31, 7, 1);
  layer.species[0].mask = random_mask(64, 64, 2);
  layer.species[1].mask = random_mask(5, 17, 3);
  Patch patch(layer, painted_map(32, [](int column, int row) {
                return (column + row) % 2 ? k_green : glm::u8vec4(170, 150, 80, 255);
              }));
  patch.look(k_view);
  const std::vector<Plant> plants = expect_same_plants(patch, 300);
  for (const Plant& plant : plants) {
    EXPECT_GT(grey_at(*layer.mask, plant.position), 0);
    EXPECT_GT(grey_at(*layer.species[plant.species].mask, plant.position), 0);
  }
}

/// Share of its height that a plant has at a place of the patch, by hand.
double share_at(const Layer& layer, glm::dvec3 place) {
  const GrayMap& map = *layer.height_map;
  const glm::dvec2 tiles = glm::dvec2(place.x, -place.y) / double(layer.height_tile_m);
  const glm::dvec2 texel = glm::fract(tiles) * glm::dvec2(map.width, map.height) - 0.5;
  const glm::ivec2 nw(glm::floor(texel));
  const glm::dvec2 f = texel - glm::dvec2(nw);
  const auto grey = [&](int column, int row) {
    return double(map.values[size_t((row + map.height) % map.height * map.width + (column + map.width) % map.width)]);
  };
  const double value = glm::mix(glm::mix(grey(nw.x, nw.y), grey(nw.x + 1, nw.y), f.x),
                                glm::mix(grey(nw.x, nw.y + 1), grey(nw.x + 1, nw.y + 1), f.x), f.y);
  return layer.height_least + (1 - layer.height_least) * value / 255;
}

TEST_F(Placement, HeightMapsAreTiledAndEqualTheTwin) {
  Layer layer = grass_and_soil();
  Patch without(layer, plain_map(k_side, 32, k_green));
  without.look(k_view);
  layer.height_map = random_mask(7, 5, 4);
  layer.height_tile_m = 3.1f;
  layer.height_least = 0.3f;
  layer.species[0].mask = random_mask(64, 64, 2);  // whose place is another
  Patch patch(layer, plain_map(k_side, 32, k_green));
  patch.look(k_view);
  std::map<std::pair<uint64_t, uint32_t>, float> full;
  for (const Plant& plant : without.plants_of_cpu()) full[{plant.triangle.bits, plant.rank}] = plant.height;
  const std::vector<Plant> plants = expect_same_plants(patch, 300);
  float least = 9, most = 0;
  for (const Plant& plant : plants) {
    const float share = plant.height / full.at({plant.triangle.bits, plant.rank});
    EXPECT_NEAR(share, share_at(layer, plant.position), 1e-3);
    least = std::min(least, share);
    most = std::max(most, share);
  }
  EXPECT_LT(least, 0.35f);
  EXPECT_GT(most, 0.9f);
}

TEST_F(Placement, ShapesComeGoAndMoveAtRunTime) {
  Patch patch(grass_and_soil(), plain_map(k_side, 32, k_green));
  patch.look(k_view);
  const size_t all = expect_same_plants(patch, 1000).size();
  const auto disc = patch.exclusions.add(ExclusionShape::disc({8, -12}, 1.5));
  const auto road = patch.exclusions.add(
      ExclusionShape::polygon({{-1, -9}, {6, -10.2}, {17, -9}, {17, -10.3}, {6.2, -11.4}, {-1, -10.1}}));
  ASSERT_TRUE(disc && road);
  size_t least = all;
  for (int step = 0; step < 4; ++step) {
    patch.look(k_view);
    const std::vector<Plant> plants = expect_same_plants(patch, 300);
    least = std::min(least, plants.size());
    for (const Plant& plant : plants) {
      const glm::dvec2 at(plant.position);
      EXPECT_GT(glm::length(at - patch.exclusions.find(*disc)->centre), 1.5 - 1e-4);
      EXPECT_FALSE(patch.exclusions.find(*road)->contains(at));
    }
    ASSERT_TRUE(patch.exclusions.move(*disc, {0.4, 0.3}));
  }
  EXPECT_LT(least, all - 200);
  patch.exclusions.remove(*disc);
  patch.exclusions.remove(*road);
  patch.look(k_view);
  EXPECT_EQ(expect_same_plants(patch, 1000).size(), all);
}

TEST_F(Placement, PlantsStandUpToTheEdgeOfAShape) {
  // The choice of clusters must not leave a bald fringe: as many plants within 20 cm of the edge as anywhere.
  Layer layer = grass_and_soil();
  layer.density = 400;
  layer.full_distance_m = 14;
  Patch patch(layer, plain_map(k_side, 32, k_green));
  ASSERT_TRUE(patch.exclusions.add(ExclusionShape::polygon({{-1, -12}, {8, -12}, {8, 1}, {-1, 1}})));
  const View above = eye_level_view({8.0, -14.0, 1.7}, {320, 180});
  patch.look(above);
  double fringe = 0, inner = 0;
  for (const Plant& plant : expect_same_plants(patch, 1000)) {
    if (plant.position.y < -11 || plant.position.y > -5) continue;
    const double from_edge = plant.position.x - 8;
    EXPECT_GE(from_edge, -1e-4);
    fringe += from_edge < 0.2;
    inner += from_edge >= 0.2 && from_edge < 1.2;
  }
  EXPECT_GT(inner, 500);
  EXPECT_NEAR(fringe / (inner / 5), 1, 0.3);
}

TEST_F(Placement, SlopeAltitudeAndWaterEqualTheTwin) {
  Layer layer = grass_and_soil();
  layer.species.insert(layer.species.begin() + 1, grass_of("straw", k_green));
  layer.species[0].altitude_m = {100.3f, 101.0f};
  layer.species[0].altitude_soft_m = 0.5f;
  layer.species[1].slope = {0.0f, 0.3f};
  layer.species[1].slope_soft = 0.4f;
  layer.water_level_m = 100.0f;
  layer.species[1].above_water_m = 0.6f;
  Patch patch(layer, plain_map(k_side, 32, k_green));
  FixedTriangles ground = level_ground(k_side, 8, k_view.eye, 14);
  std::mt19937 random(5);
  for (size_t i = 0; i < ground.size(); ++i) {
    FixedTriangle t = ground[i];
    const auto z = [](double x) { return float(100 + x / 8); };
    t.altitude = {z(t.apex.x), z(t.apex.x + double(t.to_left.x)), z(t.apex.x + double(t.to_right.x))};
    t.area *= 1 + 0.001f * float(random() % 200);
    ground.set(i, t);
  }
  patch.look(k_view, ground);
  std::array<size_t, 2> counts{};
  for (const Plant& plant : expect_same_plants(patch, 500)) {
    ++counts[plant.species];
    if (plant.species == 1) {
      EXPECT_GE(plant.position.x, 4.8 - 1e-3);
    }
  }
  EXPECT_GT(counts[0], 100u);
  EXPECT_GT(counts[1], 100u);
}

TEST_F(Placement, ADistributionMapIsReadInTheBaseMapsPlace) {
  Layer layer = grass_and_soil();
  auto distribution = std::make_shared<ColorMap>(plain_map(1, 8, k_brown));
  for (int i = 0; i < 64; ++i)
    if (i % 8 >= 4) distribution->texels[size_t(i)] = k_green;
  layer.distribution = distribution;
  layer.species[0].max_distance = 0.05f;
  Patch patch(layer, plain_map(k_side, 32, {30, 30, 160, 255}));
  patch.look(k_view);
  for (const Plant& plant : expect_same_plants(patch, 300)) EXPECT_GT(plant.position.x, 7);
}

TEST_F(Placement, SixteenSpeciesNeedFourPasses) {
  std::mt19937 random(9);
  Layer layer = grass_and_soil();
  layer.species.clear();
  std::vector<glm::u8vec4> colors;
  for (int i = 0; i < 16; ++i) {
    colors.emplace_back(40 + 60 * (i & 3), 40 + 60 * (i >> 2), i % 2 ? 60 : 180, 255);
    layer.species.push_back(grass_of("grass", colors.back()));
    layer.species.back().name += std::to_string(i);
  }
  Patch patch(layer, painted_map(32, [&](int, int) { return colors[random() % 16]; }));
  patch.look(k_view);
  std::array<size_t, 16> counts{};
  for (const Plant& plant : expect_same_plants(patch, 1000)) ++counts[plant.species];
  for (size_t i = 0; i < counts.size(); ++i) EXPECT_GT(counts[i], 3u) << i;
}

/// Two grasses and soil whose colours, heights and densities go round the year.
Layer seasonal_layer() {
  Layer layer = grass_and_soil();
  layer.species.insert(layer.species.begin() + 1, grass_of("straw", {170, 150, 80, 255}));
  for (size_t i = 0; i < 2; ++i) {
    Species& species = layer.species[i];
    const auto frame = [&](float at, glm::vec3 shift, float height, float density) {
      SeasonFrame f{at, season_values(species, 0)};
      f.values.reference_hsv += shift;
      f.values.height = height;
      f.values.density = density;
      return f;
    };
    const float sign = i == 0 ? 1.0f : -1.0f;
    const std::vector<SeasonFrame> frames{frame(0.1f, {0, 0, 0}, 0.6f, 0.5f), frame(0.4f, {0, 0, 0}, 1, 1),
                                          frame(0.7f, {-0.12f * sign, 0.1f, 0.2f}, 0.8f, 0.7f)};
    species.seasons = frames;
  }
  return layer;
}

using ById = std::map<std::pair<uint64_t, uint32_t>, Plant>;

ById by_id(const std::vector<Plant>& plants) {
  ById found;
  for (const Plant& plant : plants) found[{plant.triangle.bits, plant.rank}] = plant;
  return found;
}

/// Largest change of a drawn height between two times; a plant that is not there has none.
float largest_step(const ById& before, const ById& after) {
  float largest = 0;
  const auto drawn = [](const ById& plants, const auto& id) {
    const auto found = plants.find(id);
    return found == plants.end() ? 0.0f : found->second.height * found->second.fade;
  };
  for (const auto& [id, plant] : before) largest = std::max(largest, std::abs(drawn(after, id) - drawn(before, id)));
  for (const auto& [id, plant] : after) largest = std::max(largest, std::abs(drawn(after, id) - drawn(before, id)));
  return largest;
}

TEST_F(Placement, ASeasonTurnsSmoothlyWithoutSeedingAnew) {
  std::mt19937 random(4);
  Patch patch(seasonal_layer(), painted_map(32, [&](int, int) {
                const glm::u8vec4 colors[] = {k_green, k_brown, {170, 150, 80, 255}, {130, 140, 65, 255}};
                return colors[random() % 4];
              }));
  patch.look(k_view);
  // 24 steps, in each of which what changes its species shrinks and grows once: 48 heights a year; densities and
  // heights go round more slowly.
  constexpr int k_frames = 480;
  const float allowed = 0.45f * (48.0f / k_frames + 12.0f / k_frames);
  ById last, first;
  float largest = 0;
  size_t turned = 0;
  for (int i = 0; i <= k_frames; ++i) {
    patch.set_season(float(i) / k_frames);
    // The GPU now and then, the twin always.
    const ById now = by_id(i % 48 == 7 ? expect_same_plants(patch, 200) : patch.plants_of_cpu());
    if (i > 0) largest = std::max(largest, largest_step(last, now));
    for (const auto& [id, plant] : now) {
      const auto before = last.find(id);
      if (before == last.end()) continue;
      turned += before->second.species != plant.species;
      ASSERT_LE(glm::length(before->second.position - plant.position), 1e-4);
    }
    last = now;
    if (i == 0) first = now;
  }
  EXPECT_LE(largest, allowed);
  EXPECT_GT(turned, 100u);
  EXPECT_EQ(largest_step(first, last), 0.0f);  // the year has come round
}

TEST_F(Placement, ValuesOfTheHostsOwnAreTaken) {
  Patch patch(grass_and_soil(), plain_map(k_side, 32, k_green));
  patch.look(k_view);
  const std::vector<Plant> before = expect_same_plants(patch, 500);
  SeasonValues values = season_values(patch.layer().species[0], 0);
  values.height = 0.5f;
  ASSERT_TRUE(patch.renderer().set_values(0, values));
  patch.classify();
  std::vector<Plant> after = patch.plants_of_gpu();
  sort_plants(after);
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < after.size(); ++i) {
    ASSERT_EQ(plant_key(after[i]), plant_key(before[i]));
    EXPECT_NEAR(after[i].height, 0.5f * before[i].height, 1e-4f);
  }
  values.density = 2;
  const auto refused = patch.renderer().set_values(0, values);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("seasons[0].density is 2"), std::string::npos) << refused.error().message;
  EXPECT_FALSE(patch.renderer().set_values(7, values));
}

TEST_F(Placement, ARegionListsWhatTheGpuDraws) {
  // A height field with relief, its mesh, and the GPU around the eye at full density.
  HeightFieldDesc desc;
  desc.columns = desc.rows = 33;
  desc.spacing = glm::dvec2(1);
  std::vector<float> heights;
  for (int i = 0; i < 33 * 33; ++i) heights.push_back(float(50 + 1.5 * std::sin(0.3 * (i % 33)) + 0.05 * (i / 33)));
  auto field = HeightField::create(desc, heights);
  ASSERT_TRUE(field) << field.error().message;
  const Bounds bounds = Bounds::create(*field);
  const FieldSurface surface(bounds);
  ColorMap map = plain_map(32, 32, k_green);
  map.min_corner = surface.lattice().min_corner();
  std::mt19937 random(2);
  for (glm::u8vec4& texel : map.texels) texel = random() % 3 ? k_green : k_brown;

  Layer layer = grass_and_soil();
  layer.full_distance_m = 40;  // the view is a wide one
  layer.horizon_m = 120;
  layer.species[0].slope = {0, 0.6f};
  layer.species[0].altitude_m = {50, 52};
  layer.species[0].altitude_soft_m = 0.5f;
  Exclusions exclusions;
  ASSERT_TRUE(exclusions.add(ExclusionShape::disc({3, 2}, 1.2)));

  auto mesh = RoamMesh::create(surface, RoamOptions{});
  ASSERT_TRUE(mesh) << mesh.error().message;
  const View view = View::look({0.3, -13.0, 56}, std::numbers::pi / 2, -0.4, 1.2, {320, 240}, 0.05, 1000);
  ASSERT_TRUE(mesh->update(view, 0));
  FixedLevelOptions cut;
  cut.level = level_for_area(surface.lattice(), double(layer.triangle_area_m2));
  cut.horizon_m = layer.horizon_m;
  cut.altitudes = needs_altitudes(layer);
  FixedTriangles triangles;
  mesh->fixed_level_triangles(cut, triangles);
  Seeding seeding;
  seed(layer, view, map, triangles, seeding, &exclusions);

  auto ground = gl::GroundTextures::create(*field, map);
  auto frame = gl::Frame::create();
  auto renderer = VegetationRenderer::create(layer, gl::ShaderLibrary());
  ASSERT_TRUE(ground && frame && renderer);
  frame->upload(view, gl::Lighting(), 0, 1);
  ASSERT_TRUE(renderer->upload(seeding, triangles, view));
  renderer->classify(*frame, *ground, 0);
  auto drawn = renderer->read_back(*frame, *ground, view, seeding, 0);
  ASSERT_TRUE(drawn) << drawn.error().message;

  const PlantRegion region = PlantRegion::disc({0.5, -1}, 5);
  auto listed = query_plants(layer, surface, map, region, {.exclusions = &exclusions});
  ASSERT_TRUE(listed) << listed.error().message;
  std::vector<Plant> inside;
  for (const Plant& plant : *drawn)
    if (region.contains(glm::dvec2(plant.position))) inside.push_back(plant);
  ASSERT_GT(inside.size(), 500u);
  const ById gpu = by_id(inside), cpu = by_id(*listed);
  size_t same = 0;
  for (const auto& [id, plant] : cpu) {
    const auto found = gpu.find(id);
    if (found == gpu.end() || found->second.species != plant.species) continue;
    ++same;
    EXPECT_LE(glm::length(glm::dvec2(found->second.position - plant.position)), 1e-3);
    EXPECT_NEAR(found->second.height, plant.height, 1e-4f);
    EXPECT_NEAR(found->second.azimuth, plant.azimuth, 1e-4f);
    EXPECT_NEAR(plant.position.z, surface.height(glm::dvec2(plant.position)), 1e-9);
  }
  const double most = double(std::max(gpu.size(), cpu.size()));
  EXPECT_GE(double(same), 0.998 * most - 1) << gpu.size() << " drawn, " << cpu.size() << " listed";

  // What is mown is as high as that, and stands where it stood.
  auto disturbance = Disturbance::create();
  ASSERT_TRUE(disturbance && disturbance->cut_capsule({-10, -1}, {10, -1}, 2, 0.05f));
  const auto mown =
      query_plants(layer, surface, map, region, {.exclusions = &exclusions, .disturbance = &*disturbance});
  ASSERT_TRUE(mown);
  ASSERT_EQ(mown->size(), listed->size());
  size_t shorter = 0;
  for (size_t i = 0; i < mown->size(); ++i) {
    const Plant &before = (*listed)[i], &after = (*mown)[i];
    EXPECT_TRUE(before.position == after.position && before.triangle.bits == after.triangle.bits);
    const double away = std::abs(before.position.y + 1);
    if (away < 1.8) { EXPECT_LE(after.height, 0.06f); }
    if (away > 2.2) { EXPECT_EQ(after.height, before.height); }
    shorter += after.height < before.height;
  }
  EXPECT_GT(shorter, 200u);

  const auto too_many = query_plants(layer, surface, map, region, {.most_plants = 10});
  ASSERT_FALSE(too_many);
  EXPECT_NE(too_many.error().message.find("more than 10 plants"), std::string::npos);
  EXPECT_FALSE(query_plants(layer, surface, map, PlantRegion::rectangle({3, 3}, {1, 5})));
}

}  // namespace
}  // namespace sward
