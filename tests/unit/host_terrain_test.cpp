// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Triangles of a host's own terrain: heights through a callback.
#include <gtest/gtest.h>

#include <sward/terrain/terrain.h>
#include <sward/vegetation/plants.h>
#include <sward/vegetation/seeding.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

namespace {

using sward::FixedLevelOptions;
using sward::FixedTriangle;
using sward::FixedTriangles;
using sward::HostTerrain;
using sward::HostTerrainDesc;
using sward::View;

double hills(glm::dvec2 p) {
  return 20 * std::sin(p.x * 0.021) * std::cos(p.y * 0.017) + 0.4 * std::sin(p.x * 0.7 + p.y * 0.4);
}

double smooth_hills(glm::dvec2 p) {
  return 20 * std::sin(p.x * 0.021) * std::cos(p.y * 0.017);
}

// No multiple of anything, away from the origin.
HostTerrainDesc hill_box() {
  HostTerrainDesc desc;
  desc.low = {5000.3, -7000.1, -25};
  desc.high = {5613.8, -6777.4, 25};
  return desc;
}

HostTerrain make_hills(sward::HostHeight height = hills, HostTerrainDesc desc = hill_box()) {
  auto terrain = HostTerrain::create(std::move(height), desc);
  EXPECT_TRUE(terrain) << terrain.error().message;
  return std::move(*terrain);
}

View look(glm::dvec2 at, double above, double azimuth, double pitch = -0.2) {
  return View::look({at, hills(at) + above}, azimuth, pitch, 0.9, {640, 480}, 0.1, 1e4);
}

FixedLevelOptions cut_of(const HostTerrain& terrain, float area, float horizon) {
  FixedLevelOptions cut;
  cut.level = sward::level_for_area(terrain.lattice(), area);
  cut.horizon_m = horizon;
  return cut;
}

FixedTriangles triangles_of(const HostTerrain& terrain, const View& view, const FixedLevelOptions& cut) {
  FixedTriangles triangles;
  EXPECT_TRUE(terrain.fixed_level_triangles(view, cut, triangles));
  return triangles;
}

// From so high, through so long a lens, that everything is in the picture.
FixedTriangles all_of(const HostTerrain& terrain, float area, bool altitudes = false) {
  const sward::Lattice& lattice = terrain.lattice();
  const glm::dvec2 middle = 0.5 * (lattice.min_corner() + lattice.max_corner());
  FixedLevelOptions cut = cut_of(terrain, area, 5000);
  cut.altitudes = altitudes;
  return triangles_of(terrain, View::look({middle, 2000}, 0, -1.57, 0.9, {640, 480}, 0.1, 1e4), cut);
}

double area_on_map(const FixedTriangles& triangles) {
  double sum = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const glm::dvec2 l(triangles.to_left()[i]), r(triangles.to_right()[i]);
    sum += 0.5 * (l.x * r.y - l.y * r.x);
  }
  return sum;
}

using ById = std::map<uint64_t, FixedTriangle>;
ById by_id(const FixedTriangles& triangles) {
  ById named;
  for (size_t i = 0; i < triangles.size(); ++i) named[triangles.id()[i].bits] = triangles[i];
  EXPECT_EQ(named.size(), triangles.size()) << "ids name one triangle each";
  return named;
}

TEST(HostTerrain, FillsItsBoxExactly) {
  const FixedTriangles all = all_of(make_hills(), 4);
  const glm::dvec2 size = hill_box().high - hill_box().low;
  EXPECT_NEAR(area_on_map(all), size.x * size.y, 1e-5 * size.x * size.y);
  const double mean = size.x * size.y / double(all.size());
  EXPECT_GT(mean, 4 / 1.42);
  EXPECT_LT(mean, 4 * 1.42);
  for (size_t i = 0; i < all.size(); ++i) {
    const double ratio = double(glm::length(glm::vec2(all.to_left()[i])) / glm::length(glm::vec2(all.to_right()[i])));
    ASSERT_GT(ratio, 0.6) << "triangles are nearly as long as wide";
    ASSERT_LT(ratio, 1.7);
  }
}

