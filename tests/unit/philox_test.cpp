// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <set>

#include "unit/plant_fixtures.h"
#include "vegetation/shared_glsl.h"

namespace sward {
namespace {

using shared::philox2x32;
using shared::uvec2;

struct KnownAnswer {
  int rounds;
  uvec2 counter;
  uint32_t key;
  uvec2 answer;
};

/// As published with Random123 (Salmon, Moraes, Dror, Shaw 2011), kat_vectors.
const KnownAnswer k_known[] = {
    {7, {0x00000000, 0x00000000}, 0x00000000, {0x257a3673, 0xcd26be2a}},
    {7, {0xffffffff, 0xffffffff}, 0xffffffff, {0xab302c4d, 0x3dc9d239}},
    {7, {0x243f6a88, 0x85a308d3}, 0x13198a2e, {0xbedbbe6b, 0xe4c770b3}},
    {10, {0x00000000, 0x00000000}, 0x00000000, {0xff1dae59, 0x6cd10df2}},
    {10, {0xffffffff, 0xffffffff}, 0xffffffff, {0x2c3f628b, 0xab4fd7ad}},
    {10, {0x243f6a88, 0x85a308d3}, 0x13198a2e, {0xdd7ce038, 0xf62a4c12}},
};

TEST(Philox, GivesThePublishedAnswers) {
  for (const KnownAnswer& known : k_known) {
    const uvec2 result = philox2x32(known.counter, known.key, known.rounds);
    EXPECT_EQ(result.x, known.answer.x) << known.rounds << " rounds, key " << known.key;
    EXPECT_EQ(result.y, known.answer.y) << known.rounds << " rounds, key " << known.key;
  }
}

TEST(Philox, RandomPairTakesIndexAndHighWordAsCounterAndLowWordAsKey) {
  const uvec2 pair = shared::random_pair(0x243f6a88, uvec2(0x13198a2e, 0x85a308d3));
  EXPECT_EQ(pair.x, 0xbedbbe6bu);
  EXPECT_EQ(pair.y, 0xe4c770b3u);
}

/// Shares of triangles whose seeds' 8 x 8 cells of the unit square exceed the 99.9 % point of chi-square.
double share_beyond(int rounds) {
  constexpr int k_level = 24, k_triangles = 4096, k_seeds = 1024;
  const double limit = test::chi_square_limit(63, 3.0902);
  int beyond = 0;
  for (int t = 0; t < k_triangles; ++t) {
    // Neighbouring triangles of several root squares: root, column, row, then the last turns of level 24.
    const uint64_t id = (uint64_t(k_level) << 58) | (uint64_t(t & 1) << 57) | (uint64_t(1024 + (t >> 3 & 3)) << 46) |
                        (uint64_t(1024 + (t >> 1 & 3)) << 35) | (uint64_t(t >> 1) << (35 - k_level));
    std::array<int, 64> cells{};
    for (uint32_t seed = 0; seed < k_seeds; ++seed) {
      const uvec2 pair = philox2x32(uvec2(seed, uint32_t(id >> 32)), uint32_t(id), rounds);
      ++cells[(pair.x >> 29) * 8 + (pair.y >> 29)];
    }
    beyond += test::chi_square(cells) > limit ? 1 : 0;
  }
  return double(beyond) / k_triangles;
}

TEST(Philox, SevenRoundsFillTrianglesEvenlyAndThreeDoNot) {
  // One in a thousand is expected beyond; 4096 triangles stay below three in a thousand with 99.99 % confidence.
  EXPECT_LT(share_beyond(7), 0.003);
  EXPECT_LT(share_beyond(10), 0.003);
  EXPECT_GT(share_beyond(3), 0.006);
}

TEST(Philox, UniformsLieBelowOneAndUseTwentyFourBits) {
  EXPECT_EQ(shared::uniform_float(0), 0.0f);
  EXPECT_EQ(shared::uniform_float(0xff), 0.0f);
  EXPECT_EQ(shared::uniform_float(0x80000000), 0.5f);
  EXPECT_EQ(shared::uniform_float(0xffffffff), 16777215.0f / 16777216.0f);
}

TEST(Philox, SequenceIsTheLinearCongruentialOne) {
  // Numerical Recipes' "quick and dirty" generator from 0: the first values printed there.
  const uint32_t expected[] = {0x3c6ef35f, 0x47502932, 0xd1ccf6e9, 0xaaf95334, 0x6252e503};
  uint32_t state = 0;
  for (const uint32_t value : expected) {
    state = shared::lcg_next(state);
    EXPECT_EQ(state, value);
  }
}

TEST(Philox, IndexSpacesOfSeedsAndClustersNeverMeet) {
  std::set<uint32_t> indices{shared::k_triangle_index};
  for (uint32_t i : {0u, 1u, 7u, 8u, 4095u, (1u << 24) - 1}) {
    EXPECT_TRUE(indices.insert(i).second);
    EXPECT_TRUE(indices.insert(i | shared::k_sequence_space).second);
    EXPECT_TRUE(indices.insert(i | shared::k_cluster_space).second);
    EXPECT_TRUE(indices.insert(i | shared::k_cluster_space | shared::k_sequence_space).second);
  }
}

}  // namespace
}  // namespace sward
