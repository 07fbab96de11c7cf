// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// SWARD_FUZZ_INPUTS: how many random inputs, default 120 (some 8 000 steps).
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "roam_driver.h"

namespace {

TEST(RoamFuzz, SeededBytesLeaveAValidMesh) {
  const char* wanted = std::getenv("SWARD_FUZZ_INPUTS");
  const int inputs = wanted != nullptr ? std::atoi(wanted) : 120;
  roam_support::Random random(2026);
  uint64_t steps = 0;
  for (int i = 0; i < inputs; ++i) {
    std::vector<uint8_t> bytes(20 + random.below(700));
    for (uint8_t& byte : bytes) byte = uint8_t(random.below(256));
    ASSERT_EQ(roam_driver::run(bytes, steps), "") << "input " << i;
  }
  std::printf("%d inputs, %llu steps\n", inputs, (unsigned long long)steps);
}

// Long runs of splits alone, then of merges alone: chains of forced splits and back to the roots.
TEST(RoamFuzz, SplitsAndMergesToTheEnd) {
  roam_support::Random random(5);
  for (int kind = 0; kind < 5; ++kind) {
    std::vector<uint8_t> bytes{uint8_t(kind)};
    for (int i = 0; i < 150; ++i) bytes.insert(bytes.end(), {3, uint8_t(random.below(256)), uint8_t(random.below(8))});
    for (int i = 0; i < 600; ++i) bytes.insert(bytes.end(), {6, uint8_t(random.below(256)), uint8_t(random.below(8))});
    uint64_t steps = 0;
    ASSERT_EQ(roam_driver::run(bytes, steps), "") << "kind " << kind;
    EXPECT_EQ(steps, 750u);
  }
}

}  // namespace
