// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "roam_driver.h"

namespace {

TEST(RoamFuzz, SeededBytesLeaveAValidMesh) {
  roam_support::Random random(2026);
  for (int i = 0; i < 200; ++i) {
    std::vector<uint8_t> bytes(20 + random.below(400));
    for (uint8_t& byte : bytes) byte = uint8_t(random.below(256));
    ASSERT_EQ(roam_driver::run(bytes), "") << "input " << i;
  }
}

// Long runs of splits alone, then of merges alone: chains of forced splits and back to the roots.
TEST(RoamFuzz, SplitsAndMergesToTheEnd) {
  roam_support::Random random(5);
  for (int kind = 0; kind < 5; ++kind) {
    std::vector<uint8_t> bytes{uint8_t(kind)};
    for (int i = 0; i < 150; ++i) bytes.insert(bytes.end(), {3, uint8_t(random.below(256)), uint8_t(random.below(8))});
    for (int i = 0; i < 600; ++i) bytes.insert(bytes.end(), {6, uint8_t(random.below(256)), uint8_t(random.below(8))});
    ASSERT_EQ(roam_driver::run(bytes), "") << "kind " << kind;
  }
}

}  // namespace
