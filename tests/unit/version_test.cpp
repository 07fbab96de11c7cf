// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <sward/version.h>

namespace sward {
namespace {

TEST(Version, HostsCompareHeadersAndLibrary) {
  EXPECT_EQ(library_version(), k_header_version);
  EXPECT_TRUE(headers_match({0, 1, 0}, {0, 1, 4}));
  EXPECT_FALSE(headers_match({0, 1, 4}, {0, 1, 0}));
  EXPECT_FALSE(headers_match({0, 1, 0}, {0, 2, 0}));
  EXPECT_TRUE(headers_match({1, 1, 7}, {1, 2, 0}));
  EXPECT_FALSE(headers_match({1, 2, 0}, {1, 1, 7}));
  EXPECT_FALSE(headers_match({1, 2, 0}, {2, 2, 0}));
}

}  // namespace
}  // namespace sward
