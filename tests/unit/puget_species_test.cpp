// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// demo/scenes/puget.toml against the colour map that it was written for: which species competes in which zone.

#if defined(SWARD_IMAGE_IO)
#include <gtest/gtest.h>
#include <sward/image_io/image_io.h>
#include <sward/scene/scene.h>

#include <array>
#include <filesystem>
#include <map>
#include <random>
#include <string>

#include "vegetation/layer_params.h"

namespace {

using namespace sward;

enum class Zone { water, lowland, foothill, border, mountain, peak };

/// The painter's zones by eye: hue in degrees, saturation.
Zone zone_of(glm::vec3 hsv) {
  const float hue = hsv.x * 360;
  if (hsv.y < 0.65f) return Zone::peak;
  if (hue < 20 || hue > 340) return Zone::mountain;
  if (hue < 40) return Zone::border;
  if (hue < 70) return Zone::foothill;
  return hue < 150 ? Zone::lowland : Zone::water;
}

class PugetSpecies : public testing::Test {
 protected:
  void SetUp() override {
    const auto path = std::filesystem::path(SWARD_SHARED_DATA) / "ps_texture_1k.png";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    auto map = load_color_map(path.string(), {0, 0}, {1024, 1024});
    ASSERT_TRUE(map) << map.error().message;
    map_ = std::move(*map);
    const auto scene = builtin_scene("puget");
    ASSERT_TRUE(scene) << scene.error().message;
    layer_ = scene->layers.at(0);
    params_ = make_species_params(layer_);
  }

  glm::vec3 texel(int i, int j) const {
    const glm::u8vec4 c = map_.texels[size_t(j) * size_t(map_.width) + size_t(i)];
    return glm::vec3(c) / 255.0f;
  }
  /// The best species, or -1; `blades` tells whether a grass competes at all, which chance may then choose.
  int best_species(glm::vec3 hsv, bool& blades) const {
    int best = -1;
    float highest = 0;
    blades = false;
    for (size_t i = 0; i < params_.size(); ++i) {
      const float score = shared::species_score(params_[i], hsv);
      if (score > 0 && layer_.species[i].kind == PlantKind::blade) blades = true;
      if (score > highest) {
        highest = score;
        best = int(i);
      }
    }
    return best;
  }

  ColorMap map_;
  Layer layer_;
  std::vector<shared::SpeciesParams> params_;
};

TEST_F(PugetSpecies, EveryZoneHasItsOwn) {
  const std::map<Zone, std::string> expected{
      {Zone::water, "water"}, {Zone::mountain, "mountain_rock"}, {Zone::peak, "peak_snow"}};
  std::map<Zone, int64_t> texels, green, dry, nothing;
  for (int j = 0; j < map_.height; ++j) {
    for (int i = 0; i < map_.width; ++i) {
      const glm::vec3 hsv = shared::rgb_to_hsv(texel(i, j));
      const Zone zone = zone_of(hsv);
      bool blades = false;
      const int best = best_species(hsv, blades);
      ++texels[zone];
      const std::string name = best < 0 ? "" : layer_.species[size_t(best)].name;
      nothing[zone] += name.empty() ? 1 : 0;
      green[zone] += name == "lowland_grass" ? 1 : 0;
      dry[zone] += name == "foothill_grass" ? 1 : 0;
      if (const auto bare = expected.find(zone); bare != expected.end()) {
        ASSERT_EQ(name, bare->second) << "texel " << i << ", " << j << " hue " << hsv.x * 360 << " saturation "
                                      << hsv.y;
        ASSERT_FALSE(blades) << "texel " << i << ", " << j << " hue " << hsv.x * 360 << " saturation " << hsv.y;
      }
    }
  }
  // 3.6 % of the map is water, more than a third red mountain; counted once by another program.
  EXPECT_EQ(texels[Zone::water], 37281);
  EXPECT_GT(texels[Zone::mountain], 340000);
  EXPECT_GT(green[Zone::lowland], texels[Zone::lowland] * 8 / 10);
  EXPECT_EQ(green[Zone::lowland] + dry[Zone::lowland], texels[Zone::lowland]);
  EXPECT_GT(dry[Zone::foothill], texels[Zone::foothill] * 9 / 10);
  EXPECT_EQ(nothing[Zone::lowland] + nothing[Zone::foothill] + nothing[Zone::border], 0);
}

TEST_F(PugetSpecies, NoBladeBetweenTexelsOfWaterOrRedMountain) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(0.5f, 1023.49f);
  int64_t on_bare = 0;
  for (int n = 0; n < 1000000; ++n) {
    const float x = anywhere(random) - 0.5f, y = anywhere(random) - 0.5f;
    const int i = std::min(int(x), 1022), j = std::min(int(y), 1022);
    const glm::vec2 f(x - float(i), y - float(j));
    const glm::vec3 color =
        glm::mix(glm::mix(texel(i, j), texel(i + 1, j), f.x), glm::mix(texel(i, j + 1), texel(i + 1, j + 1), f.x), f.y);
    const Zone nearest = zone_of(shared::rgb_to_hsv(texel(f.x < 0.5f ? i : i + 1, f.y < 0.5f ? j : j + 1)));
    if (nearest != Zone::water && nearest != Zone::mountain) continue;
    ++on_bare;
    bool blades = false;
    best_species(shared::rgb_to_hsv(color), blades);
    ASSERT_FALSE(blades) << "at " << x << ", " << y;
  }
  EXPECT_GT(on_bare, 300000);
}

}  // namespace
#endif
