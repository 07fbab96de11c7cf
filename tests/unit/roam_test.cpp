// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "drawn_surface.h"
#include "roam_reference.h"
#include "roam_support.h"

namespace {

using drawn_surface::Errors;
using drawn_surface::measure;
using roam_reference::error_of;
using roam_support::make_terrain;
using roam_support::Random;
using roam_support::random_view;
using roam_support::Terrain;
using sward::RoamMesh;
using sward::RoamOptions;
using sward::View;

RoamMesh make_mesh(const Terrain& terrain, RoamOptions options) {
  auto mesh = RoamMesh::create(*terrain.bounds, options);
  EXPECT_TRUE(mesh.has_value()) << (mesh ? "" : mesh.error().message);
  return std::move(*mesh);
}

std::string fault_of(const RoamMesh& mesh) {
  const auto valid = mesh.validate();
  return valid ? "" : valid.error().message;
}

// A camera that drifts over the field, turning.
View drifting_view(const sward::HeightField& field, double t) {
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  const glm::dvec2 xy = low + size * (0.5 + 0.4 * glm::dvec2(std::cos(0.31 * t), std::sin(0.23 * t)));
  const double z = field.height(xy) + 20 + 15 * std::sin(0.4 * t);
  return View::look({xy, z}, 0.9 * t, -0.25 + 0.2 * std::sin(0.7 * t), 0.9, {1280, 720}, 0.5, 1e5);
}

TEST(RoamMesh, StartsAsTheRootMesh) {
  const Terrain terrain = make_terrain({});
  const RoamMesh mesh = make_mesh(terrain, {});
  EXPECT_EQ(mesh.all_indices().size(), 6u);
  EXPECT_TRUE(mesh.visible_indices().empty());
  EXPECT_EQ(mesh.bound_px(), 0.0f);
  EXPECT_EQ(fault_of(mesh), "");
}

TEST(RoamMesh, RefusesBudgetsBelowTheRootMesh) {
  roam_support::TerrainOptions strip;
  strip.columns = 200;
  strip.rows = 20;
  const Terrain terrain = make_terrain(strip);
  RoamOptions options;
  options.max_triangles = 1;
  const auto refused = RoamMesh::create(*terrain.bounds, options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("budget of 1"), std::string::npos) << refused.error().message;
  const size_t roots = make_mesh(terrain, {}).all_indices().size() / 3;
  EXPECT_GT(roots, 2u);
  EXPECT_NE(refused.error().message.find(std::to_string(roots)), std::string::npos) << refused.error().message;
  options.max_triangles = uint32_t(roots);
  EXPECT_TRUE(RoamMesh::create(*terrain.bounds, options).has_value());
}

TEST(RoamMesh, RefusesOptionsThatAreNoNumbers) {
  const Terrain terrain = make_terrain({});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  RoamMesh mesh = make_mesh(terrain, {});
  for (int which = 0; which < 3; ++which) {
    RoamOptions options;
    if (which == 0) options.target_px = nan;
    if (which == 1) options.hysteresis = -1;
    if (which == 2) options.time_cap_s = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(RoamMesh::create(*terrain.bounds, options).has_value());
    EXPECT_FALSE(mesh.set_options(options).has_value());
    EXPECT_EQ(mesh.options().hysteresis, RoamOptions().hysteresis);
  }
}

TEST(RoamMesh, RefusesViewsThatAreNoneAndKeepsTheMesh) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  View view = drifting_view(*terrain.field, 0);
  ASSERT_TRUE(mesh.update(view).has_value());
  const std::vector<uint32_t> before(mesh.visible_indices().begin(), mesh.visible_indices().end());
  const size_t changed = mesh.changed_vertices().size();
  view.eye.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(mesh.update(view).has_value());
  view = drifting_view(*terrain.field, 1);
  view.viewport = {0, 720};
  EXPECT_FALSE(mesh.update(view).has_value());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), mesh.visible_indices().begin(), mesh.visible_indices().end()));
  EXPECT_EQ(mesh.changed_vertices().size(), changed);
  EXPECT_EQ(fault_of(mesh), "");
}

