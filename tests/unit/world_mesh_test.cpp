// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Meshes over worlds: as over a field where all is resident, without a crack
// and with a true bound whatever is resident.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "world_support.h"

namespace {

using namespace world_support;

sward::RoamMesh mesh_over(const sward::Surface& surface, uint32_t budget) {
  sward::RoamOptions options;
  options.max_triangles = budget;
  return std::move(*sward::RoamMesh::create(surface, options));
}

void tell(sward::RoamMesh& mesh, const std::vector<sward::LatticeBox>& boxes) {
  for (const sward::LatticeBox& box : boxes) mesh.residency_changed(box);
}

sward::View low_view(const sward::World& world, glm::dvec2 xy, double azimuth = 0.4) {
  const double z = world.height_range().y + 30;
  return sward::View::look({xy, z}, azimuth, -0.5, 0.87, {1280, 720}, 1, 1e6);
}

// Visible triangles by their corners, in any order.
using Corners = std::array<std::array<double, 3>, 3>;
std::vector<Corners> triangles_of(const sward::RoamMesh& mesh, glm::dvec3 origin = glm::dvec3(0)) {
  std::vector<Corners> all;
  const auto indices = mesh.visible_indices();
  for (size_t i = 0; i < indices.size(); i += 3) {
    Corners corners;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = mesh.vertex_world(indices[i + k]) - origin;
      corners[k] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// The largest error of the drawn mesh on screen over all samples that the view
// sees.
double largest_error_px(const sward::RoamMesh& mesh, const Heights& heights, const sward::Lattice& lattice,
                        const sward::View& view) {
  const glm::dmat4 clip = view.clip_from_relative();
  const auto project = [&](glm::dvec3 world) {
    const glm::dvec4 p = clip * glm::dvec4(world - view.eye, 1);
    return glm::dvec3(p.x / p.w * view.viewport.x * 0.5, p.y / p.w * view.viewport.y * 0.5, p.w);
  };
  double worst = 0;
  const auto indices = mesh.visible_indices();
  const int step = lattice.sample_step();
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertex_world(indices[i]), b = mesh.vertex_world(indices[i + 1]),
                     c = mesh.vertex_world(indices[i + 2]);
    const glm::dvec2 u(b - a), v(c - a);
    const double area = u.x * v.y - u.y * v.x;
    const glm::dvec2 low = glm::min(glm::dvec2(a), glm::min(glm::dvec2(b), glm::dvec2(c)));
    const glm::dvec2 high = glm::max(glm::dvec2(a), glm::max(glm::dvec2(b), glm::dvec2(c)));
    const auto first = glm::ivec2(glm::floor(lattice.from_world({low.x, high.y}) / double(step)));
    const auto last = glm::ivec2(glm::ceil(lattice.from_world({high.x, low.y}) / double(step)));
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) {
        const glm::dvec2 xy = lattice.world_xy(glm::ivec2(column, row) * step), q = xy - glm::dvec2(a);
        const double s = (q.x * v.y - q.y * v.x) / area, t = (u.x * q.y - u.y * q.x) / area;
        if (s < 0 || t < 0 || s + t > 1) continue;
        const double z = double(heights.at(column, row)) * heights.desc.scale;
        const glm::dvec3 drawn = project({xy, a.z + s * (b.z - a.z) + t * (c.z - a.z)}), exact = project({xy, z});
        if (drawn.z < 1 || exact.z < 1 || std::abs(exact.x) > 640 || std::abs(exact.y) > 360) continue;
        worst = std::max(worst, glm::length(glm::dvec2(drawn) - glm::dvec2(exact)));
      }
  }
  return worst;
}

TEST(WorldMesh, AllResidentIsTheMeshOfTheField) {
  const Heights heights = make_heights(make_desc({3, 3}, 5, 2));
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = 97;
  desc.spacing = heights.desc.spacing;
  desc.scale = heights.desc.scale;
  desc.relief.enabled = false;
  const auto field =
      sward::HeightField::create(desc, std::vector<uint16_t>(heights.samples.begin(), heights.samples.end())).value();
  const sward::Bounds bounds = sward::Bounds::create(field);
  const auto world = make_world(heights, loader_of(heights), roomy());
  settle(*world, view_over(*world));
  const sward::FieldSurface surface(bounds);
  sward::RoamMesh own = mesh_over(*world, 900), reference = mesh_over(surface, 900);
  for (int frame = 0; frame < 20; ++frame) {
    const sward::View view = low_view(*world, {-300 + 30 * frame, -200 + 10 * frame}, 0.1 * frame);
    ASSERT_TRUE(own.update(view));
    ASSERT_TRUE(reference.update(view));
    ASSERT_EQ(triangles_of(own), triangles_of(reference));
    ASSERT_EQ(own.bound_px(), reference.bound_px());
  }
  ASSERT_GT(own.visible_indices().size(), 3 * 500u);
}

TEST(WorldMesh, FollowsWhatIsLoadedAndDropped) {
  const Heights heights = make_heights(make_desc({4, 4}, 5, 2));
  sward::WorldOptions options = roomy();
  const size_t square = 35 * 35 * 2 + 33 * 33 * 2 + 18 * 8;
  options.memory_bytes = 17 * 17 * 6 + 16 * 16 * 2 + 16 * 24 + 5 * square;
  options.adopt_per_poll = 1;
  const auto world = make_world(heights, loader_of(heights), options);
  sward::RoamMesh mesh = mesh_over(*world, 4000);
  const sward::View west = low_view(*world, {-500, 0}), east = low_view(*world, {500, 0}, 2.7);
  ASSERT_TRUE(mesh.update(west));
  ASSERT_TRUE(mesh.validate());
  const size_t coarse = mesh.visible_indices().size();
  for (int turn = 0; turn < 3; ++turn)
    for (const sward::View& view : {west, east}) {
      world->follow({&view, 1});
      ASSERT_TRUE(wait_until([&] {
        tell(mesh, world->poll());
        EXPECT_TRUE(mesh.update(view));
        const auto valid = mesh.validate();
        EXPECT_TRUE(valid) << valid.error().message;
        return world->settled();
      }));
      EXPECT_GT(mesh.visible_indices().size(), 2 * coarse);
    }
  EXPECT_GT(world->stats().drops, 5u);
}

TEST(WorldMesh, BoundIsTrueWhateverIsResident) {
  const Heights heights = make_heights(make_desc({3, 3}, 5, 2));
  const auto coarse = sward::build_coarse(heights.desc, heights.reader());
  std::mt19937 random(5);
  double worst = 0;
  for (int round = 0; round < 24; ++round) {
    const uint32_t chosen = round == 0 ? 0 : random() % 512;
    const auto world =
        sward::World::create(
            heights.desc, *coarse,
            [&, build = loader_of(heights)](const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
              if ((chosen >> (request.square.y * 3 + request.square.x) & 1) == 0) return sward::fail("left out");
              return build(request);
            },
            roomy())
            .value();
    const sward::View view =
        low_view(*world, {double(random() % 600) - 300, double(random() % 600) - 300}, double(random() % 6));
    sward::RoamMesh mesh = mesh_over(*world, 600);
    ASSERT_TRUE(mesh.update(view));
    tell(mesh, settle(*world, view));
    ASSERT_TRUE(mesh.update(view));
    const auto valid = mesh.validate();
    ASSERT_TRUE(valid) << valid.error().message;
    const double error = largest_error_px(mesh, heights, world->lattice(), view);
    EXPECT_LE(error, double(mesh.bound_px()) * (1 + 1e-6));
    worst = std::max(worst, error);
  }
  EXPECT_GT(worst, 1);
}

// Squares that arrive set thousands of splits free. They are made over several updates, the same in every run, and end
// in the mesh that had all squares from the start.
TEST(WorldMesh, WhatIsLoadedIsFollowedOverSeveralUpdates) {
  const Heights heights = make_heights(make_desc({3, 3}, 7, 2));
  const auto world = make_world(heights, loader_of(heights), roomy());
  const sward::View view = view_over(*world);
  sward::RoamMesh mesh = mesh_over(*world, 12000), twin = mesh_over(*world, 12000);
  for (sward::RoamMesh* each : {&mesh, &twin}) ASSERT_TRUE(each->update(view));
  const size_t coarse = mesh.visible_indices().size() / 3;
  const auto boxes = settle(*world, view);
  tell(mesh, boxes);
  tell(twin, boxes);
  std::vector<uint32_t> made;
  for (bool capped = true; capped && made.size() < 100;) {
    const auto stats = mesh.update(view);
    ASSERT_TRUE(stats);
    ASSERT_TRUE(twin.update(view));
    ASSERT_EQ(triangles_of(mesh), triangles_of(twin)) << "update " << made.size();
    const auto valid = mesh.validate();
    ASSERT_TRUE(valid) << valid.error().message;
    made.push_back(stats->splits + stats->merges);
    capped = stats->capped;
  }
  ASSERT_GT(mesh.visible_indices().size() / 3, coarse + 5000);
  EXPECT_LT(made.front(), 1000u);
  EXPECT_GT(made.size(), 5u);
  EXPECT_LT(made.size(), 30u) << "more in every update";
  sward::RoamMesh at_once = mesh_over(*world, 12000);
  ASSERT_TRUE(at_once.update(view));
  EXPECT_EQ(triangles_of(mesh), triangles_of(at_once));
  EXPECT_EQ(mesh.bound_px(), at_once.bound_px());
  const auto still = mesh.update(view);
  EXPECT_EQ(still->splits + still->merges, 0u);
}

// 10 000 km from the origin: the same triangles, and what the GPU gets differs
// by no more than x and y do in double precision (2 nm) rounded to the float at
// kilometre range (0.1 mm).
TEST(WorldMesh, FarFromTheOriginIsTheSameMesh) {
  const Heights heights = make_heights(make_desc({3, 3}, 5, 2));
  Heights far = heights;
  const glm::dvec3 origin(1.0e7, -1.0e7, 0);
  far.desc.origin = origin;
  const auto near_world = make_world(heights, loader_of(heights), roomy());
  const auto far_world = make_world(far, loader_of(far), roomy());
  settle(*near_world, view_over(*near_world));
  settle(*far_world, view_over(*far_world, glm::dvec2(origin)));
  sward::RoamMesh near_mesh = mesh_over(*near_world, 900), far_mesh = mesh_over(*far_world, 900);
  for (int frame = 0; frame < 20; ++frame) {
    sward::View view = low_view(*near_world, {-300 + 30 * frame, 10 * frame}, 0.1 * frame);
    ASSERT_TRUE(near_mesh.update(view));
    view.eye += origin;
    ASSERT_TRUE(far_mesh.update(view));
    const auto a = near_mesh.visible_indices(), b = far_mesh.visible_indices();
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      const glm::dvec3 p = glm::dvec3(near_mesh.vertices()[a[i]].position) + near_mesh.origin();
      const glm::dvec3 q = glm::dvec3(far_mesh.vertices()[b[i]].position) + (far_mesh.origin() - origin);
      ASSERT_LT(glm::length(p - q), 1e-4);
    }
  }
}

}  // namespace
