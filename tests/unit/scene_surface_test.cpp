// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// [[surface]] in scene files.
#include <gtest/gtest.h>

#include <sward/scene/scene.h>

namespace sward {
namespace {

const std::string k_scene = R"([terrain]
generator = "meadow"
[[layer]]
name = "ivy"
on_mesh = true
[[layer.species]]
name = "ivy"
color = "#304020"
[[surface]]
)";

Expected<Scene> with_surface(const std::string& keys) {
  return parse_scene(k_scene + keys, "s.toml");
}

/// The message about what stands in line 10 or later.
void expect_refused(const std::string& text, const std::string& place, const std::string& words) {
  const auto scene = parse_scene(text, "s.toml");
  ASSERT_FALSE(scene) << text;
  EXPECT_EQ(scene.error().message.find("s.toml:" + place + ": "), 0u) << scene.error().message;
  EXPECT_NE(scene.error().message.find(words), std::string::npos) << scene.error().message;
}

TEST(SceneSurface, IsReadWithItsPlaceAndShape) {
  const auto scene = with_surface(
      "layer = \"ivy\"\nshape = \"topiary\"\nsize_m = [1, 2, 3]\nseed = 9\nposition_m = [4, 5, 0.5]\n"
      "drape = true\nyaw_deg = 90\nscale = 2\ncolor = \"#ff8000\"\n");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->surfaces.size(), 1u);
  const SceneSurface& surface = scene->surfaces[0];
  EXPECT_EQ(surface.layer, "ivy");
  EXPECT_EQ(surface.shape, "topiary");
  EXPECT_EQ(surface.size_m, glm::vec3(1, 2, 3));
  EXPECT_EQ(surface.seed, 9u);
  EXPECT_EQ(surface.position, glm::dvec3(4, 5, 0.5));
  EXPECT_TRUE(surface.drape);
  EXPECT_TRUE(surface.above_ground);
  EXPECT_NEAR(surface.yaw, 1.5707963, 1e-6);
  EXPECT_EQ(surface.scale, 2);
  ASSERT_TRUE(surface.color);
  EXPECT_NEAR(surface.color->g, 128.0f / 255, 1e-6f);
  EXPECT_TRUE(scene->layers[0].on_mesh);
}

TEST(SceneSurface, ContradictionsNameTheirLine) {
  expect_refused(k_scene + "shape = \"topiary\"\n", "9", "names no layer");
  expect_refused(k_scene + "layer = \"ivy\"\n", "9", "one of shape and mesh");
  expect_refused(k_scene + "layer = \"ivy\"\nshape = \"topiary\"\nmesh = \"a.obj\"\n", "9", "one of shape and mesh");
  expect_refused(k_scene + "layer = \"ivy\"\nshape = \"swan\"\n", "11", "\"box_hedge\" or \"topiary\"");
  expect_refused(k_scene + "layer = \"ivy\"\nmesh = \"a.obj\"\nsize_m = [1, 1, 1]\n", "12", "expected scale");
  expect_refused(k_scene + "layer = \"ivy\"\nshape = \"topiary\"\nsize_m = [0, 1, 1]\n", "12", "[0.2, 200]");
  expect_refused(k_scene + "layer = \"moss\"\nshape = \"topiary\"\n", "9", "no layer \"moss\"");
  expect_refused(k_scene + "layer = \"ivy\"\nshape = \"topiary\"\nscale = -1\n", "12", "(0, 1000000]");
}

TEST(SceneSurface, LayersAndSurfacesMustAgree) {
  std::string on_terrain = k_scene + "layer = \"ivy\"\nshape = \"topiary\"\n";
  on_terrain.replace(on_terrain.find("on_mesh = true"), 14, "on_mesh = false");
  expect_refused(on_terrain, "9", "grows on the terrain");
  expect_refused(k_scene.substr(0, k_scene.find("[[surface]]")), "3", "no [[surface]] names it");
  std::string shadows = k_scene + "layer = \"ivy\"\nshape = \"topiary\"\n";
  shadows.replace(shadows.find("on_mesh = true"), 14, "on_mesh = true\nshadow_distance_m = 3");
  expect_refused(shadows, "6", "no planar shadows");
}

TEST(SceneSurface, TheGardenIsBuiltIn) {
  const auto scene = builtin_scene("garden");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->surfaces.size(), 4u);
}

}  // namespace
}  // namespace sward