TEST(RoamMesh, NeverExceedsItsBudget) {
  for (const int rows : {65, 41}) {
    roam_support::TerrainOptions size;
    size.rows = rows;
    const Terrain terrain = make_terrain(size);
    Random random(7);
    RoamMesh mesh = make_mesh(terrain, {});
    const uint32_t roots = uint32_t(mesh.all_indices().size() / 3);
    for (int i = 0; i < 3000; ++i) {
      if (random.below(3) == 0) {
        RoamOptions options;
        options.max_triangles = roots + random.below(random.below(2) == 0 ? 20 : 3000);
        options.hysteresis = float(random.uniform(0, 0.1));
        options.target_px = random.below(4) == 0 ? float(random.uniform(0, 20)) : 0;
        ASSERT_TRUE(mesh.set_options(options).has_value());
      }
      const auto stats = mesh.update(random_view(*terrain.field, random));
      ASSERT_TRUE(stats.has_value());
      ASSERT_LE(stats->visible, mesh.options().max_triangles) << "view " << i;
      ASSERT_EQ(mesh.visible_indices().size(), 3 * size_t(stats->visible));
      ASSERT_LE(stats->leaves, 2 * mesh.options().max_triangles + roots + 4096 + 8);
      if (i % 16 == 0) {
        ASSERT_EQ(fault_of(mesh), "") << "view " << i;
      }
    }
  }
}

TEST(RoamMesh, LookingAwayLeavesNothingToDraw) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  ASSERT_TRUE(mesh.update(drifting_view(*terrain.field, 0)).has_value());
  const double high = terrain.field->height_range()[1];
  const auto stats = mesh.update(View::look({0, 0, high + 50}, 0, 1.5, 0.5, {640, 480}, 1, 1e4));
  ASSERT_TRUE(stats.has_value());
  EXPECT_EQ(stats->visible, 0u);
  EXPECT_TRUE(mesh.visible_indices().empty());
  EXPECT_EQ(mesh.bound_px(), 0.0f);
  EXPECT_EQ(fault_of(mesh), "");
}

TEST(RoamMesh, HasNoCrackAfterAnyOfManyUpdates) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  roam_reference::EdgeCheck check;
  Random random(3);
  double t = 0;
  uint64_t changes = 0;
  for (int i = 0; i < 100000; ++i) {
    if (i % 500 == 0) {
      RoamOptions options;
      options.max_triangles = 20 + random.below(180);
      ASSERT_TRUE(mesh.set_options(options).has_value());
    }
    t += i % 97 == 0 ? random.uniform(0, 10) : random.uniform(0, 0.02);
    const auto stats = mesh.update(drifting_view(*terrain.field, t));
    ASSERT_TRUE(stats.has_value());
    changes += stats->splits + stats->merges;
    ASSERT_EQ(check.faults(mesh, *terrain.field), 0) << "update " << i;
    if (i % 100 == 0) {
      ASSERT_EQ(fault_of(mesh), "") << "update " << i;
    }
  }
  EXPECT_GT(changes, 100000u);
}

TEST(RoamMesh, HasNoCrackWithPaddingAndManyRootSquares) {
  roam_support::TerrainOptions size;
  size.columns = 147;
  size.rows = 58;
  const Terrain terrain = make_terrain(size);
  RoamOptions options;
  options.max_triangles = 1200;
  RoamMesh mesh = make_mesh(terrain, options);
  roam_reference::EdgeCheck check;
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(mesh.update(random_view(*terrain.field, random)).has_value());
    ASSERT_EQ(check.faults(mesh, *terrain.field), 0) << "update " << i;
  }
}

