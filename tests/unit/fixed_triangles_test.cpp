// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "../../terrain/src/terrain/roam_engine.h"
#include "roam_reference.h"
#include "roam_support.h"

namespace {

using roam_support::make_terrain;
using roam_support::Random;
using roam_support::Terrain;
using roam_support::TerrainOptions;
using sward::FixedLevelOptions;
using sward::FixedTriangle;
using sward::FixedTriangles;
using sward::LatticePoint;
using sward::RoamMesh;
using sward::RoamOptions;
using sward::TriangleId;
using sward::View;

constexpr double k_pi = 3.14159265358979323846;

RoamMesh make_mesh(const Terrain& terrain, uint32_t budget) {
  RoamOptions options;
  options.max_triangles = budget;
  return std::move(*RoamMesh::create(*terrain.bounds, options));
}

FixedTriangles collect(const RoamMesh& mesh, const FixedLevelOptions& options) {
  FixedTriangles out;
  mesh.fixed_level_triangles(options, out);
  return out;
}

std::vector<FixedTriangle> listed(const FixedTriangles& triangles) {
  std::vector<FixedTriangle> list;
  for (size_t i = 0; i < triangles.size(); ++i) list.push_back(triangles[i]);
  return list;
}

// Gentle hills.
Terrain gentle_terrain() {
  TerrainOptions options;
  options.relief_m = 8;
  return make_terrain(options);
}

View low_view(const sward::HeightField& field, double t, double above = 2) {
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  const glm::dvec2 xy = low + size * (0.5 + 0.3 * glm::dvec2(std::cos(t), std::sin(1.7 * t)));
  return View::look({xy, field.height(xy) + above}, 2.1 * t, -0.15, 0.9, {1280, 720}, 0.1, 1e4);
}

// A field of heights a + b x + c y (metres, world).
Terrain plane_terrain(double a, double b, double c) {
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = 33;
  desc.spacing = {10, 10};
  desc.relief.enabled = false;
  std::vector<float> samples;
  for (int row = 0; row < 33; ++row)
    for (int column = 0; column < 33; ++column)
      samples.push_back(float(a + b * (column - 16) * 10.0 + c * (16 - row) * 10.0));
  Terrain terrain;
  terrain.field = std::make_unique<sward::HeightField>(sward::HeightField::create(desc, std::move(samples)).value());
  terrain.bounds = std::make_unique<sward::Bounds>(sward::Bounds::create(*terrain.field));
  return terrain;
}

// Weights of left and right at a point.
glm::dvec2 weights(const FixedTriangle& t, glm::dvec2 xy) {
  const glm::dvec2 l(t.to_left), r(t.to_right), q = xy - glm::dvec2(t.apex);
  const double area = l.x * r.y - l.y * r.x;
  return {(q.x * r.y - q.y * r.x) / area, (l.x * q.y - l.y * q.x) / area};
}

// Interpolates between three corners, or steps into the half that holds the point: child 0 is (m, apex, left), child 1
// (m, right, apex).
double surface_z(const FixedTriangles& all, const FixedTriangle& t, glm::dvec2 w) {
  double apex = t.apex.z, left = apex + t.to_left.z, right = apex + t.to_right.z;
  double wl = w.x, wr = w.y;
  for (uint32_t node = t.surface; node != 0;) {
    const double wa = 1 - wl - wr, middle = all.surface_z() + all.nodes()[node].z;
    const int turn = wl >= wr ? 0 : 1;
    const double new_left = turn == 0 ? apex : right, new_right = turn == 0 ? left : apex;
    const double left_weight = turn == 0 ? wa : wr - wl, right_weight = turn == 0 ? wl - wr : wa;
    apex = middle;
    left = new_left;
    right = new_right;
    wl = left_weight;
    wr = right_weight;
    node = all.nodes()[node].child[turn];
  }
  return apex * (1 - wl - wr) + left * wl + right * wr;
}

double mesh_z(const RoamMesh& mesh, const std::vector<uint32_t>& indices, glm::dvec2 p) {
  for (size_t i = 0; i < indices.size(); i += 3) {
    FixedTriangle leaf;
    leaf.apex = mesh.vertex_world(indices[i]);
    const glm::dvec3 l = mesh.vertex_world(indices[i + 1]) - leaf.apex;
    const glm::dvec3 r = mesh.vertex_world(indices[i + 2]) - leaf.apex;
    leaf.to_left = l;
    leaf.to_right = r;
    const glm::dvec2 w = weights(leaf, p);
    if (w.x >= -1e-9 && w.y >= -1e-9 && w.x + w.y <= 1 + 1e-9) return leaf.apex.z + w.x * l.z + w.y * r.z;
  }
  return std::nan("");
}

bool in_frustum(const View& view, glm::dvec3 world) {
  const glm::dvec4 c = view.clip_from_relative() * glm::dvec4(world - view.eye, 1);
  return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && std::abs(c.z) <= c.w;
}

TEST(TriangleId, HasItsBitsWhereTheFormatSays) {
  const TriangleId root = TriangleId::root(1, {-3, 5});
  EXPECT_EQ(root.bits, uint64_t(1) << 57 | uint64_t(1021) << 46 | uint64_t(1029) << 35);
  const TriangleId id = root.child(1).child(0).child(1);
  EXPECT_EQ(id.bits, root.bits | uint64_t(3) << 58 | uint64_t(1) << 34 | uint64_t(1) << 32);
  EXPECT_EQ(id.level(), 3);
  EXPECT_EQ(id.root(), 1);
  EXPECT_EQ(id.square(), glm::ivec2(-3, 5));
  EXPECT_EQ(uint64_t(id.high()) << 32 | id.low(), id.bits);
  TriangleId deep = TriangleId::root(0, {0, 0});
  for (int i = 0; i < sward::k_max_level; ++i) deep = deep.child(1);
  EXPECT_EQ(deep.bits & 0x7ffffffffull, 0x7ffffffffull);
  EXPECT_EQ(deep.square(), glm::ivec2(0, 0));
}

TEST(TriangleId, LeadsToCornersByTheDefinition) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const glm::ivec2 square(int(random.below(2048)) - 1024, int(random.below(2048)) - 1024);
    const int root = int(random.below(2));
    const LatticePoint nw = square * sward::k_root_side, se = nw + sward::k_root_side;
    const LatticePoint ne(se.x, nw.y), sw(nw.x, se.y);
    roam_reference::Triangle t =
        root == 0 ? roam_reference::Triangle{nw, sw, ne, 0} : roam_reference::Triangle{se, ne, sw, 0};
    TriangleId id = TriangleId::root(root, square);
    for (int depth = int(random.below(36)); depth > 0; --depth) {
      const int turn = int(random.below(2));
      t = t.child(turn);
      id = id.child(turn);
    }
    const sward::TriangleCorners c = sward::corners_of(id);
    ASSERT_TRUE(c.apex == t.apex && c.left == t.left && c.right == t.right);
    // Counter-clockwise from above; the lattice's y runs south.
    const glm::i64vec2 l(t.left - t.apex), r(t.right - t.apex);
    ASSERT_LT(l.x * r.y - l.y * r.x, 0);
  }
}

