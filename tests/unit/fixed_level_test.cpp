// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The frame-coherent collection of fixed-level triangles against one that rebuilds everything.
#include "../../terrain/src/terrain/fixed_level.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "../../terrain/src/terrain/roam_engine.h"
#include "../../terrain/src/terrain/worker_pool.h"
#include "counted_allocations.h"
#include "fixed_level_reference.h"
#include "roam_support.h"

namespace {

using roam_support::make_terrain;
using roam_support::Random;
using roam_support::Terrain;
using roam_support::TerrainOptions;
using sward::FixedLevelOptions;
using sward::FixedTriangle;
using sward::FixedTriangles;
using sward::LatticeBox;
using sward::View;
using sward::roam::RoamEngine;
using sward::roam::SurfaceState;

constexpr SurfaceState k_unchanged{1, {}};

Terrain hills(double relief_m, uint32_t seed) {
  TerrainOptions options;
  options.relief_m = relief_m;
  options.seed = seed;
  return make_terrain(options);
}

RoamEngine make_engine(const sward::Surface& surface, uint32_t budget) {
  sward::RoamOptions options;
  options.max_triangles = budget;
  return RoamEngine(surface, options);
}

// Along a curve over the field, turning; every fifth leg stands still for some frames.
View flight_view(const sward::HeightField& field, int frame, double above = 4) {
  const int moved = frame - frame / 10 * 3 - std::min(frame % 10, 3);
  const double t = 0.02 * moved;
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  const glm::dvec2 xy = low + size * (0.5 + 0.4 * glm::dvec2(std::cos(t), std::sin(1.7 * t)));
  return View::look({xy, field.height(xy) + above}, 1.3 * t, -0.2, 0.9, {1280, 720}, 0.2, 1e4);
}

// Ids, corners, static areas, surface trees and their order bit for bit; distances and projected areas, which the one
// computes in single precision, closely.
void expect_same(const fixed_level_reference::PlainTriangles& plain, const FixedTriangles& coherent, const View& view) {
  ASSERT_EQ(plain.triangles.size(), coherent.size());
  ASSERT_EQ(plain.surface.size(), coherent.nodes().size());
  ASSERT_EQ(plain.surface_z, coherent.surface_z());
  const glm::dmat4 clip = glm::transpose(view.clip_from_relative());
  const glm::dvec3 x = glm::dvec3(clip[0]) * (double(view.viewport.x) / view.viewport.y), y(clip[1]), w_row(clip[3]);
  const double determinant = std::abs(glm::dot(x, glm::cross(y, w_row)));
  const double shift = std::abs(clip[3].w) * glm::length(glm::cross(x, y));
  const auto w_of = [&](glm::dvec3 p) { return glm::dot(w_row, p) + clip[3].w; };
  for (size_t i = 0; i < coherent.size(); ++i) {
    const FixedTriangle a = plain.triangles[i], b = coherent[i];
    ASSERT_EQ(a.id.bits, b.id.bits) << i;
    ASSERT_EQ(a.apex, b.apex);
    ASSERT_EQ(a.to_left, b.to_left);
    ASSERT_EQ(a.to_right, b.to_right);
    ASSERT_EQ(a.area, b.area);
    ASSERT_EQ(a.surface, b.surface);
    ASSERT_NEAR(a.distance, b.distance, 2e-6 * double(a.distance) + 2e-5);
    ASSERT_EQ(std::isinf(a.screen_area), std::isinf(b.screen_area)) << i;
    if (std::isinf(a.screen_area)) continue;
    // Seen edge-on, an area is a small difference of large products: allow a share of what it would be face-on.
    double w = 1;
    for (const glm::vec3 to : {glm::vec3(0), a.to_left, a.to_right}) w *= w_of(a.apex + glm::dvec3(to) - view.eye);
    const double normal = glm::length(glm::cross(glm::dvec3(a.to_left), glm::dvec3(a.to_right)));
    const double face_on = 0.5 * normal * (determinant * glm::distance(a.apex, view.eye) + shift) / w;
    ASSERT_NEAR(a.screen_area, b.screen_area, 1e-5 * face_on + 1e-4 * double(a.screen_area));
  }
  for (size_t i = 1; i < plain.surface.size(); ++i) {
    ASSERT_EQ(plain.surface[i].z, coherent.nodes()[i].z);
    ASSERT_EQ(plain.surface[i].child[0], coherent.nodes()[i].child[0]);
    ASSERT_EQ(plain.surface[i].child[1], coherent.nodes()[i].child[1]);
  }
}

// One mesh, one object of triangles, compared after every update.
struct Pair {
  const RoamEngine& engine;
  FixedTriangles coherent;
  fixed_level_reference::PlainTriangles plain;

