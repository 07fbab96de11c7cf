// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/many_views.h>

#include <gtest/gtest.h>

#include <limits>

#include "roam_support.h"

namespace sward {
namespace {

std::vector<RoamMesh> make_meshes(const roam_support::Terrain& terrain, size_t count) {
  std::vector<RoamMesh> meshes;
  for (size_t i = 0; i < count; ++i) {
    RoamOptions options;
    options.max_triangles = uint32_t(300 + 250 * i);
    meshes.push_back(RoamMesh::create(*terrain.bounds, options).value());
  }
  return meshes;
}

View view_of(const HeightField& field, size_t camera, int frame) {
  const double t = 0.03 * frame + 2.0 * double(camera);
  const glm::dvec2 xy = 200.0 * glm::dvec2(std::cos(0.4 * t), std::sin(0.3 * t));
  return View::look({xy, field.height(xy) + 25}, t, -0.3, 0.9, {1280, 720}, 0.5, 1e5);
}

void expect_same(const RoamMesh& a, const RoamMesh& b) {
  const auto left = a.visible_indices(), right = b.visible_indices();
  ASSERT_TRUE(std::equal(left.begin(), left.end(), right.begin(), right.end()));
  for (const uint32_t slot : left) ASSERT_EQ(a.vertex_world(slot), b.vertex_world(slot));
}

TEST(ManyViews, AreUpdatedAsOneAfterTheOther) {
  const roam_support::Terrain terrain = roam_support::make_terrain({});
  constexpr size_t k_cameras = 7;
  for (const int threads : {0, 1, 4, 20}) {
    std::vector<RoamMesh> together = make_meshes(terrain, k_cameras), alone = make_meshes(terrain, k_cameras);
    std::vector<MeshUpdate> updates(k_cameras);
    uint32_t splits = 0;
    for (int frame = 0; frame < 60; ++frame) {
      for (size_t i = 0; i < k_cameras; ++i) {
        updates[i].mesh = &together[i];
        updates[i].view = view_of(*terrain.field, i, frame);
        // Every other camera has a clock.
        if (i % 2 == 0) updates[i].time_s = frame / 60.0;
      }
      update_all(updates, threads);
      for (size_t i = 0; i < k_cameras; ++i) {
        const MeshUpdate& u = updates[i];
        const auto expected = u.time_s ? alone[i].update(u.view, *u.time_s) : alone[i].update(u.view);
        ASSERT_TRUE(u.stats.has_value() && expected.has_value());
        ASSERT_EQ(u.stats->visible, expected->visible);
        ASSERT_EQ(u.stats->moving, expected->moving);
        splits += u.stats->splits;
        expect_same(together[i], alone[i]);
      }
    }
    EXPECT_GT(splits, 1000u);
  }
}

TEST(ManyViews, AFailedUpdateLeavesTheOthersAlone) {
  const roam_support::Terrain terrain = roam_support::make_terrain({});
  std::vector<RoamMesh> meshes = make_meshes(terrain, 3);
  std::vector<MeshUpdate> updates(3);
  for (size_t i = 0; i < 3; ++i) updates[i].mesh = &meshes[i], updates[i].view = view_of(*terrain.field, i, 0);
  updates[1].view.eye.x = std::numeric_limits<double>::quiet_NaN();
  update_all(updates, 2);
  EXPECT_TRUE(updates[0].stats.has_value());
  EXPECT_FALSE(updates[1].stats.has_value());
  EXPECT_TRUE(updates[2].stats.has_value());
  EXPECT_FALSE(meshes[0].visible_indices().empty());
  EXPECT_TRUE(meshes[1].visible_indices().empty());
  update_all({}, 2);
}

}  // namespace
}  // namespace sward