TEST(TriangleId, OfTheMeshLeadsToTheMeshsCorners) {
  const Terrain terrain = gentle_terrain();
  RoamOptions options;
  options.max_triangles = 500;
  const sward::FieldSurface surface(*terrain.bounds);
  sward::roam::RoamEngine engine(surface, options);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(engine.update(low_view(*terrain.field, i)).has_value());
    const sward::roam::RoamTree& tree = engine.tree();
    std::set<uint64_t> ids;
    for (uint32_t node = 0; node < tree.size(); ++node) {
      if (!tree.is_alive(node)) continue;
      const sward::TriangleCorners c = sward::corners_of(tree.nodes[node].id);
      const sward::roam::Corners slots = tree.corner[node];
      ASSERT_EQ(tree.vertices.points[slots.apex].world,
                glm::dvec3(terrain.field->world_xy(c.apex), terrain.field->height(c.apex)));
      ASSERT_EQ(tree.vertices.lattice[slots.left], c.left);
      ASSERT_EQ(tree.vertices.lattice[slots.right], c.right);
      ASSERT_TRUE(ids.insert(tree.nodes[node].id.bits).second);
    }
  }
}

TEST(LevelForArea, IsTheNearestByRatio) {
  const Terrain terrain = gentle_terrain();  // 640 m x 640 m in one root square: roots of 204800 square metres
  EXPECT_EQ(sward::level_for_area(*terrain.field, 204800), 0);
  EXPECT_EQ(sward::level_for_area(*terrain.field, 204800 / 1.41), 0);
  EXPECT_EQ(sward::level_for_area(*terrain.field, 204800 / 1.42), 1);
  EXPECT_EQ(sward::level_for_area(*terrain.field, 1.6), 17);
  EXPECT_EQ(sward::level_for_area(*terrain.field, 1e9), 0);
  EXPECT_EQ(sward::level_for_area(*terrain.field, 1e-9), sward::k_max_level);
}