// Updates until nothing changes any more: what is out of sight is given up over several updates.
void settle(RoamMesh& mesh, const View& view) {
  for (int i = 0; i < 100; ++i) {
    const auto stats = mesh.update(view);
    ASSERT_TRUE(stats.has_value());
    if (i > 1 && stats->splits + stats->merges == 0) return;
  }
  FAIL() << "the mesh does not come to rest";
}

// Runs many views, jumps and small steps, and compares each converged bound with the top-down mesh's.
void compare_with_greedy(float hysteresis, double allowed, bool equal) {
  const Terrain terrain = make_terrain({});
  RoamOptions options;
  options.hysteresis = hysteresis;
  RoamMesh mesh = make_mesh(terrain, options);
  Random random(11);
  int bounded = 0, different = 0;
  for (int i = 0; i < 400; ++i) {
    const View view = i % 3 == 0 ? random_view(*terrain.field, random) : drifting_view(*terrain.field, 0.01 * i);
    options.max_triangles = 40 + random.below(1500);
    ASSERT_TRUE(mesh.set_options(options).has_value());
    settle(mesh, view);
    roam_reference::GreedyMesh greedy(*terrain.bounds, view);
    const double best = greedy.refine(options.max_triangles, 0);
    ASSERT_LE(mesh.bound_px(), error_of(view, best * allowed) * (1 + 2e-5)) << "view " << i;
    bounded += best > 0 && best < RoamMesh::k_artificial_max;
    different += mesh.bound_px() < error_of(view, best) * (1 - 1e-5);
  }
  EXPECT_GT(bounded, 150);
  // A split that takes more triangles out of sight than it makes may let the incremental mesh go on where a top-down
  // one stops.
  if (equal) {
    EXPECT_LE(different, 5);
  }
}

TEST(RoamMesh, EqualsTopDownGreedyMeshWithoutHysteresis) {
  compare_with_greedy(0.0f, 1.0, true);
}

TEST(RoamMesh, StaysWithinTheHysteresisOfTheGreedyMesh) {
  compare_with_greedy(0.01f, 1.01, false);
  compare_with_greedy(0.2f, 1.2, false);
}

TEST(RoamMesh, AStillViewChangesNothing) {
  const Terrain terrain = make_terrain({});
  for (const float hysteresis : {0.0f, 0.01f}) {
    RoamOptions options;
    options.max_triangles = 700;
    options.hysteresis = hysteresis;
    RoamMesh mesh = make_mesh(terrain, options);
    for (int i = 0; i < 50; ++i) {
      const View view = drifting_view(*terrain.field, 0.37 * i);
      settle(mesh, view);
      const std::vector<uint32_t> before(mesh.visible_indices().begin(), mesh.visible_indices().end());
      // Setting the same options makes the mesh look again for something to improve.
      for (int again = 0; again < 3; ++again) {
        if (again == 2) {
          ASSERT_TRUE(mesh.set_options(options).has_value());
        }
        const auto stats = mesh.update(view);
        ASSERT_EQ(stats->splits + stats->merges, 0u);
        EXPECT_TRUE(mesh.changed_vertices().empty());
        EXPECT_FALSE(mesh.all_vertices_changed());
        EXPECT_TRUE(
            std::equal(before.begin(), before.end(), mesh.visible_indices().begin(), mesh.visible_indices().end()));
      }
    }
  }
}