TEST(HostTerrain, CornersStandAtTheHostsHeights) {
  FixedTriangles all = all_of(make_hills(), 4, true);
  for (size_t i = 0; i < all.size(); ++i) {
    const FixedTriangle t = all[i];
    const glm::dvec3 corners[3] = {t.apex, t.apex + glm::dvec3(t.to_left), t.apex + glm::dvec3(t.to_right)};
    ASSERT_EQ(corners[0].z, hills(corners[0]));
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(corners[c].z, hills(corners[c]), 2e-5);
      ASSERT_NEAR(t.altitude[c], hills(corners[c]), 2e-5);
    }
    ASSERT_NEAR(t.area, 0.5f * glm::length(glm::cross(t.to_left, t.to_right)), 1e-4f * t.area);
  }
}

// Whatever the view and whatever was in view before.
TEST(HostTerrain, TrianglesDoNotDependOnTheView) {
  const HostTerrain terrain = make_hills();
  const ById all = by_id(all_of(terrain, 1.6f));
  FixedTriangles kept;
  size_t seen = 0;
  for (int frame = 0; frame < 50; ++frame) {
    const View view = look({5300 + 2 * frame, -6900 + frame}, 1.7 + frame % 7, 0.2 * frame);
    const FixedLevelOptions cut = cut_of(terrain, 1.6f, 60);
    ASSERT_TRUE(terrain.fixed_level_triangles(view, cut, kept));
    const FixedTriangles fresh = triangles_of(terrain, view, cut);
    ASSERT_EQ(fresh.size(), kept.size());
    for (size_t i = 0; i < kept.size(); ++i) {
      const auto found = all.find(kept.id()[i].bits);
      ASSERT_NE(found, all.end());
      ASSERT_EQ(found->second.apex, kept.apex()[i]);
      ASSERT_EQ(found->second.to_left, kept.to_left()[i]);
      ASSERT_EQ(found->second.to_right, kept.to_right()[i]);
      ASSERT_EQ(found->second.area, kept.area()[i]);
      ASSERT_EQ(fresh.id()[i], kept.id()[i]);
    }
    seen += kept.size();
  }
  EXPECT_GT(seen, 5000u);
}

double signed_distance(const sward::Plane& plane, glm::dvec3 p) {
  return glm::dot(plane.n, p) + plane.d;
}

// What every corner shows to be in view is there, and nothing that is out. Returns how many are surely in view.
size_t expect_culled(const HostTerrain& terrain, const FixedTriangles& all, float area, const View& view) {
  FixedLevelOptions cut = cut_of(terrain, area, 80);
  cut.skip_back_faces = false;
  const ById visible = by_id(triangles_of(terrain, view, cut));
  const auto planes = sward::frustum_planes(view);
  size_t in_view = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const FixedTriangle t = all[i];
    bool inside = true, out = false;
    for (const sward::Plane& plane : planes) {
      bool any = false;
      for (const glm::vec3 to : {glm::vec3(0), t.to_left, t.to_right}) {
        const double d = signed_distance(plane, t.apex + glm::dvec3(to) - view.eye);
        inside &= d > 1e-3;
        any |= d > -3;  // the canopy, 1 m, and what the ground leaves the triangle
      }
      out |= !any;
    }
    const double nearest = glm::distance(t.apex, view.eye);
    inside &= nearest < 80;
    out |= nearest > 80 + std::sqrt(double(area)) * 3;
    in_view += inside;
    const bool there = visible.contains(t.id.bits);
    EXPECT_TRUE(there || !inside) << t.apex.x << " " << t.apex.y;
    EXPECT_FALSE(there && out) << t.apex.x << " " << t.apex.y;
  }
  return in_view;
}

