// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "unit/plant_fixtures.h"
#include "vegetation/layer_params.h"

namespace sward {
namespace {

using namespace shared;

constexpr float k_infinity = std::numeric_limits<float>::infinity();

struct KnownColor {
  int r, g, b;
  float hue_degrees, saturation, value;
};

/// Hue, saturation and value as a colour picker shows them.
const KnownColor k_colors[] = {
    {255, 0, 0, 0.0f, 1.0f, 1.0f},
    {0, 255, 0, 120.0f, 1.0f, 1.0f},
    {0, 0, 255, 240.0f, 1.0f, 1.0f},
    {255, 255, 0, 60.0f, 1.0f, 1.0f},
    {0, 255, 255, 180.0f, 1.0f, 1.0f},
    {255, 0, 255, 300.0f, 1.0f, 1.0f},
    {255, 255, 255, 0.0f, 0.0f, 1.0f},
    {0, 0, 0, 0.0f, 0.0f, 0.0f},
    {128, 128, 128, 0.0f, 0.0f, 0.50196f},
    {180, 48, 229, 283.76f, 0.7904f, 0.8980f},
    {25, 203, 151, 162.47f, 0.8768f, 0.7961f},
    {54, 38, 152, 248.42f, 0.75f, 0.5961f},
    {240, 200, 14, 49.38f, 0.9417f, 0.9412f},
    {160, 164, 36, 61.88f, 0.7805f, 0.6431f},
    {255, 0, 1, 359.76f, 1.0f, 1.0f},
};

TEST(Classify, HsvOfKnownColors) {
  for (const KnownColor& c : k_colors) {
    const vec3 hsv = rgb_to_hsv(vec3(float(c.r), float(c.g), float(c.b)) / 255.0f);
    EXPECT_NEAR(hsv.x * 360.0f, c.hue_degrees, 0.01f) << c.r << ' ' << c.g << ' ' << c.b;
    EXPECT_NEAR(hsv.y, c.saturation, 1e-4f);
    EXPECT_NEAR(hsv.z, c.value, 1e-4f);
  }
}

Species species_of(vec3 hsv, vec3 weights, float exponent, float max_distance = k_infinity) {
  Species s;
  s.reference_hsv = hsv;
  s.weights = weights;
  s.exponent = exponent;
  s.max_distance = max_distance;
  return s;
}

float score_of(const Species& s, vec3 hsv) {
  Layer layer;
  layer.species = {s};
  return species_score(make_species_params(layer)[0], hsv);
}

TEST(Classify, ScoreFollowsEquation16) {
  // Differences 0.05, 0.3, -0.4 weighted 2, 1, 0.5: 0.1, 0.3, 0.2; squared length 0.14.
  const Species s = species_of({0.30f, 0.8f, 0.3f}, {2.0f, 1.0f, 0.5f}, 2.0f);
  EXPECT_NEAR(score_of(s, {0.25f, 0.5f, 0.7f}), 1.0f / 0.14f, 1e-3f);
  const Species cubed = species_of({0.30f, 0.8f, 0.3f}, {2.0f, 1.0f, 0.5f}, 3.0f);
  EXPECT_NEAR(score_of(cubed, {0.25f, 0.5f, 0.7f}), 19.0900f, 2e-3f);
}

TEST(Classify, HueWrapsAround) {
  const Species s = species_of({0.97f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}, 1.0f);
  EXPECT_NEAR(score_of(s, {0.02f, 0.5f, 0.5f}), 20.0f, 1e-3f);
  EXPECT_NEAR(score_of(s, {0.92f, 0.5f, 0.5f}), 20.0f, 1e-3f);
  EXPECT_NEAR(score_of(s, {0.47f, 0.5f, 0.5f}), 2.0f, 1e-4f);
}

TEST(Classify, GreyGroundHasNoHue) {
  const Species s = species_of({0.6f, 0.0f, 0.4f}, {1.0f, 0.0f, 1.0f}, 1.0f);
  EXPECT_NEAR(score_of(s, {0.1f, 0.019f, 0.5f}), 10.0f, 1e-3f);
  EXPECT_NEAR(score_of(s, {0.1f, 0.021f, 0.5f}), 1.0f / std::sqrt(0.26f), 1e-3f);
}

TEST(Classify, ExactColorIsFiniteAndPassesAnyThreshold) {
  for (const float max_distance : {1.0e-4f, 0.1f, 1.0e9f, k_infinity}) {
    for (const float exponent : {0.5f, 2.0f, 8.0f}) {
      const Species s = species_of({0.3f, 0.5f, 0.5f}, {1.0f, 1.0f, 1.0f}, exponent, max_distance);
      const float score = score_of(s, {0.3f, 0.5f, 0.5f});
      EXPECT_NEAR(score / std::pow(1.0e4f, exponent), 1.0f, 1e-3f);
      EXPECT_TRUE(std::isfinite(score));
      EXPECT_TRUE(std::isfinite(score + score));
    }
  }
}

TEST(Classify, ThresholdIsTheLargestAcceptedDistance) {
  const Species s = species_of({0.3f, 0.5f, 0.5f}, {0.0f, 0.0f, 1.0f}, 2.0f, 0.2f);
  EXPECT_NEAR(score_of(s, {0.3f, 0.5f, 0.69f}), 27.70f, 0.01f);
  EXPECT_EQ(score_of(s, {0.3f, 0.5f, 0.71f}), 0.0f);
}

TEST(Classify, InfiniteThresholdAcceptsTheFarthestColor) {
  const Species s = species_of({0.5f, 1.0f, 1.0f}, {100.0f, 100.0f, 100.0f}, 8.0f, k_infinity);
  EXPECT_GT(score_of(s, {0.0f, 0.5f, 0.0f}), 0.0f);
}

TEST(Classify, NothingCompetesWhereAllAreBeyondTheirThresholds) {
  Layer layer;
  layer.species = {species_of({0.3f, 0.5f, 0.5f}, {0.0f, 0.0f, 1.0f}, 2.0f, 0.1f),
                   species_of({0.1f, 0.5f, 0.4f}, {0.0f, 0.0f, 1.0f}, 2.0f, 0.1f)};
  const auto params = make_species_params(layer);
  TopTwo t = no_species();
  for (int i = 0; i < 2; ++i) t = insert_score(t, i, species_score(params[i], {0.3f, 0.5f, 0.9f}));
  const Choice c = choose_species(t, 0.5f);
  EXPECT_EQ(c.species, -1);
  EXPECT_FALSE(plant_allowed(t, c, params[0].kind, params[0].kind));
}

TEST(Classify, TopTwoWhateverTheOrder) {
  std::vector<int> order(6);
  std::iota(order.begin(), order.end(), 0);
  const float scores[] = {3.0f, 0.0f, 7.0f, 1.0f, 5.0f, 2.0f};
  do {
    TopTwo t = no_species();
    for (const int i : order) t = insert_score(t, i, scores[i]);
    ASSERT_EQ(t.first, 2);
    ASSERT_EQ(t.second, 4);
    ASSERT_EQ(t.first_score, 7.0f);
    ASSERT_EQ(t.second_score, 5.0f);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Classify, ChoiceFollowsEquation18) {
  TopTwo t = no_species();
  t = insert_score(t, 0, 3.0f);
  t = insert_score(t, 1, 1.0f);
  EXPECT_EQ(choose_species(t, 0.2499f).species, 1);
  EXPECT_FLOAT_EQ(choose_species(t, 0.2499f).score, 0.25f);
  EXPECT_EQ(choose_species(t, 0.25f).species, 0);
  EXPECT_FLOAT_EQ(choose_species(t, 0.25f).score, 0.75f);
  const TopTwo alone = insert_score(no_species(), 4, 2.0f);
  EXPECT_EQ(choose_species(alone, 0.0f).species, 4);
  EXPECT_FLOAT_EQ(choose_species(alone, 0.0f).score, 1.0f);
}

TEST(Classify, SecondSpeciesTakesItsShareOfClusters) {
  // Distances 0.1 and 0.2 with p = 2: scores 100 and 25, share of the second 1/5.
  Layer layer;
  layer.species = {species_of({0.3f, 0.5f, 0.4f}, {0.0f, 0.0f, 1.0f}, 2.0f),
                   species_of({0.1f, 0.5f, 0.7f}, {0.0f, 0.0f, 1.0f}, 2.0f)};
  const auto params = make_species_params(layer);
  TopTwo t = no_species();
  for (int i = 0; i < 2; ++i) t = insert_score(t, i, species_score(params[i], {0.3f, 0.5f, 0.5f}));
  constexpr int k_clusters = 40000;
  int seconds = 0;
  for (uint32_t i = 0; i < k_clusters; ++i) {
    const Cluster c = make_cluster(uvec2(i / 40 << 11, 0x60400000u), i % 40);
    seconds += choose_species(t, c.z).species == 1 ? 1 : 0;
  }
  // Four standard deviations of a binomial of 40 000 at 0.2.
  EXPECT_NEAR(seconds, 0.2 * k_clusters, 4.0 * std::sqrt(0.2 * 0.8 * k_clusters));
}

TEST(Classify, PlantsNeedAGrowingChoiceThatTheBestDoesNotForbid) {
  const vec4 grass(1.0f, 0.0f, 7.0f, 0.0f), soil(0.0f), water(0.0f, 1.0f, 0.0f, 0.0f);
  TopTwo t = insert_score(insert_score(no_species(), 0, 2.0f), 1, 1.0f);
  const Choice first{0, 0.6f}, second{1, 0.4f};
  EXPECT_TRUE(plant_allowed(t, first, grass, grass));
  EXPECT_TRUE(plant_allowed(t, second, soil, grass));
  EXPECT_FALSE(plant_allowed(t, second, grass, soil));
  EXPECT_FALSE(plant_allowed(t, first, soil, soil));
  EXPECT_FALSE(plant_allowed(t, second, water, grass));
  EXPECT_TRUE(plant_allowed(t, first, grass, grass));
  EXPECT_FALSE(plant_allowed(t, Choice{-1, 0.0f}, grass, grass));
}

LayerParams map_params(glm::dvec2 size, ivec2 texels) {
  return make_layer_params(Layer{}, test::view_at({0, 0, 0}), {size, texels}, 0.0f);
}

TEST(Lookup, TexelCentresLieAtAHalf) {
  // 10 x 5 texels over 20 x 10 m; the apex in the middle of texel (3, 2).
  const LayerParams params = map_params({20, 10}, {10, 5});
  MapSample s = locate_texel(params, {3, 2}, {0.5f, 0.5f}, {0.0f, 0.0f});
  EXPECT_EQ(s.texel, ivec2(3, 2));
  EXPECT_EQ(s.fraction, vec2(0.0f, 0.0f));
  EXPECT_TRUE(s.inside);
  // One metre east is half a texel on; one north is half a row up.
  s = locate_texel(params, {3, 2}, {0.5f, 0.5f}, {1.0f, 1.0f});
  EXPECT_EQ(s.texel, ivec2(3, 1));
  EXPECT_EQ(s.fraction, vec2(0.5f, 0.5f));
  s = locate_texel(params, {0, 0}, {0.25f, 0.25f}, {0.0f, 0.0f});
  EXPECT_EQ(s.texel, ivec2(-1, -1));
  EXPECT_EQ(s.fraction, vec2(0.75f, 0.75f));
  EXPECT_EQ(clamp_texel(params, s.texel), ivec2(0, 0));
  EXPECT_EQ(clamp_texel(params, {10, 5}), ivec2(9, 4));
}

TEST(Lookup, KnowsWhatIsOnTheMap) {
  const LayerParams params = map_params({20, 10}, {10, 5});
  EXPECT_TRUE(locate_texel(params, {0, 0}, {0.0f, 0.0f}, {0.0f, 0.0f}).inside);
  EXPECT_TRUE(locate_texel(params, {9, 4}, {0.99f, 0.99f}, {0.0f, 0.0f}).inside);
  EXPECT_FALSE(locate_texel(params, {0, 0}, {0.5f, 0.5f}, {-1.1f, 0.0f}).inside);
  EXPECT_FALSE(locate_texel(params, {0, 0}, {0.5f, 0.5f}, {0.0f, 1.1f}).inside);
  EXPECT_FALSE(locate_texel(params, {9, 0}, {0.5f, 0.5f}, {1.1f, 0.0f}).inside);
  EXPECT_FALSE(locate_texel(params, {0, 4}, {0.5f, 0.5f}, {0.0f, -1.1f}).inside);
  EXPECT_FALSE(locate_texel(params, {1000000000, 0}, {0.0f, 0.0f}, {0.0f, 0.0f}).inside);
}

TEST(Lookup, BlendsFourTexels) {
  const vec4 nw(0.0f), ne(1.0f, 0.0f, 0.0f, 1.0f), sw(0.0f, 1.0f, 0.0f, 1.0f), se(1.0f);
  EXPECT_EQ(blend_texels(nw, ne, sw, se, {0.0f, 0.0f}), nw);
  const vec4 result = blend_texels(nw, ne, sw, se, {0.25f, 0.5f});
  EXPECT_EQ(result, vec4(0.25f, 0.5f, 0.125f, 0.625f));
}

TEST(Lookup, HalfTransparentGroundForbids) {
  MapSample s;
  s.inside = true;
  EXPECT_TRUE(ground_is_open(s, {0, 0, 0, 0.5f}));
  EXPECT_FALSE(ground_is_open(s, {0, 0, 0, 0.499f}));
  s.inside = false;
  EXPECT_FALSE(ground_is_open(s, {0, 0, 0, 1.0f}));
}

TEST(LayerParameters, ZoomScalesDistances) {
  Layer layer;
  layer.full_distance_m = 4.0f;
  layer.horizon_m = 80.0f;
  layer.full_segments_m = 7.0f;
  layer.shadow_distance_m = 50.0f;
  const LayerParams p = make_layer_params(layer, test::view_at({0, 0, 0}, 2.0), {{10, 10}, {5, 20}}, 1.5f);
  EXPECT_NEAR(p.law.z, 8.0f, 1e-5f);
  EXPECT_NEAR(p.reach.x, 160.0f, 1e-4f);
  EXPECT_NEAR(p.detail.x, 14.0f, 1e-5f);
  EXPECT_NEAR(p.detail.y, 100.0f, 1e-4f);
  EXPECT_EQ(p.detail.w, 1.5f);
  EXPECT_FLOAT_EQ(p.map.x, 0.5f);
  EXPECT_FLOAT_EQ(p.map.y, -2.0f);
}

}  // namespace
}  // namespace sward