  void compare(const View& view, const FixedLevelOptions& options, const SurfaceState& state = k_unchanged) {
    fixed_level_reference::collect(engine.tree(), view, options, plain);
    sward::roam::collect_fixed_level(engine.tree(), view, options, state, coherent);
    expect_same(plain, coherent, view);
  }
};

TEST(CoherentFixedLevel, IsTheRebuiltSetAlongAFlight) {
  for (const bool detail : {false, true}) {
    TerrainOptions made;
    made.detail = detail;
    if (!detail) made.rows = 50;  // padding in the south
    made.origin = {6.0e6 + 0.1, -8.0e6, 500};
    const Terrain terrain = make_terrain(made);
    const sward::FieldSurface surface(*terrain.bounds);
    // Levels that the mesh is finer than, coarser than, and both.
    for (const int level : {3, 9, 13, 16}) {
      RoamEngine engine = make_engine(surface, 800);
      Pair pair{engine, {}, {}};
      size_t most = 0;
      for (int frame = 0; frame < 40; ++frame) {
        const View view = flight_view(*terrain.field, frame);
        ASSERT_TRUE(engine.update(view).has_value());
        pair.compare(view, {level, 200, 1, true, 1});
        if (HasFatalFailure()) FAIL() << "level " << level << " frame " << frame;
        most = std::max(most, pair.coherent.size());
      }
      EXPECT_GT(most, level < 9 ? 1u : 20u) << level;
    }
  }
}

TEST(CoherentFixedLevel, IsTheRebuiltSetFromAnywhere) {
  TerrainOptions made;
  made.holes.assign(65 * 65, 0);
  for (int row = 10; row <= 30; ++row)
    for (int column = 20; column <= 40; ++column) made.holes[size_t(row * 65 + column)] = 1;
  const Terrain terrain = make_terrain(made);
  const sward::FieldSurface surface(*terrain.bounds);
  RoamEngine engine = make_engine(surface, 600);
  Pair pair{engine, {}, {}};
  Random random(11);
  size_t total = 0;
  for (int i = 0; i < 300; ++i) {
    const View view = roam_support::random_view(*terrain.field, random);
    ASSERT_TRUE(engine.update(view).has_value());
    FixedLevelOptions options{int(6 + random.below(9)), float(random.uniform(20, 900)), float(random.uniform(0, 3)),
                              random.below(3) != 0, 1};
    if (random.below(2) == 0) options.spread_m = float(random.uniform(0, 60));
    pair.compare(view, options);
    if (HasFatalFailure()) FAIL() << "view " << i;
    total += pair.coherent.size();
  }
  EXPECT_GT(total, 20000u);
}

TEST(CoherentFixedLevel, SurvivesMissedFramesAndOtherMeshes) {
  const Terrain first = make_terrain({}), second = hills(40, 9);
  const sward::FieldSurface surfaces[2] = {sward::FieldSurface(*first.bounds), sward::FieldSurface(*second.bounds)};
  RoamEngine engines[2] = {make_engine(surfaces[0], 900), make_engine(surfaces[1], 900)};
  FixedTriangles coherent;
  fixed_level_reference::PlainTriangles plain;
  const FixedLevelOptions options{13, 200, 1, true, 1};
  for (int frame = 0; frame < 120; ++frame) {
    const size_t which = size_t(frame / 40) % 2;
    const View view = flight_view(*first.field, frame, 20);
    ASSERT_TRUE(engines[which].update(view).has_value());
    if (frame % 7 != 0) continue;
    fixed_level_reference::collect(engines[which].tree(), view, options, plain);
    sward::roam::collect_fixed_level(engines[which].tree(), view, options, {(which + 1) << 40, {}}, coherent);
    expect_same(plain, coherent, view);
    if (HasFatalFailure()) FAIL() << "frame " << frame;
  }
}

TEST(CoherentFixedLevel, StillViewLeavesTheTrianglesAlone) {
  const Terrain terrain = make_terrain({});
  const sward::FieldSurface surface(*terrain.bounds);
  RoamEngine engine = make_engine(surface, 40);
  Pair pair{engine, {}, {}};
  const View view = flight_view(*terrain.field, 0);
  ASSERT_TRUE(engine.update(view).has_value());
  const FixedLevelOptions options{13, 200, 1, true, 1};
  pair.compare(view, options);
  const uint64_t before = pair.coherent.contents();
  pair.compare(view, options);
  EXPECT_EQ(pair.coherent.contents(), before);
  // Whoever writes into the triangles gets them back.
  ASSERT_FALSE(pair.coherent.empty());
  pair.coherent.set(0, FixedTriangle{});
  pair.compare(view, options);
  EXPECT_NE(pair.coherent.contents(), before);
  // A finer mesh under the same view.
  const uint64_t coarse = pair.coherent.contents();
  sward::RoamOptions finer;
  finer.max_triangles = 3000;
  ASSERT_TRUE(engine.set_options(finer).has_value());
  ASSERT_TRUE(engine.update(view).has_value());
  pair.compare(view, options);
  EXPECT_NE(pair.coherent.contents(), coarse);
}

// A flat surface whose slope, as density sees it, can be changed.
class SlopedSurface final : public sward::Surface {
 public:
  explicit SlopedSurface(const sward::Bounds& bounds) : flat_(bounds) {}
  const sward::Lattice& lattice() const override { return flat_.lattice(); }
  double height(sward::LatticePoint p) const override { return flat_.height(p); }
  glm::dvec2 relief_gradient(sward::LatticePoint p) const override { return flat_.relief_gradient(p); }
  float bound(sward::LatticePoint centre, int level) const override { return flat_.bound(centre, level); }
  bool can_split(sward::LatticePoint centre, int level) const override { return flat_.can_split(centre, level); }
  glm::dvec2 data_gradient(glm::dvec2 xy) const override {
    return xy.x < 0 ? glm::dvec2(west, 0) : glm::dvec2(east, 0);
  }
  bool all_holes(const LatticeBox& box) const override { return flat_.all_holes(box); }
  double height(glm::dvec2 xy) const override { return flat_.height(xy); }
  glm::dvec2 height_range() const override { return flat_.height_range(); }
  double west = 0, east = 0;