TEST(HostTerrain, CullsByFrustumAndHorizon) {
  const HostTerrain terrain = make_hills();
  for (const float area : {1.6f, 30.0f}) {
    const FixedTriangles all = all_of(terrain, area);
    size_t in_view = 0;
    for (int i = 0; i < 4; ++i)
      in_view += expect_culled(terrain, all, area, look({5300 + 31 * i, -6900 + 17 * i}, 1 + 4 * i, 1.5 * i, -0.3 * i));
    EXPECT_GT(in_view, size_t(2000 / area));
  }
}

TEST(HostTerrain, LeavesOutWhatFacesAway) {
  const HostTerrain terrain = make_hills([](glm::dvec2 p) { return 2 * std::abs(p.x - 5300); });
  FixedLevelOptions cut = cut_of(terrain, 1.6f, 30);
  // On the eastern side of the valley turned upside down, close to the ground and looking up over the ridge.
  const View view = View::look({5310, -6900, 21.7}, 0, 0.5, 0.9, {640, 480}, 0.1, 1e4);
  const size_t facing = triangles_of(terrain, view, cut).size();
  EXPECT_GT(facing, 0u) << "ground that rises ahead faces the eye";
  const HostTerrain ridge = make_hills([](glm::dvec2 p) { return -2 * std::abs(p.x - 5300); });
  const View below = View::look({5310, -6900, -12}, glm::radians(180.0), -0.7, 0.9, {640, 480}, 0.1, 1e4);
  const FixedTriangles seen = triangles_of(ridge, below, cut);
  for (size_t i = 0; i < seen.size(); ++i) ASSERT_GT(seen.apex()[i].x, 5297) << "the far side of the ridge faces away";
  cut.skip_back_faces = false;
  EXPECT_GT(triangles_of(ridge, below, cut).size(), seen.size());
}

// z of the drawn surface at weights (left, right) of a triangle, by its splits.
double drawn_z(const FixedTriangles& triangles, size_t i, glm::dvec2 at) {
  const FixedTriangle t = triangles[i];
  glm::dvec2 corner[3] = {{0, 0}, {1, 0}, {0, 1}};
  double z[3] = {t.apex.z, t.apex.z + double(t.to_left.z), t.apex.z + double(t.to_right.z)};
  for (uint32_t node = t.surface; node != 0;) {
    const sward::SurfaceNode& split = triangles.nodes()[node];
    const glm::dvec2 m = 0.5 * (corner[1] + corner[2]), left = corner[1] - corner[2], to = at - m;
    const double middle = triangles.surface_z() + double(split.z);
    // Child 0 has the left corner.
    const glm::dvec2 axis = corner[0] - m;
    const double side = (axis.x * to.y - axis.y * to.x) * (axis.x * left.y - axis.y * left.x);
    const bool second = side < 0;
    const glm::dvec2 next[3] = {m, second ? corner[2] : corner[0], second ? corner[0] : corner[1]};
    const double next_z[3] = {middle, second ? z[2] : z[0], second ? z[0] : z[1]};
    std::copy(next, next + 3, corner);
    std::copy(next_z, next_z + 3, z);
    node = split.child[second];
  }
  const glm::dmat2 edges(corner[1] - corner[0], corner[2] - corner[0]);
  const glm::dvec2 w = glm::inverse(edges) * (at - corner[0]);
  return z[0] + w.x * (z[1] - z[0]) + w.y * (z[2] - z[0]);
}

double worst_foot(const HostTerrain& terrain, float area, double (*ground)(glm::dvec2)) {
  const FixedTriangles all = all_of(terrain, area);
  double worst = 0;
  for (size_t i = 0; i < all.size(); ++i)
    for (const glm::dvec2 at : {glm::dvec2(0.31, 0.22), {0.52, 0.41}, {0.1, 0.83}, {0.7, 0.05}}) {
      const glm::dvec3 t = all.apex()[i];
      const glm::dvec2 xy = glm::dvec2(t) + at.x * glm::dvec2(all.to_left()[i]) + at.y * glm::dvec2(all.to_right()[i]);
      worst = std::max(worst, std::abs(drawn_z(all, i, at) - ground(xy)));
    }
  return worst;
}

