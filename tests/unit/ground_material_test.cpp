// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Detail textures and the shares of materials by the ground's colour (equation 17).
#include <gtest/gtest.h>
#include <sward/terrain/ground_material.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sward {
namespace {

GroundMaterial of_color(const char* name, glm::vec3 hsv) {
  GroundMaterial m;
  m.name = name;
  m.reference_hsv = hsv;
  return m;
}

/// Equation 16 as the paper has it, with a hue that wraps.
double score(glm::vec3 reference, glm::vec3 weights, double exponent, glm::vec3 hsv) {
  double hue = std::abs(double(reference.x) - double(hsv.x));
  hue = std::min(hue, 1 - hue);
  const glm::dvec3 d = glm::dvec3(hue, reference.y - hsv.y, reference.z - hsv.z) * glm::dvec3(weights);
  return std::pow(glm::length(d), -exponent);
}

TEST(GroundMaterials, SharesAreEquation17) {
  std::vector<GroundMaterial> materials{of_color("a", {0.25f, 0.5f, 0.4f}), of_color("b", {0.1f, 0.4f, 0.5f}),
                                        of_color("c", {0.9f, 0.3f, 0.6f})};
  for (GroundMaterial& m : materials) m.max_distance = 10;
  const glm::vec3 srgb(0.42f, 0.40f, 0.22f);  // hue 54 degrees
  const glm::vec3 hsv(54.0f / 360, 1 - 0.22f / 0.42f, 0.42f);
  std::vector<float> shares(3);
  material_shares(materials, srgb, shares);
  double sum = 0;
  std::vector<double> expected;
  for (const GroundMaterial& m : materials) {
    expected.push_back(score(*m.reference_hsv, m.weights, m.exponent, hsv));
    sum += expected.back();
  }
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(shares[i], expected[i] / sum, 1e-4) << i;
  EXPECT_GT(shares[0], 0.01f);
  EXPECT_GT(shares[1], 0.01f);
}

TEST(GroundMaterials, FourthAndFurtherScoresAreTakenOffTheThreeBest) {
  std::vector<GroundMaterial> materials;
  for (const float value : {0.30f, 0.34f, 0.42f, 0.50f, 0.9f}) materials.push_back(of_color("m", {0, 0, value}));
  const float ground = 0.36f;
  std::vector<float> shares(materials.size());
  material_shares(materials, glm::vec3(ground), shares);
  const auto s = [&](int i) {
    return std::pow(0.5 * std::abs((*materials[size_t(i)].reference_hsv).z - ground), -4.0);
  };
  const double sum = s(0) + s(1) + s(2) - 3 * s(3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(shares[size_t(i)], (s(i) - s(3)) / sum, 1e-4) << i;
  EXPECT_EQ(shares[3], 0);
  EXPECT_EQ(shares[4], 0);
}

// Whatever the ground's colour does, no share jumps.
TEST(GroundMaterials, SharesAreContinuous) {
  std::vector<GroundMaterial> materials = default_ground_materials();
  for (GroundMaterial& m : materials)
    if (m.reference_hsv) m.max_distance = 10;  // limits are edges that were asked for
  std::vector<float> last(materials.size()), shares(materials.size());
  for (int i = 0; i <= 20000; ++i) {
    const float t = float(i) / 20000;
    material_shares(materials, glm::mix(glm::vec3(0.35f, 0.48f, 0.2f), glm::vec3(0.7f, 0.55f, 0.5f), t), shares);
    float sum = 0;
    for (size_t k = 0; k < shares.size(); ++k) {
      EXPECT_NEAR(shares[k], i > 0 ? last[k] : shares[k], 0.01f) << materials[k].name << " at " << t;
      sum += shares[k];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    last = shares;
  }
}

TEST(GroundMaterials, GroundThatMatchesNothingHasTheOneThatIsEverywhere) {
  std::vector<GroundMaterial> materials{of_color("grass", {0.25f, 0.5f, 0.4f})};
  materials[0].max_distance = 0.1f;
  std::vector<float> shares(1);
  material_shares(materials, {0.9f, 0.1f, 0.9f}, shares);
  EXPECT_EQ(shares[0], 0);
  materials.emplace_back();
  shares.resize(2);
  material_shares(materials, {0.9f, 0.1f, 0.9f}, shares);
  EXPECT_EQ(shares[1], 1);
  // On its own colour the grass wins by far.
  material_shares(materials, {0.3f, 0.4f, 0.2f}, shares);
  EXPECT_GT(shares[0], 0.99f);
}

TEST(GroundMaterials, WrongOnesAreRefusedByName) {
  const auto message = [](auto change) {
    std::vector<GroundMaterial> materials{of_color("scree", {0.1f, 0.2f, 0.3f})};
    change(materials);
    const auto valid = validate(std::span<const GroundMaterial>(materials));
    return valid ? std::string() : valid.error().message;
  };
  using All = std::vector<GroundMaterial>&;
  EXPECT_EQ(message([](All) {}), "");
  for (const auto& [change, word] : std::vector<std::pair<void (*)(All), const char*>>{
           {[](All m) { m[0].tile_m = 0; }, "tile_m"},
           {[](All m) { m[0].tile_m = NAN; }, "tile_m"},
           {[](All m) { m[0].cliff_tile_m = 65; }, "cliff_tile_m"},
           {[](All m) { m[0].strength = -0.1f; }, "strength"},
           {[](All m) { m[0].relief_m = 3; }, "relief_m"},
           {[](All m) { m[0].sharpness = 33; }, "sharpness"},
           {[](All m) { m[0].exponent = 0; }, "exponent"},
           {[](All m) { m[0].max_distance = 0; }, "max_distance"},
           {[](All m) { m[0].weights = glm::vec3(0); }, "weights"},
           {[](All m) { m[0].reference_hsv = glm::vec3(1, 0, 0); }, "reference colour"},
           {[](All m) { m[0].detail = "mud"; }, "\"mud\", expected one of soil, grass"},
           {[](All m) { m[0].cliff_detail = "ice"; }, "\"ice\""},
           {[](All m) { m.resize(17, m[0]); }, "at most 16"},
           {[](All m) { m.resize(3); }, "both everywhere"}}) {
    EXPECT_NE(message(change).find(word), std::string::npos) << word << ": " << message(change);
  }
  EXPECT_TRUE(validate(std::span<const GroundMaterial>(default_ground_materials())));
}

// ---- Textures.

/// Mean absolute difference of neighbours: across the tile's border, and inside of it.
std::pair<double, double> steps(const DetailTexture& t, bool down) {
  constexpr int side = DetailTexture::k_side;
  const auto at = [&](int x, int y) { return glm::dvec4(t.shade[size_t(y) * side + size_t(x)]); };
  double border = 0, inside = 0;
  for (int i = 0; i < side; ++i) {
    const auto step = [&](int a, int b) {
      const glm::dvec4 d = glm::abs(down ? at(i, a) - at(i, b) : at(a, i) - at(b, i));
      return d.x + d.y + d.z + d.w;
    };
    border += step(side - 1, 0);
    for (int k = 0; k < side - 1; k += 7) inside += step(k, k + 1) / 73;
  }
  return {border / side, inside / side};
}

class Detail : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Detail, HasTheMeanOneAtEveryLevel) {
  const auto texture = generate_detail(GetParam());
  ASSERT_TRUE(texture) << texture.error().message;
  for (int level = 0; level < DetailTexture::k_levels; ++level)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(texture->mean(level)[c], 1, 0.01) << level;
  ASSERT_EQ(texture->shade.size(), DetailTexture::offset(DetailTexture::k_levels));
  ASSERT_EQ(texture->slope.size(), texture->shade.size());
}

TEST_P(Detail, TilesWithoutASeam) {
  const auto texture = generate_detail(GetParam());
  ASSERT_TRUE(texture);
  for (const bool down : {false, true}) {
    const auto [border, inside] = steps(*texture, down);
    EXPECT_LT(border, 1.35 * inside) << (down ? "northern" : "western") << " border";
    EXPECT_GT(inside, 0.1);
  }
}

TEST_P(Detail, HasContrastHeightsAndTheirSlopes) {
  const auto texture = generate_detail(GetParam());
  ASSERT_TRUE(texture);
  constexpr int side = DetailTexture::k_side;
  int low = 255, high = 0;
  for (int i = 0; i < side * side; ++i) {
    low = std::min(low, int(texture->shade[size_t(i)].a));
    high = std::max(high, int(texture->shade[size_t(i)].a));
  }
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, 255);
  // Slopes are central differences of the heights, north and east positive.
  for (int y = 1; y < side - 1; y += 37) {
    for (int x = 1; x < side - 1; x += 41) {
      const auto h = [&](int i, int j) { return texture->shade[size_t(j) * side + size_t(i)].a / 255.0; };
      const glm::dvec2 rise(h(x + 1, y) - h(x - 1, y), h(x, y - 1) - h(x, y + 1));
      const glm::dvec2 expected = glm::clamp(rise * (0.5 * side), -48.0, 48.0);
      const glm::dvec2 stored = glm::dvec2(texture->slope[size_t(y) * side + size_t(x)]) * (48.0 / 127);
      EXPECT_NEAR(stored.x, expected.x, 1.3) << x << " " << y;
      EXPECT_NEAR(stored.y, expected.y, 1.3) << x << " " << y;
    }
  }
}

TEST_P(Detail, IsTheSameOnEveryCall) {
  const auto one = generate_detail(GetParam()), two = generate_detail(GetParam());
  ASSERT_TRUE(one && two);
  EXPECT_EQ(std::memcmp(one->shade.data(), two->shade.data(), one->shade.size() * 4), 0);
  EXPECT_EQ(std::memcmp(one->slope.data(), two->slope.data(), one->slope.size() * 2), 0);
}

INSTANTIATE_TEST_SUITE_P(Generated, Detail, ::testing::ValuesIn(generated_details().begin(), generated_details().end()),
                         [](const auto& each) { return std::string(each.param); });

TEST(DetailImages, AnySquareSizeIsResampledAndDividedByItsMean) {
  for (const int side : {16, 100, 333, 512, 700}) {
    std::vector<glm::u8vec4> texels;
    for (int i = 0; i < side * side; ++i) {
      const int x = i % side, y = i / side;
      texels.emplace_back(90 + 60 * ((x * 8 / side + y * 8 / side) % 2), 60 + 100 * x / side, 20, 255);
    }
    const auto texture = detail_from_image("t.png", side, side, texels);
    ASSERT_TRUE(texture) << texture.error().message;
    for (int level = 0; level < DetailTexture::k_levels; ++level)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(texture->mean(level)[c], 1, 0.01) << side << " level " << level;
    // The board's fields are still where they were.
    const auto red = [&](int x, int y) { return texture->shade[size_t(y) * 512 + size_t(x)].r; };
    EXPECT_GT(red(96, 32), red(32, 32) + 30) << side;
    EXPECT_GT(red(32, 96), red(96, 96) + 30) << side;
  }
}

TEST(DetailImages, WrongOnesAreRefused) {
  const auto message = [](int width, int height, glm::u8vec4 color) {
    const std::vector<glm::u8vec4> texels(size_t(width) * size_t(height), color);
    const auto texture = detail_from_image("mud.png", width, height, texels);
    return texture ? std::string() : texture.error().message;
  };
  EXPECT_EQ(message(64, 64, {9, 9, 9, 255}), "");
  EXPECT_EQ(message(64, 32, {9, 9, 9, 255}),
            "mud.png is 64 x 32 texels; a detail texture must be square: crop or scale it");
  EXPECT_NE(message(8, 8, {9, 9, 9, 255}).find("16 to 8192"), std::string::npos);
  EXPECT_NE(message(32, 32, {0, 0, 0, 255}).find("black"), std::string::npos);
  const auto unknown = generate_detail("moss");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("\"moss\", expected one of \"soil\", \"grass\""), std::string::npos);
}

}  // namespace
}  // namespace sward