TEST(FixedLevel, IsEmptyBeforeTheFirstUpdate) {
  const Terrain terrain = gentle_terrain();
  FixedTriangles out;
  for (int i = 0; i < 3; ++i) out.push_back({});
  make_mesh(terrain, 100).fixed_level_triangles({}, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(out.nodes().size(), 1u);
}

TEST(FixedLevel, CornersAreThoseOfTheIdExactly) {
  for (const glm::dvec3 origin : {glm::dvec3(0), glm::dvec3(6.0e6 + 0.1, -8.0e6, 500)}) {
    TerrainOptions options;
    options.origin = origin;
    const Terrain terrain = make_terrain(options);
    RoamMesh mesh = make_mesh(terrain, 400);
    ASSERT_TRUE(mesh.update(low_view(*terrain.field, 1)).has_value());
    const FixedTriangles out = collect(mesh, {16, 200, 1, true});
    ASSERT_GT(out.size(), 200u);
    std::set<uint64_t> ids;
    for (const FixedTriangle& t : listed(out)) {
      ASSERT_EQ(t.id.level(), 16);
      ASSERT_TRUE(ids.insert(t.id.bits).second);
      const sward::TriangleCorners c = sward::corners_of(t.id);
      const glm::dvec2 apex = terrain.field->world_xy(c.apex);
      ASSERT_EQ(glm::dvec2(t.apex), apex);
      ASSERT_EQ(glm::vec2(t.to_left), glm::vec2(terrain.field->world_xy(c.left) - apex));
      ASSERT_EQ(glm::vec2(t.to_right), glm::vec2(terrain.field->world_xy(c.right) - apex));
    }
  }
}

// Above the level the leaf is split flat, below it the surface tree leads to the leaf.
TEST(FixedLevel, SurfaceIsTheDrawnMesh) {
  const Terrain terrain = make_terrain({});
  Random random(8);
  bool deep = false, flat = false;
  for (const uint32_t budget : {60u, 3000u}) {
    for (const int level : {4, 9, 15}) {
      RoamMesh mesh = make_mesh(terrain, budget);
      ASSERT_TRUE(mesh.update(low_view(*terrain.field, 3, 30)).has_value());
      const std::vector<uint32_t> leaves = mesh.all_indices();
      const FixedTriangles out = collect(mesh, {level, 500, 1, false});
      ASSERT_FALSE(out.empty());
      for (int i = 0; i < 400; ++i) {
        const FixedTriangle t = out[random.below(uint32_t(out.size()))];
        glm::dvec2 w(random.uniform(0, 1), random.uniform(0, 1));
        if (w.x + w.y > 1) w = 1.0 - w;
        const glm::dvec2 xy = glm::dvec2(t.apex) + w.x * glm::dvec2(t.to_left) + w.y * glm::dvec2(t.to_right);
        ASSERT_NEAR(surface_z(out, t, w), mesh_z(mesh, leaves, xy), 1e-3);
        deep |= t.surface != 0 && out.nodes()[t.surface].child[0] != 0;
        flat |= t.surface == 0;
      }
    }
  }
  EXPECT_TRUE(deep && flat);
}

TEST(FixedLevel, CoversTheGroundInSight) {
  const Terrain terrain = make_terrain({});
  Random random(9);
  int points = 0;
  for (int i = 0; i < 12; ++i) {
    RoamMesh mesh = make_mesh(terrain, 50 + 150 * uint32_t(i));
    const View view = low_view(*terrain.field, i, 3 + 4 * i);
    ASSERT_TRUE(mesh.update(view).has_value());
    const std::vector<uint32_t> leaves = mesh.all_indices();
    const FixedLevelOptions options{12, 250, 2, false};
    const std::vector<FixedTriangle> triangles = listed(collect(mesh, options));
    for (int k = 0; k < 300; ++k) {
      const double azimuth = random.uniform(-k_pi, k_pi), distance = random.uniform(0, 250);
      const glm::dvec2 xy = glm::dvec2(view.eye) + distance * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
      const glm::dvec3 ground(xy, mesh_z(mesh, leaves, xy));
      if (std::isnan(ground.z) || glm::distance(ground, view.eye) > 249.99) continue;
      // Ground or the tip of what may stand there.
      if (!in_frustum(view, ground) && !in_frustum(view, ground + glm::dvec3(0, 0, 1.99))) continue;
      ++points;
      const bool covered = std::any_of(triangles.begin(), triangles.end(), [&](const FixedTriangle& t) {
        const glm::dvec2 w = weights(t, xy);
        return w.x >= -1e-6 && w.y >= -1e-6 && w.x + w.y <= 1 + 1e-6;
      });
      ASSERT_TRUE(covered) << "view " << i;
    }
  }
  EXPECT_GT(points, 200);
}

TEST(FixedLevel, EmitsOnlyWhatMayBeSeen) {
  const Terrain terrain = make_terrain({});
  for (int i = 0; i < 10; ++i) {
    RoamMesh mesh = make_mesh(terrain, 300);
    const View view = low_view(*terrain.field, i, 10);
    ASSERT_TRUE(mesh.update(view).has_value());
    const auto planes = sward::frustum_planes(view);
    for (const FixedTriangle& t : listed(collect(mesh, {14, 150, 1, true}))) {
      ASSERT_LE(t.distance, 150);
      if (t.surface != 0) continue;
      for (const sward::Plane& plane : planes) {
        double most = -1;
        for (const glm::vec3 to : {glm::vec3(0), t.to_left, t.to_right}) {
          const glm::dvec3 p = t.apex + glm::dvec3(to) - view.eye;
          most = std::max({most, glm::dot(plane.n, p) + plane.d, glm::dot(plane.n, p + glm::dvec3(0, 0, 1)) + plane.d});
        }
        ASSERT_GE(most, -1e-4);
      }
    }
  }
}

// What is in sight at every height that the surface may have is there whatever the mesh is, bit for bit.
// A triangle belongs to a picture as soon as a point no farther than the spread from one of its own is in it.
TEST(FixedLevel, SpreadReachesBesideThePicture) {
  const Terrain terrain = plane_terrain(0, 0, 0);
  RoamMesh mesh = make_mesh(terrain, 500);
  const View view = low_view(*terrain.field, 0.4);
  ASSERT_TRUE(mesh.update(view));
  FixedLevelOptions options{9, 120, 0, true, 1};
  std::set<uint64_t> narrow;
  for (const FixedTriangle& t : listed(collect(mesh, options))) narrow.insert(t.id.bits);
  options.spread_m = 12;
  size_t beside = 0;
  std::set<uint64_t> wide;
  for (const FixedTriangle& t : listed(collect(mesh, options))) wide.insert(t.id.bits);
  options.spread_m = 300;
  const glm::dmat4 clip = view.clip_from_relative();
  const auto seen = [&](glm::dvec3 p) {
    const glm::dvec4 at = clip * glm::dvec4(p - view.eye, 1);
    return at.w > 0.2 && std::abs(at.x) < at.w && std::abs(at.y) < at.w;
  };
  for (const FixedTriangle& t : listed(collect(mesh, options))) {
    // Points around the corners, as far as the spread.
    bool reaches = false;
    const glm::dvec3 left = t.apex + glm::dvec3(t.to_left), right = t.apex + glm::dvec3(t.to_right);
    for (const glm::dvec3 corner : {t.apex, left, right})
      for (int i = 0; i < 64; ++i)
        for (const double r : {4.0, 8.0, 11.9})
          reaches = reaches || seen(corner + r * glm::dvec3(std::cos(i * k_pi / 32), std::sin(i * k_pi / 32), 0));
    if (!reaches) continue;
    EXPECT_TRUE(wide.contains(t.id.bits));
    beside += !narrow.contains(t.id.bits);
  }
  EXPECT_GT(beside, 20u);
  for (const uint64_t id : narrow) EXPECT_TRUE(wide.contains(id));
  // No more than is needed: the whole ground within the horizon would be several times as much.
  EXPECT_LT(wide.size(), 2 * narrow.size());
}

TEST(FixedLevel, SetDoesNotDependOnTheMesh) {
  const Terrain terrain = gentle_terrain();
  const sward::HeightField& field = *terrain.field;
  const double slack = terrain.bounds->bound(LatticePoint(sward::k_root_side / 2), 0) + 0.01;
  int robust = 0;
  for (int i = 0; i < 6; ++i) {
    View view = low_view(field, i, 60);
    view.eye_from_world = View::look({}, i, -0.7, 1, {1, 1}, 1, 2).eye_from_world;
    std::vector<std::map<uint64_t, FixedTriangle>> sets;
    for (const uint32_t budget : {2u, 60u, 900u, 20000u}) {
      RoamMesh mesh = make_mesh(terrain, budget);
      ASSERT_TRUE(mesh.update(view).has_value());
      sets.emplace_back();
      for (const FixedTriangle& t : listed(collect(mesh, {15, 300, 1, false}))) sets.back()[t.id.bits] = t;
    }
    for (const auto& all : sets) {
      for (const auto& [id, t] : all) {
        const glm::dvec2 xy = glm::dvec2(t.apex) + glm::dvec2(t.to_left + t.to_right) / 3.0;
        const glm::dvec3 low(xy, field.height(xy) - slack), high(xy, field.height(xy) + slack);
        if (!in_frustum(view, low) || !in_frustum(view, high)) continue;
        if (std::max(glm::distance(view.eye, low), glm::distance(view.eye, high)) > 299) continue;
        ++robust;
        for (const auto& other : sets) {
          const auto found = other.find(id);
          ASSERT_NE(found, other.end());
          ASSERT_EQ(glm::dvec2(found->second.apex), glm::dvec2(t.apex));
          ASSERT_EQ(found->second.area, t.area);
        }
      }
    }
  }
  EXPECT_GT(robust, 1000);
}

TEST(FixedLevel, AreaIsTheHorizontalOneOverTheSlopesCosine) {
  const Terrain terrain = plane_terrain(3, 0.75, 0);
  RoamMesh mesh = make_mesh(terrain, 50);
  ASSERT_TRUE(mesh.update(low_view(*terrain.field, 0, 30)).has_value());
  const FixedTriangles out = collect(mesh, {11, 400, 1, false});
  ASSERT_FALSE(out.empty());
  // Roots of 320 m x 320 m / 2, halved 11 times; cosine 1 / 1.25.
  for (const FixedTriangle& t : listed(out)) ASSERT_NEAR(t.area, 51200.0 / 2048 * 1.25, 1e-4);
}

TEST(FixedLevel, ScreenAreaIsInHalfViewportHeightsSquared) {
  const Terrain terrain = plane_terrain(0, 0, 0);
  RoamMesh mesh = make_mesh(terrain, 50);
  // Straight down with 90 degrees: at 50 m, half the viewport's height is 50 m of ground.
  ASSERT_TRUE(mesh.update(View::look({1, 2, 50}, 0.3, -0.5 * k_pi, 0.5 * k_pi, {1600, 800}, 1, 1000)).has_value());
  FixedTriangles out = collect(mesh, {11, 400, 1, true});
  ASSERT_GT(out.size(), 100u);
  for (const FixedTriangle& t : listed(out)) ASSERT_NEAR(t.screen_area, 25.0 / 2500, 1e-6);
  // Level ahead from just above the ground: triangles with a corner behind the near plane have no area.
  ASSERT_TRUE(mesh.update(View::look({1, 2, 1}, 0, 0, 1.0, {1600, 800}, 4.5, 1000)).has_value());
  out = collect(mesh, {11, 400, 1, true});
  int infinite = 0;
  for (const FixedTriangle& t : listed(out)) {
    const double rear = std::min({t.apex.x, t.apex.x + t.to_left.x, t.apex.x + t.to_right.x});
    ASSERT_EQ(std::isinf(t.screen_area), rear < 5.5);
    infinite += std::isinf(t.screen_area);
  }
  EXPECT_GT(infinite, 0);
  EXPECT_LT(infinite, int(out.size()));
}

TEST(FixedLevel, DistanceIsThatOfTheNearestPoint) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, 300);
  const View view = low_view(*terrain.field, 2, 4);
  ASSERT_TRUE(mesh.update(view).has_value());
  const FixedTriangles out = collect(mesh, {12, 150, 1, false});
  ASSERT_GT(out.size(), 20u);
  constexpr int k_steps = 60;
  for (const FixedTriangle& t : listed(out)) {
    double nearest = 1e30;
    for (int i = 0; i <= k_steps; ++i) {
      for (int k = 0; i + k <= k_steps; ++k) {
        const glm::dvec3 p =
            t.apex + (double(i) / k_steps) * glm::dvec3(t.to_left) + (double(k) / k_steps) * glm::dvec3(t.to_right);
        nearest = std::min(nearest, glm::distance(p, view.eye));
      }
    }
    const double step = glm::length(t.to_left - t.to_right) / k_steps;
    ASSERT_LE(t.distance, nearest + 1e-4);
    ASSERT_GE(t.distance, nearest - step);
  }
}