 private:
  sward::FieldSurface flat_;
};

TEST(CoherentFixedLevel, FollowsStaticDataByTheirEpoch) {
  const Terrain terrain = hills(2, 1);
  SlopedSurface surface(*terrain.bounds);
  RoamEngine engine = make_engine(surface, 400);
  Pair pair{engine, {}, {}};
  const View view = View::look({0, 0, 80}, 0.3, -1.5, 1.2, {800, 800}, 1, 1e4);
  ASSERT_TRUE(engine.update(view).has_value());
  const FixedLevelOptions options{13, 300, 1, false, 1};
  pair.compare(view, options, {7, {}});
  // In the west alone, and told so.
  surface.west = 2;
  const int middle = sward::k_root_side / 2;
  const LatticeBox west{{0, 0}, {middle, sward::k_root_side}};
  const LatticeBox east{{middle, 0}, {2 * sward::k_root_side, sward::k_root_side}};
  const LatticeBox corner{{0, 0}, {1, 1}};
  const std::array told{west, east, corner};
  pair.compare(view, options, {8, {told.data(), 1}});
  // Both halves, two changes at once; then the eastern alone, though older changes are told, too.
  surface.west = surface.east = 2.5;
  pair.compare(view, options, {10, {told.data(), 2}});
  surface.east = 2.75;
  pair.compare(view, options, {11, {told.data(), 2}});
  // Everywhere, more changes than are told.
  surface.west = surface.east = 3;
  pair.compare(view, options, {13, {&corner, 1}});
  // Not known.
  surface.east = 1;
  pair.compare(view, options, {});
  surface.east = 4;
  pair.compare(view, options, {1, {&corner, 1}});
  // What is not told of is not seen.
  surface.west = 9;
  sward::roam::collect_fixed_level(engine.tree(), view, options, {1, {}}, pair.coherent);
  fixed_level_reference::collect(engine.tree(), view, options, pair.plain);
  EXPECT_NE(pair.coherent.area()[0] + pair.coherent.area()[pair.coherent.size() - 1],
            pair.plain.triangles.front().area + pair.plain.triangles.back().area);
}

TEST(CoherentFixedLevel, IsTheSameForAnyNumberOfThreads) {
  const Terrain terrain = make_terrain({});
  const sward::FieldSurface surface(*terrain.bounds);
  RoamEngine engine = make_engine(surface, 2000);
  const std::array<int, 4> threads{1, 2, 3, 7};
  std::array<FixedTriangles, 4> sets;
  size_t most = 0;
  for (int frame = 0; frame < 6; ++frame) {
    const View view = flight_view(*terrain.field, frame, 30);
    ASSERT_TRUE(engine.update(view).has_value());
    for (size_t i = 0; i < sets.size(); ++i)
      sward::roam::collect_fixed_level(engine.tree(), view, {24, 600, 1, true, threads[i]}, k_unchanged, sets[i]);
    most = std::max(most, sets[0].size());
    for (size_t i = 1; i < sets.size(); ++i) {
      ASSERT_EQ(sets[i].size(), sets[0].size());
      ASSERT_EQ(sets[i].nodes().size(), sets[0].nodes().size());
      for (size_t k = 0; k < sets[0].size(); ++k) {
        const FixedTriangle a = sets[0][k], b = sets[i][k];
        ASSERT_TRUE(a.id == b.id && a.apex == b.apex && a.surface == b.surface && a.area == b.area);
        ASSERT_TRUE(a.distance == b.distance && a.screen_area == b.screen_area);
      }
    }
  }
  EXPECT_GT(most, 43000u);  // enough for seven threads
}

TEST(CoherentFixedLevel, SteadyFramesAllocateNothing) {
  const Terrain terrain = make_terrain({});
  const sward::FieldSurface surface(*terrain.bounds);
  RoamEngine engine = make_engine(surface, 800);
  FixedTriangles triangles;
  // Two views in turn: everything is measured anew, nothing is new.
  const View views[2] = {flight_view(*terrain.field, 0), flight_view(*terrain.field, 10)};
  ASSERT_TRUE(engine.update(views[0]).has_value());
  const FixedLevelOptions options{13, 200, 1, true, 1};
  for (int i = 0; i < 4; ++i)
    sward::roam::collect_fixed_level(engine.tree(), views[i % 2], options, k_unchanged, triangles);
  const long before = g_allocations;
  ASSERT_GT(before, 0);
  for (int i = 0; i < 6; ++i)
    sward::roam::collect_fixed_level(engine.tree(), views[i % 2], options, k_unchanged, triangles);
  EXPECT_EQ(g_allocations, before);
}

TEST(FixedTriangles, AreColumnsThatKeepTheirMemory) {
  FixedTriangles all;
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(all.nodes().size(), 1u);
  FixedTriangle t;
  t.apex = {1, 2, 3};
  t.to_left = {4, 5, 6};
  t.to_right = {7, 8, 9};
  t.id.bits = 10;
  t.surface = all.add_node({11, {0, 0}, 0});
  t.area = 12;
  t.screen_area = 13;
  t.distance = 14;
  all.push_back({});
  all.push_back(t);
  ASSERT_EQ(all.size(), 2u);
  const FixedTriangle back = all[1];
  EXPECT_TRUE(back.apex == t.apex && back.to_left == t.to_left && back.to_right == t.to_right && back.id == t.id);
  EXPECT_TRUE(back.surface == 1 && back.area == 12 && back.screen_area == 13 && back.distance == 14);
  EXPECT_EQ(all.nodes()[1].z, 11);
  const FixedTriangles copy = all;
  EXPECT_EQ(copy[1].distance, 14);
  const FixedTriangles moved = std::move(all);
  EXPECT_EQ(moved.size(), 2u);
  EXPECT_TRUE(all.empty());  // NOLINT: what is left of it is defined
  all.push_back(t);
  EXPECT_EQ(all.nodes().size(), 1u);
  EXPECT_EQ(all[0].distance, 14);
  const auto address = static_cast<const void*>(all.id().data());
  all.clear();
  EXPECT_TRUE(all.empty());
  all.push_back(t);
  EXPECT_EQ(static_cast<const void*>(all.id().data()), address);
}

TEST(WorkerPool, CallsEveryPartOnce) {
  sward::WorkerPool pool;
  for (int round = 0; round < 200; ++round) {
    const int parts = 1 + round % 5;
    std::array<int, 5> calls{};
    pool.run(parts, [&](int part) { ++calls[size_t(part)]; });
    for (int part = 0; part < 5; ++part) ASSERT_EQ(calls[size_t(part)], part < parts ? 1 : 0);
  }
}

}  // namespace
