// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Images on plants: what is refused, what is generated, how levels keep coverage and mean.
#include <gtest/gtest.h>
#include <sward/vegetation/plant_image.h>

#include <cmath>
#include <numeric>

#include "vegetation/plant_image_array.h"

namespace sward {
namespace {

TEST(PlantImage, SidesArePowersOfTwo) {
  const std::vector<uint8_t> greys(4096 * 4096);
  for (const auto& [width, height] : {std::pair{100, 64}, {64, 100}, {4, 64}, {64, 4096}, {0, 64}, {-64, 64}}) {
    const auto image = PlantImage::create(width, height, std::span(greys).first(64));
    ASSERT_FALSE(image) << width << " x " << height;
    EXPECT_NE(image.error().message.find("powers of two from 8 to 2048"), std::string::npos) << image.error().message;
  }
  const auto short_of = PlantImage::create(8, 16, std::span(greys).first(127));
  ASSERT_FALSE(short_of);
  EXPECT_NE(short_of.error().message.find("127"), std::string::npos);
  EXPECT_TRUE(PlantImage::create(8, 16, std::span(greys).first(128)));
}

double mean(std::span<const uint8_t> greys) {
  return std::accumulate(greys.begin(), greys.end(), 0.0) / double(greys.size());
}

TEST(PlantImage, BuiltInDetailsAreSeamlessAndHalfGrey) {
  EXPECT_EQ(built_in_detail("no such"), nullptr);
  for (const std::string_view name : built_in_details()) {
    const auto image = built_in_detail(name);
    ASSERT_NE(image, nullptr) << name;
    EXPECT_EQ(image, built_in_detail(name));
    EXPECT_NEAR(mean(image->greys()), 127.5, 2.0) << name;
    // From the last row to the first as smoothly as anywhere.
    const int side = image->width();
    const auto step = [&](int row) {
      double sum = 0;
      for (int x = 0; x < side; ++x)
        sum += std::abs(int(image->greys()[size_t(row * side + x)]) -
                        int(image->greys()[size_t((row + 1) % side * side + x)]));
      return sum / side;
    };
    double most = 0, contrast = 0;
    for (int row = 0; row + 1 < side; ++row) most = std::max(most, step(row));
    for (const uint8_t grey : image->greys()) contrast += std::abs(grey - 127.5);
    EXPECT_LE(step(side - 1), most) << name;
    EXPECT_GT(contrast / double(image->greys().size()), 12.0) << name;
  }
}

TEST(PlantImage, LevelsOfCutoutsKeepTheirCoverage) {
  // Thin spokes, which plain averages lose.
  std::vector<uint8_t> greys;
  for (int i = 0; i < 512 * 512; ++i) greys.push_back(i % 512 % 64 < 12 ? 255 : 0);
  const auto image = PlantImage::create(512, 512, greys);
  ASSERT_TRUE(image);
  const auto share = [](const std::vector<uint8_t>& level) {
    return double(std::count_if(level.begin(), level.end(), [](uint8_t v) { return v >= 128; })) / double(level.size());
  };
  const auto levels = plant_image_levels(**image, true), plain = plant_image_levels(**image, false);
  ASSERT_EQ(levels.size(), 9u);
  EXPECT_EQ(levels.back().size(), 1u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(levels[i].size(), size_t(256 >> i) * size_t(256 >> i));
    EXPECT_NEAR(share(levels[i]), 12.0 / 64, 0.07) << i;
    EXPECT_NEAR(mean(plain[i]), 255.0 * 12 / 64, 1.5) << i;
  }
}

TEST(PlantImage, SmallerImagesAreEnlarged) {
  std::vector<uint8_t> greys(8 * 16, 200);
  const auto image = PlantImage::create(8, 16, greys);
  ASSERT_TRUE(image);
  const auto levels = plant_image_levels(**image, false);
  EXPECT_EQ(levels[0].size(), 256u * 256u);
  EXPECT_NEAR(mean(levels[0]), 200, 0.01);
}

}  // namespace
}  // namespace sward