TEST(FixedLevel, SkipsBackFacesBelowTheirCanopy) {
  const Terrain terrain = plane_terrain(0, 1, 0);  // rises east by 45 degrees
  RoamMesh mesh = make_mesh(terrain, 50);
  // The eye stands under the slope and looks west at it; the plane is 30 m above the eye, 21 m along its normal.
  ASSERT_TRUE(mesh.update(View::look({0, 0, -30}, k_pi, 0, 1.2, {800, 600}, 0.1, 1e4)).has_value());
  EXPECT_FALSE(collect(mesh, {11, 300, 1, false}).empty());
  EXPECT_TRUE(collect(mesh, {11, 300, 1, true}).empty());
  EXPECT_FALSE(collect(mesh, {11, 300, 25, true}).empty());
}

TEST(FixedLevel, LeavesOutHolesAndPadding) {
  TerrainOptions options;
  options.rows = 41;
  options.relief_m = 5;
  options.holes.assign(65 * 41, 0);
  // Samples 20..40 x 10..30 are missing.
  for (int row = 10; row <= 30; ++row)
    for (int column = 20; column <= 40; ++column) options.holes[size_t(row * 65 + column)] = 1;
  const Terrain terrain = make_terrain(options);
  const sward::HeightField& field = *terrain.field;
  RoamMesh mesh = make_mesh(terrain, 800);
  ASSERT_TRUE(mesh.update(View::look({0, 0, 900}, 0, -0.5 * k_pi, 1.2, {1000, 1000}, 1, 1e4)).has_value());
  const FixedTriangles out = collect(mesh, {sward::level_for_area(field, 12.5), 5000, 1, false});
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  double area = 0;
  for (const FixedTriangle& t : listed(out)) {
    const glm::dvec2 centre = glm::dvec2(t.apex) + glm::dvec2(t.to_left + t.to_right) / 3.0;
    ASSERT_TRUE(centre.x > low.x && centre.x < high.x && centre.y > low.y && centre.y < high.y);
    const glm::dvec2 place((centre.x - low.x) / 10, (high.y - centre.y) / 10);
    const bool in_hole = place.x > 20 && place.x < 40 && place.y > 10 && place.y < 30;
    ASSERT_FALSE(in_hole);
    area += 0.5 * std::abs(double(t.to_left.x) * t.to_right.y - double(t.to_left.y) * t.to_right.x);
  }
  EXPECT_NEAR(area, 640.0 * 400 - 200 * 200, 1);
}

}  // namespace