TEST(HostTerrain, FeetFollowTheGroundWithinTheirError) {
  HostTerrainDesc desc = hill_box();
  EXPECT_LT(worst_foot(make_hills(hills, desc), 30, hills), 3 * 0.02) << "shrubs";
  EXPECT_LT(worst_foot(make_hills(smooth_hills, desc), 1000, smooth_hills), 0.15) << "trees, heights 5.6 m apart";
  desc.foot_splits = 0;
  const HostTerrain flat = make_hills(hills, desc);
  EXPECT_EQ(all_of(flat, 30).nodes().size(), 1u);
  EXPECT_GT(worst_foot(flat, 30, hills), 0.2) << "flat triangles do not";
}

// Whether the ground of a triangle is seen anywhere, and whether its plane alone would not be.
struct Seen {
  bool ground, plane;
};
Seen seen(const FixedTriangles& all, size_t i, const View& view, double horizon) {
  const auto inside = [&, planes = sward::frustum_planes(view)](glm::dvec3 p) {
    const auto before = [&](const sward::Plane& plane) { return signed_distance(plane, p - view.eye) > 0.01; };
    return glm::distance(p, view.eye) < horizon && std::all_of(planes.begin(), planes.end(), before);
  };
  Seen result{false, false};
  for (double l = 0; l <= 1; l += 0.1)
    for (double r = 0; l + r <= 1; r += 0.1) {
      const glm::dvec3 flat = all.apex()[i] + l * glm::dvec3(all.to_left()[i]) + r * glm::dvec3(all.to_right()[i]);
      result.plane |= inside(flat);
      result.ground |= inside({flat.x, flat.y, drawn_z(all, i, {l, r})});
    }
  return result;
}

TEST(HostTerrain, KeepsTrianglesThatOnlyTheirGroundBringsIntoThePicture) {
  const auto bumps = [](glm::dvec2 p) { return 6 * std::sin(p.x * 0.35) * std::sin(p.y * 0.31); };
  const HostTerrain terrain = make_hills(bumps);
  FixedLevelOptions cut = cut_of(terrain, 300, 150);
  cut.canopy_m = 0;
  cut.skip_back_faces = false;
  const FixedTriangles all = all_of(terrain, 300);
  size_t by_ground = 0;
  for (int view_number = 0; view_number < 24; ++view_number) {
    const glm::dvec2 at(5040 + 23 * view_number, -6980 + 8 * view_number);
    const View view =
        View::look({at, 7}, 2.4 * view_number, 0.12 + 0.02 * (view_number % 8), 0.5, {640, 480}, 0.1, 1e4);
    const ById kept = by_id(triangles_of(terrain, view, cut));
    for (size_t i = 0; i < all.size(); ++i) {
      const Seen is = seen(all, i, view, 120);
      EXPECT_TRUE(kept.contains(all.id()[i].bits) || !is.ground) << "view " << view_number << ", triangle " << i;
      by_ground += is.ground && !is.plane;
    }
  }
  EXPECT_GT(by_ground, 20u);
}

