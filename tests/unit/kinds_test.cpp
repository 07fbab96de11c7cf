// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What kinds of plants draw from a seed's own numbers, in their shares.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "unit/plant_fixtures.h"
#include "vegetation/layer_params.h"

namespace sward {
namespace {

using namespace test;

constexpr int k_plants = 40000;

/// The states of the sequences of plants of many triangles.
template <class Visit>
void each_state(const shared::SpeciesParams& species, Visit visit) {
  std::mt19937_64 random(5);
  const shared::LayerParams layer{};
  for (int i = 0; i < k_plants; ++i) {
    const uint64_t id = random();
    const glm::uvec2 words{uint32_t(id), uint32_t(id >> 32)};
    visit(shared::make_traits(species, layer, words, uint32_t(i % 16), 1.0f).state);
  }
}

shared::SpeciesParams params_of(const Species& species) {
  Layer layer;
  layer.species = {species};
  return make_species_params(layer)[0];
}

/// 99.9 % of a binomial distribution.
double limit(double share) {
  return 3.29 * std::sqrt(share * (1 - share) / k_plants);
}

TEST(Kinds, PetalColoursInTheirShares) {
  for (const std::vector<float>& shares :
       {std::vector<float>{}, {1, 1, 1, 1}, {5, 3, 2, 1}, {0, 1, 0, 3}, {1, 0, 0, 0}, {7, 0.5f, 0.25f, 0}}) {
    Species species;
    species.kind = PlantKind::flower;
    species.flower.petal_colors.assign(4, glm::vec3(0.5f));
    species.flower.petal_shares = shares;
    const shared::SpeciesParams params = params_of(species);
    std::array<int, 4> counts{};
    each_state(params, [&](uint32_t state) { ++counts[size_t(shared::petal_choice(params, state))]; });
    float total = 0;
    for (const float share : shares) total += share;
    for (size_t i = 0; i < 4; ++i) {
      const double expected = shares.empty() ? 0.25 : double(shares[i] / total);
      EXPECT_NEAR(double(counts[i]) / k_plants, expected, limit(expected)) << i << " of " << shares.size();
      if (expected == 0) {
        EXPECT_EQ(counts[i], 0);
      }
    }
  }
}

TEST(Kinds, FewerColoursLeaveNoRest) {
  Species species;
  species.kind = PlantKind::flower;
  species.flower.petal_colors.assign(3, glm::vec3(0.5f));
  const shared::SpeciesParams params = params_of(species);
  each_state(params, [&](uint32_t state) { ASSERT_LT(shared::petal_choice(params, state), 3); });
}

TEST(Kinds, EachNumberOfBladesAsOften) {
  Species species;
  species.kind = PlantKind::tuft;
  species.tuft.blades = {3, 9};
  const shared::SpeciesParams params = params_of(species);
  std::array<int, 7> counts{};
  each_state(params, [&](uint32_t state) {
    const float blades = shared::tuft_blades(params, state);
    ASSERT_TRUE(blades >= 3 && blades <= 9 && blades == std::floor(blades)) << blades;
    ++counts[size_t(blades - 3)];
  });
  EXPECT_LT(chi_square(counts), chi_square_limit(6, 3.29));
}

TEST(Kinds, HeadsSpanTheirRange) {
  Species species;
  species.kind = PlantKind::flower;
  species.flower.head_m = {0.02f, 0.06f};
  const shared::SpeciesParams params = params_of(species);
  std::array<int, 8> counts{};
  each_state(params, [&](uint32_t state) {
    const float diameter = shared::head_diameter(params, state);
    ASSERT_TRUE(diameter >= 0.02f && diameter < 0.06f) << diameter;
    ++counts[std::min(size_t((diameter - 0.02f) / 0.005f), size_t(7))];
  });
  EXPECT_LT(chi_square(counts), chi_square_limit(7, 3.29));
}

TEST(Kinds, ColoursArePackedExactly) {
  Species species;
  species.kind = PlantKind::flower;
  species.flower.petal_colors = {{1, 1, 1}, {0, 0, 0}, glm::vec3(18, 52, 86) / 255.0f};
  species.flower.centre_color = {1, 0, 0};
  const shared::SpeciesParams params = params_of(species);
  EXPECT_EQ(params.own_a.x, 16777215.0f);
  EXPECT_EQ(params.own_a.y, 0.0f);
  EXPECT_EQ(params.own_a.z, float(0x123456));
  EXPECT_EQ(params.own_d.x, float(0xff0000));
  EXPECT_EQ(params.own_d.y, -1.0f);
  species.flower.own_stem = true;
  species.flower.stem_color = {0, 1, 0};
  EXPECT_EQ(params_of(species).own_d.y, float(0x00ff00));
}

TEST(Kinds, AHostsParametersAreInTheirOrder) {
  Species species;
  species.kind = PlantKind::custom;
  for (int i = 1; i <= 14; ++i) species.custom.parameters.push_back(float(i));
  const shared::SpeciesParams params = params_of(species);
  EXPECT_EQ(params.own_a, glm::vec4(1, 2, 3, 4));
  EXPECT_EQ(params.own_b, glm::vec4(5, 6, 7, 8));
  EXPECT_EQ(params.own_c, glm::vec4(9, 10, 11, 12));
  EXPECT_EQ(params.own_d, glm::vec4(13, 14, 0, 0));
}

}  // namespace
}  // namespace sward