TEST(RoamMesh, IsDeterministic) {
  const Terrain terrain = make_terrain({});
  RoamMesh first = make_mesh(terrain, {}), second = make_mesh(terrain, {});
  for (int i = 0; i < 100; ++i) {
    const View view = drifting_view(*terrain.field, 0.21 * i);
    ASSERT_TRUE(first.update(view).has_value() && second.update(view).has_value());
    const auto a = first.visible_indices(), b = second.visible_indices();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

TEST(RoamMesh, StopsAtTheTargetAndGivesUpWhatIsFiner) {
  const Terrain terrain = make_terrain({});
  RoamOptions options;
  options.max_triangles = 20000;
  options.target_px = 12;
  RoamMesh mesh = make_mesh(terrain, options);
  for (int i = 0; i < 80; ++i) {
    const View view = drifting_view(*terrain.field, 0.41 * i);
    ASSERT_TRUE(mesh.update(view).has_value());
    ASSERT_LE(mesh.bound_px(), options.target_px);
    settle(mesh, view);
    const auto stats = mesh.update(view);
    roam_reference::GreedyMesh greedy(*terrain.bounds, view);
    // The largest thickness of which the error is at most the target.
    double thickness = 2 * double(options.target_px);
    while (error_of(view, thickness) > double(options.target_px)) thickness *= 0.999;
    greedy.refine(options.max_triangles, thickness);
    EXPECT_LE(stats->visible, greedy.visible() * 1.1 + 8) << "view " << i;
    ASSERT_EQ(fault_of(mesh), "");
  }
}

TEST(RoamMesh, GoesOnAfterATimeCap) {
  const Terrain terrain = make_terrain({});
  const View view = drifting_view(*terrain.field, 2);
  RoamOptions options;
  options.max_triangles = 2000;
  RoamMesh uncapped = make_mesh(terrain, options);
  ASSERT_TRUE(uncapped.update(view).has_value());
  options.time_cap_s = 1e-9;
  RoamMesh mesh = make_mesh(terrain, options);
  int updates = 0;
  bool capped = true;
  while (capped && updates < 5000) {
    const auto stats = mesh.update(view);
    ASSERT_TRUE(stats.has_value());
    ASSERT_LE(stats->visible, options.max_triangles);
    ASSERT_EQ(fault_of(mesh), "");
    capped = stats->capped;
    ++updates;
  }
  EXPECT_FALSE(capped);
  EXPECT_GT(updates, 10);
  EXPECT_EQ(mesh.bound_px(), uncapped.bound_px());
}

// A host that copies changed slots only has what the mesh has; the origin follows the eye.
TEST(RoamMesh, ReportsEveryChangedVertex) {
  roam_support::TerrainOptions wide;
  wide.spacing = 100;
  const Terrain terrain = make_terrain(wide);
  RoamOptions options;
  options.max_triangles = 600;
  RoamMesh mesh = make_mesh(terrain, options);
  std::vector<sward::RoamVertex> copy;
  int rebases = 0;
  for (int i = 0; i < 400; ++i) {
    const View view = drifting_view(*terrain.field, 0.05 * i);
    ASSERT_TRUE(mesh.update(view).has_value());
    ASSERT_LE(glm::distance(mesh.origin(), view.eye), 1001.0);
    rebases += mesh.all_vertices_changed();
    const auto changed = mesh.changed_vertices();
    EXPECT_EQ(std::set<uint32_t>(changed.begin(), changed.end()).size(), changed.size());
    copy.resize(mesh.vertices().size());
    for (const uint32_t slot : changed) copy[slot] = mesh.vertices()[slot];
    for (const uint32_t slot : mesh.visible_indices()) {
      ASSERT_EQ(copy[slot].position, mesh.vertices()[slot].position);
      ASSERT_EQ(copy[slot].position, glm::vec3(mesh.vertex_world(slot) - mesh.origin()));
    }
  }
  EXPECT_GT(rebases, 2);
  EXPECT_LT(rebases, 200);
}

TEST(RoamMesh, DrawsCounterClockwiseSeenFromAbove) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  ASSERT_TRUE(mesh.update(drifting_view(*terrain.field, 0)).has_value());
  const auto indices = mesh.visible_indices();
  ASSERT_FALSE(indices.empty());
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertex_world(indices[i]);
    const glm::dvec3 n = glm::cross(mesh.vertex_world(indices[i + 1]) - a, mesh.vertex_world(indices[i + 2]) - a);
    ASSERT_GT(n.z, 0);
  }
}