TEST(HostTerrain, PlantsStandOnTheHostsGround) {
  const HostTerrain terrain = make_hills();
  sward::Species grass;
  grass.reference_hsv = {0.22f, 0.6f, 0.47f};
  sward::Layer layer;
  layer.species = {grass};
  layer.horizon_m = 30;
  const glm::dvec2 low(hill_box().low), size(hill_box().high - hill_box().low);
  const sward::ColorMap colors{1, 1, {{96, 120, 48, 255}}, low, size};
  const View view = look({5300, -6900}, 1.7, 2);
  const FixedTriangles triangles = triangles_of(terrain, view, cut_of(terrain, layer.triangle_area_m2, 30));
  sward::Seeding seeding;
  sward::seed(layer, view, colors, triangles, seeding);
  const std::vector<sward::Plant> plants = sward::grow_plants(layer, view, colors, triangles, seeding);
  ASSERT_GT(plants.size(), 10000u);
  for (const sward::Plant& plant : plants) {
    if (plant.fade < 1) continue;  // others sink
    ASSERT_NEAR(plant.position.z, hills(glm::dvec2(plant.position)), 2 * 0.02);
  }
}

TEST(HostTerrain, NoGroundWhereTheHostHasNone) {
  const glm::dvec2 middle(5300, -6900);
  const auto with_hole = [=](glm::dvec2 p) {
    return glm::distance(p, middle) < 30 ? std::numeric_limits<double>::quiet_NaN() : hills(p);
  };
  const FixedTriangles all = all_of(make_hills(with_hole), 4);
  const glm::dvec2 size = hill_box().high - hill_box().low;
  const double missing = size.x * size.y - area_on_map(all), hole = 3.14159 * 900;
  EXPECT_GE(missing, hole);
  EXPECT_LT(missing, hole * 1.35) << "triangles at the rim are left out, no others";
  for (size_t i = 0; i < all.size(); ++i) {
    const glm::dvec3 centre = all.apex()[i] + glm::dvec3(all.to_left()[i] + all.to_right()[i]) / 3.0;
    ASSERT_GT(glm::distance(glm::dvec2(centre), middle), 29.5);
    ASSERT_TRUE(std::isfinite(centre.z));
  }
  EXPECT_TRUE(all_of(make_hills([](glm::dvec2) { return std::numeric_limits<double>::infinity(); }), 4).empty());
}

// One that no corner meets: the middle of an edge that two triangles share.
TEST(HostTerrain, SeesHolesBetweenCorners) {
  const FixedTriangles whole = all_of(make_hills(), 30);
  const glm::dvec2 middle =
      glm::dvec2(whole.apex()[1000]) + 0.5 * glm::dvec2(whole.to_left()[1000] + whole.to_right()[1000]);
  const HostTerrain pierced =
      make_hills([=](glm::dvec2 p) { return glm::distance(p, middle) < 0.05 ? NAN : hills(p); });
  EXPECT_EQ(all_of(pierced, 30).size(), whole.size() - 2);
}

// Heights are asked for again where the host says so, and nowhere else.
TEST(HostTerrain, ChangesWhereItIsTold) {
  double raised = 0;
  size_t asked = 0, asked_outside = 0;
  const glm::dvec2 low(5290, -6910), high(5310, -6890);
  HostTerrain terrain = make_hills([&](glm::dvec2 p) {
    ++asked;
    const bool inside = p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
    asked_outside += p.x < low.x - 15 || p.x > high.x + 15 || p.y < low.y - 15 || p.y > high.y + 15;
    return hills(p) + (inside ? raised : 0.0);
  });
  const View view = look({5300, -6930}, 5, 1.57);
  const FixedLevelOptions cut = cut_of(terrain, 1.6f, 100);
  FixedTriangles kept;
  ASSERT_TRUE(terrain.fixed_level_triangles(view, cut, kept));
  ASSERT_GT(asked, 100u);
  const uint64_t contents = kept.contents();
  asked = 0;
  ASSERT_TRUE(terrain.fixed_level_triangles(view, cut, kept));
  EXPECT_EQ(asked, 0u) << "a view that stays asks for nothing";
  EXPECT_EQ(kept.contents(), contents) << "and changes nothing";
  raised = 3;
  asked_outside = 0;
  terrain.changed(low, high);
  ASSERT_TRUE(terrain.fixed_level_triangles(view, cut, kept));
  EXPECT_GT(asked, 0u);
  EXPECT_EQ(asked_outside, 0u);
  const ById fresh = by_id(triangles_of(terrain, view, cut));
  ASSERT_EQ(fresh.size(), kept.size());
  size_t moved = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    const FixedTriangle& t = fresh.at(kept.id()[i].bits);
    ASSERT_EQ(t.apex, kept.apex()[i]);
    ASSERT_EQ(t.to_left, kept.to_left()[i]);
    moved += t.apex.z > hills(t.apex) + 1;
  }
  EXPECT_GT(moved, 50u);
  asked = 0;
  terrain.changed({0, 0}, {10, 10});
  ASSERT_TRUE(terrain.fixed_level_triangles(view, cut, kept));
  EXPECT_EQ(asked, 0u) << "outside of the box nothing changes";
}

TEST(HostTerrain, AsksOnTheCallingThread) {
  const std::thread::id mine = std::this_thread::get_id();
  size_t elsewhere = 0;
  const HostTerrain terrain = make_hills([&](glm::dvec2 p) {
    elsewhere += std::this_thread::get_id() != mine;
    return hills(p);
  });
  FixedLevelOptions cut = cut_of(terrain, 0.4f, 150);
  cut.threads = 4;
  const View view = look({5300, -6900}, 60, 1.57, -1.2);
  const FixedTriangles four = triangles_of(terrain, view, cut);
  EXPECT_GT(four.size(), 12000u) << "enough for several threads";
  EXPECT_EQ(elsewhere, 0u);
  cut.threads = 1;
  const FixedTriangles one = triangles_of(terrain, view, cut);
  ASSERT_EQ(one.size(), four.size());
  for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one.id()[i], four.id()[i]);
}

// A world of 5000 km: positions to the millimetre, the cost that of what is in view.
TEST(HostTerrain, CoversLargeWorlds) {
  HostTerrainDesc desc;
  desc.low = {-2.5e6, -1e6, -100};
  desc.high = {2.5e6, 1e6, 100};
  const HostTerrain terrain = make_hills(hills, desc);
  const glm::dvec2 at(2.4e6, -0.9e6);
  const FixedTriangles triangles = triangles_of(terrain, look(at, 1.7, 0), cut_of(terrain, 1.6f, 60));
  ASSERT_GT(triangles.size(), 200u);
  for (size_t i = 0; i < triangles.size(); ++i) {
    ASSERT_LT(glm::distance(glm::dvec2(triangles.apex()[i]), at), 70);
    ASSERT_EQ(triangles.apex()[i].z, hills(triangles.apex()[i]));
  }
}

TEST(HostTerrain, RefusesWhatItCannotCover) {
  const auto refused = [](const HostTerrainDesc& desc, sward::HostHeight height = hills) {
    const auto terrain = HostTerrain::create(std::move(height), desc);
    return terrain ? std::string() : terrain.error().message;
  };
  const HostTerrainDesc good = hill_box();
  EXPECT_NE(refused(good, nullptr).find("height function"), std::string::npos);
  HostTerrainDesc desc = good;
  desc.high.x = desc.low.x;
  EXPECT_NE(refused(desc).find("empty"), std::string::npos);
  desc.high.x = NAN;
  EXPECT_NE(refused(desc).find("finite"), std::string::npos);
  desc.high.x = desc.low.x + 9e6;
  EXPECT_NE(refused(desc).find("km"), std::string::npos);
  desc.high.x = desc.low.x + 0.1;
  EXPECT_NE(refused(desc).find("wider"), std::string::npos);
  desc = good;
  desc.foot_splits = 9;
  EXPECT_NE(refused(desc).find("foot_splits"), std::string::npos);
  FixedTriangles triangles;
  const HostTerrain terrain = make_hills();
  EXPECT_FALSE(terrain.fixed_level_triangles(look({NAN, 0}, 2, 0), cut_of(terrain, 4, 50), triangles));
}

}  // namespace