TEST(RoamMesh, BoundHoldsForEverySampleInTheFrustum) {
  const Terrain terrain = make_terrain({});
  const sward::HeightField& field = *terrain.field;
  Random random(21);
  RoamMesh mesh = make_mesh(terrain, {});
  int useful = 0;
  for (int i = 0; i < 60; ++i) {
    RoamOptions options;
    options.max_triangles = 50 + random.below(600);
    ASSERT_TRUE(mesh.set_options(options).has_value());
    const View view = i % 2 == 0 ? random_view(field, random) : drifting_view(field, 0.3 * i);
    ASSERT_TRUE(mesh.update(view).has_value());
    Errors errors;
    for (int row = 0; row < field.desc().rows; ++row) {
      for (int column = 0; column < field.desc().columns; ++column) {
        const glm::dvec2 xy = field.world_xy(sward::LatticePoint(column, row) * field.sample_step());
        measure(mesh, view, xy, field.sample(column, row), errors);
      }
    }
    ASSERT_EQ(errors.undrawn, 0) << "view " << i;
    ASSERT_LE(errors.largest, mesh.bound_px() * (1 + 1e-6) + 1e-9) << "view " << i;
    useful += errors.seen > 100 && mesh.bound_px() < RoamMesh::k_artificial_max;
  }
  EXPECT_GT(useful, 20);
}

TEST(RoamMesh, BoundHoldsForReliefBelowTheData) {
  roam_support::TerrainOptions size;
  size.columns = size.rows = 17;
  size.spacing = 20;
  size.relief_m = 60;
  size.wavelength = 8;
  size.detail = true;
  const Terrain terrain = make_terrain(size);
  const sward::HeightField& field = *terrain.field;
  ASSERT_GT(field.max_level(), field.data_level());
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  RoamOptions options;
  options.max_triangles = 1500;
  RoamMesh mesh = make_mesh(terrain, options);
  Random random(22);
  int seen = 0;
  for (int i = 0; i < 12; ++i) {
    const View view = drifting_view(field, 0.9 * i);
    ASSERT_TRUE(mesh.update(view).has_value());
    Errors errors;
    for (int k = 0; k < 2000; ++k) {
      const glm::dvec2 xy(random.uniform(low.x, high.x), random.uniform(low.y, high.y));
      measure(mesh, view, xy, field.height(xy), errors);
    }
    ASSERT_EQ(errors.undrawn, 0) << "view " << i;
    ASSERT_LE(errors.largest, mesh.bound_px() * (1 + 1e-6) + 1e-9) << "view " << i;
    seen += errors.seen;
  }
  EXPECT_GT(seen, 1000);
}

// The same mesh 10 000 km away: what the GPU gets differs by rounding alone.
TEST(RoamMesh, IsTheSameFarFromTheOrigin) {
  const glm::dvec3 far(6.0e6, -8.0e6, 1000);
  roam_support::TerrainOptions moved;
  moved.origin = far;
  const Terrain here = make_terrain({}), there = make_terrain(moved);
  RoamOptions options;
  options.max_triangles = 800;
  RoamMesh near_mesh = make_mesh(here, options), far_mesh = make_mesh(there, options);
  for (int i = 0; i < 20; ++i) {
    View view = drifting_view(*here.field, 0.5 * i);
    ASSERT_TRUE(near_mesh.update(view).has_value());
    view.eye += far;
    ASSERT_TRUE(far_mesh.update(view).has_value());
    ASSERT_NEAR(far_mesh.bound_px(), near_mesh.bound_px(), 1e-4 * near_mesh.bound_px());
    const auto a = near_mesh.visible_indices(), b = far_mesh.visible_indices();
    ASSERT_EQ(a.size(), b.size());
    const glm::vec3 shift(far_mesh.origin() - far - near_mesh.origin());
    for (size_t k = 0; k < a.size(); ++k) {
      const glm::vec3 p = near_mesh.vertices()[a[k]].position, q = far_mesh.vertices()[b[k]].position + shift;
      ASSERT_LT(glm::length(p - q), 2e-3f);
    }
  }
}

}  // namespace
