// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What moves in the mesh: how far on screen from one frame to the next, within which bound, and that it ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <unordered_map>

#include "drawn_surface.h"
#include "roam_reference.h"
#include "roam_support.h"

namespace {

using drawn_surface::Errors;
using drawn_surface::measure;
using roam_support::make_terrain;
using roam_support::Random;
using roam_support::Terrain;
using sward::RoamMesh;
using sward::RoamOptions;
using sward::RoamVertex;
using sward::View;

constexpr double k_frame_s = 1.0 / 60;
constexpr double k_near = 0.3;

RoamMesh make_mesh(const Terrain& terrain, RoamOptions options) {
  auto mesh = RoamMesh::create(*terrain.bounds, options);
  EXPECT_TRUE(mesh.has_value()) << (mesh ? "" : mesh.error().message);
  return std::move(*mesh);
}

Terrain rough_terrain() {
  roam_support::TerrainOptions options;
  options.columns = options.rows = 257;
  options.relief_m = 250;
  options.octaves = 8;
  options.wavelength = 100;
  options.detail = true;
  return make_terrain(options);
}

struct Path {
  const char* name;
  double metres_per_second;
  double above_ground;
};
constexpr Path k_walk{"walk", 1.5, 1.7};
constexpr Path k_low_flight{"low flight", 60, 15};

View view_on(const sward::HeightField& field, const Path& path, double t) {
  const double way = path.metres_per_second * t;
  const glm::dvec2 xy = glm::dvec2(-900, -500) + way * glm::dvec2(0.8, 0.6) + 3.0 * std::sin(0.5 * t);
  // The ground below is followed as a vehicle does: over some metres.
  double z = -1e9;
  for (int k = -3; k <= 3; ++k) z = std::max(z, field.height(xy + double(k) * 3.0 * glm::dvec2(0.8, 0.6)));
  return View::look({xy, z + path.above_ground}, 0.6435 + 0.3 * std::sin(0.4 * t), -0.15, 0.87, {1920, 1080}, k_near,
                    20000);
}

// What a renderer holds after an update: copies of slots and triangles, and where its clock stood.
struct Drawn {
  std::vector<RoamVertex> vertices;
  std::vector<uint32_t> indices;
  glm::dvec3 origin{0};
  double time_base = 0;  // of the renderer's clock, seconds on the host's

  void take(const RoamMesh& mesh, double time_s) {
    vertices.assign(mesh.vertices().begin(), mesh.vertices().end());
    indices.assign(mesh.visible_indices().begin(), mesh.visible_indices().end());
    origin = mesh.origin();
    time_base = time_s - double(mesh.morph_time());
  }
  glm::dvec3 at(uint32_t slot, double time_s) const {
    const RoamVertex& v = vertices[slot];
    const double t = std::clamp((time_s - time_base - double(v.start_s)) * double(v.per_second), 0.0, 1.0);
    return origin + glm::dvec3(v.position.x, v.position.y, glm::mix(double(v.from_z), double(v.position.z), t));
  }
};

// Triangles at one time.
struct Heights {
  std::vector<glm::dvec3> corners;

  void take(const Drawn& drawn, double time_s) {
    corners.clear();
    for (const uint32_t slot : drawn.indices) corners.push_back(drawn.at(slot, time_s));
  }
  // NaN where nothing is drawn.
  double above(glm::dvec2 p) const {
    for (size_t i = 0; i < corners.size(); i += 3) {
      const glm::dvec3 &a = corners[i], l = corners[i + 1] - a, r = corners[i + 2] - a;
      const glm::dvec2 q = p - glm::dvec2(a);
      const double area = l.x * r.y - l.y * r.x, e = 1e-4 * area;
      const double u = q.x * r.y - q.y * r.x, v = l.x * q.y - l.y * q.x;
      if (u >= -e && v >= -e && u + v <= area + e) return a.z + (u * l.z + v * r.z) / area;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

// Pixels between two heights at one place; 0 unless the second is on screen.
double pixels(const View& view, glm::dvec2 xy, double z_before, double z_now) {
  const glm::dmat4 clip = view.clip_from_relative();
  const glm::dvec4 now = clip * glm::dvec4(glm::dvec3(xy, z_now) - view.eye, 1);
  if (!(std::abs(now.x) <= now.w && std::abs(now.y) <= now.w && std::abs(now.z) <= now.w)) return 0;
  const glm::dvec4 before = clip * glm::dvec4(glm::dvec3(xy, z_before) - view.eye, 1);
  if (before.w < k_near) return 0;
  const glm::dvec2 off = glm::dvec2(now) / now.w - glm::dvec2(before) / before.w;
  return glm::length(0.5 * glm::dvec2(view.viewport) * off);
}

struct Follow {
  double most_px = 0;     // a drawn height from one frame to the next
  double most_bound = 0;  // of the mesh over the flight
  double least_bound = RoamMesh::k_artificial_max;
  double most_torn = 0;  // metres: the mesh before an update and the one after it at the same time
  double most_torn_px = 0;
  int torn = 0, compared = 0, changes = 0;
};

// Two surfaces whose triangles come from one bintree differ most at a corner of one of them.
void compare(const View& view, const Heights& before, const Heights& before_now, const Heights& now, Follow& follow) {
  std::unordered_map<double, std::unordered_map<double, double>> seen;  // by x and y
  for (const glm::dvec3& p : now.corners) seen[p.x][p.y] = p.z;
  std::unordered_map<double, std::unordered_map<double, bool>> done;
  const auto one = [&](glm::dvec2 p, double z_before, double z_before_now, double z_now) {
    if (std::isnan(z_before) || std::isnan(z_now)) return;
    ++follow.compared;
    follow.most_px = std::max(follow.most_px, pixels(view, p, z_before, z_now));
    const double torn = std::abs(z_before_now - z_now);
    follow.torn += torn > 1e-3;
    follow.most_torn = std::max(follow.most_torn, torn);
    follow.most_torn_px = std::max(follow.most_torn_px, pixels(view, p, z_before_now, z_now));
  };
  for (size_t i = 0; i < before.corners.size(); ++i) {
    const glm::dvec3 p = before.corners[i];
    if (!done[p.x].emplace(p.y, true).second) continue;
    const auto column = seen.find(p.x);
    const bool stays = column != seen.end() && column->second.count(p.y);
    one(p, p.z, before_now.corners[i].z, stays ? column->second.at(p.y) : now.above(p));
  }
  for (const glm::dvec3& p : now.corners)
    if (done[p.x].emplace(p.y, true).second) one(p, before.above(p), before_now.above(p), p.z);
}

Follow follow_flight(const Terrain& terrain, const Path& path, float morph_s) {
  RoamOptions options;
  options.max_triangles = 4000;
  options.morph_s = morph_s;
  RoamMesh mesh = make_mesh(terrain, options);
  Follow follow;
  Drawn drawn;
  Heights before, before_now, now;
  double time = 100;
  for (int frame = 0; frame < 240; ++frame, time += k_frame_s) {
    const View view = view_on(*terrain.field, path, frame * k_frame_s);
    if (frame > 0) before.take(drawn, time - k_frame_s), before_now.take(drawn, time);
    const auto stats = mesh.update(view, time);
    EXPECT_TRUE(stats.has_value());
    drawn.take(mesh, time);
    now.take(drawn, time);
    follow.changes += int(stats->splits + stats->merges);
    if (frame < 30) continue;
    const double bound = double(mesh.bound_px());
    follow.most_bound = std::max(follow.most_bound, bound);
    follow.least_bound = std::min(follow.least_bound, bound);
    if (!mesh.all_vertices_changed()) compare(view, before, before_now, now, follow);
  }
  std::printf(
      "%s, morph %.2f s: %.2f px at most a frame; bound %.1f..%.1f px; torn %d of %d, %.4f m, %.3f px; "
      "%d changes\n",
      path.name, double(morph_s), follow.most_px, follow.least_bound, follow.most_bound, follow.torn, follow.compared,
      follow.most_torn, follow.most_torn_px, follow.changes);
  return follow;
}

void expect_smooth(const Path& path) {
  const Terrain terrain = rough_terrain();
  const Follow smooth = follow_flight(terrain, path, 0.25f), jumping = follow_flight(terrain, path, 0);
  EXPECT_GT(smooth.compared, 100000);
  EXPECT_GT(smooth.changes, 1000);
  // The mesh before an update and the one after it are the same surface at the same time.
  // But for motions that end because the eye comes near: what is left of them is not seen.
  EXPECT_LT(smooth.most_torn, 1e-2);
  EXPECT_LT(smooth.most_torn_px, 1e-2);
  EXPECT_GT(jumping.most_torn, 0.1);
  // What is split has at most some more than the bound at rest, and moves in 15 frames.
  EXPECT_LT(smooth.most_px, 1.25 * jumping.most_bound / (0.25 / k_frame_s));
  EXPECT_LT(smooth.most_px, jumping.most_px / 8);
}

TEST(RoamMorph, NothingJumpsOnAWalk) {
  expect_smooth(k_walk);
}

TEST(RoamMorph, NothingJumpsInALowFlight) {
  expect_smooth(k_low_flight);
}

// Over a small field: steps of 1/60 s, and now and then another place.
View wandering_view(const sward::HeightField& field, int frame) {
  const double t = 0.02 * frame + 1.7 * (frame / 90);
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  const glm::dvec2 xy = low + size * (0.5 + 0.4 * glm::dvec2(std::cos(0.31 * t), std::sin(0.23 * t)));
  const double z = field.height(xy) + 20 + 15 * std::sin(0.4 * t);
  return View::look({xy, z}, 0.9 * t, -0.25 + 0.2 * std::sin(0.7 * t), 0.9, {1280, 720}, 0.5, 1e5);
}

// How many times larger the bound is than the true error, median over the frames of a flight. Points of the finest
// surface are compared with what is drawn, `parts` of them a sample along each axis.
double bound_over_error(const Terrain& terrain, bool moving, int parts, int every) {
  const sward::HeightField& field = *terrain.field;
  const int step = field.sample_step() / parts;
  RoamOptions options;
  options.max_triangles = 400;
  RoamMesh mesh = make_mesh(terrain, options);
  std::vector<double> ratios{0};
  for (int frame = 0; frame < 360; ++frame) {
    const View view = wandering_view(field, frame);
    const auto stats = moving ? mesh.update(view, frame * k_frame_s) : mesh.update(view);
    EXPECT_TRUE(stats.has_value());
    if (frame % every != 0 || (stats->moving > 0) != moving) continue;
    Errors errors;
    for (int row = 0; row <= (field.desc().rows - 1) * parts; ++row) {
      for (int column = 0; column <= (field.desc().columns - 1) * parts; ++column) {
        const sward::LatticePoint point = sward::LatticePoint(column, row) * step;
        measure(mesh, view, field.world_xy(point), field.height(point), errors);
      }
    }
    EXPECT_EQ(errors.undrawn, 0) << "frame " << frame;
    const double bound = double(mesh.bound_px());
    EXPECT_LE(errors.largest, bound * (1 + 1e-6) + 1e-9) << "frame " << frame;
    if (errors.seen > 100 && mesh.bound_px() < RoamMesh::k_artificial_max) ratios.push_back(bound / errors.largest);
  }
  EXPECT_GT(ratios.size(), size_t(180 / every));
  std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

TEST(RoamMorph, BoundHoldsWhileVerticesMove) {
  const Terrain terrain = make_terrain({});
  const double moving = bound_over_error(terrain, true, 1, 3), resting = bound_over_error(terrain, false, 1, 3);
  std::printf("bound / largest error, median: %.2f moving, %.2f at rest\n", moving, resting);
  EXPECT_LE(resting, 4) << "a bound must be useful too";
  EXPECT_LE(moving, 2 * resting);
}

// Here the bound at rest is analytic; what moves must not make it much worse.
TEST(RoamMorph, BoundHoldsWhileReliefMoves) {
  roam_support::TerrainOptions options;
  options.columns = options.rows = 33;
  options.spacing = 20;
  options.detail = true;
  const Terrain terrain = make_terrain(options);
  const double moving = bound_over_error(terrain, true, 4, 12), resting = bound_over_error(terrain, false, 4, 12);
  std::printf("bound / largest error, median: %.2f moving, %.2f at rest\n", moving, resting);
  EXPECT_LE(moving, 1.5 * resting);
}

// What began to move far ahead has ended its motion when the eye gets there.
TEST(RoamMorph, MotionNearTheEyeLeavesTheBoundWhatItIsAtRest) {
  roam_support::TerrainOptions size;
  size.columns = size.rows = 257;
  size.spacing = 5;
  size.relief_m = 100;
  size.octaves = 9;
  size.wavelength = 400;
  const Terrain terrain = make_terrain(size);
  RoamOptions options;
  options.max_triangles = 8000;
  RoamMesh moving = make_mesh(terrain, options), resting = make_mesh(terrain, options);
  uint64_t moved = 0;
  double most = 0;
  for (int frame = 0; frame < 240; ++frame) {
    const double t = frame * k_frame_s;
    const glm::dvec2 xy = glm::dvec2(-400, -300) + 200.0 * t * glm::dvec2(0.8, 0.6);
    const View view = View::look({xy, terrain.field->height(xy) + 3}, 0.6435 + 0.2 * std::sin(t), -0.05, 0.87,
                                 {1920, 1080}, 0.5, 60000);
    const auto stats = moving.update(view, t);
    ASSERT_TRUE(stats.has_value() && resting.update(view).has_value());
    moved += stats->moving;
    ASSERT_LT(resting.bound_px(), RoamMesh::k_artificial_max) << "frame " << frame;
    ASSERT_LT(moving.bound_px(), 3 * resting.bound_px()) << "frame " << frame;
    most = std::max(most, double(moving.bound_px() / resting.bound_px()));
    const auto valid = moving.validate();
    ASSERT_TRUE(valid.has_value()) << "frame " << frame << ": " << valid.error().message;
  }
  std::printf("bound moving / at rest: at most %.2f; %.0f vertices moving\n", most, double(moved) / 240);
  EXPECT_GT(moved, 240u * 50);
}

TEST(RoamMorph, ComesToRestWithinHalfASecond) {
  const Terrain terrain = make_terrain({});
  RoamOptions options;
  options.max_triangles = 1200;
  const uint32_t decided = options.max_triangles - options.max_triangles / 24;
  RoamMesh mesh = make_mesh(terrain, options);
  double time = 0;
  int moved = 0;
  for (int stop = 0; stop < 25; ++stop) {
    View view = wandering_view(*terrain.field, 0);
    for (int frame = 0; frame < 40; ++frame, time += k_frame_s) {
      view = wandering_view(*terrain.field, 53 * stop + frame);
      const auto stats = mesh.update(view, time);
      ASSERT_TRUE(stats.has_value());
      moved += stats->moving > 0;
    }
    const double stopped = time - k_frame_s;
    for (; time < stopped + 0.5 + k_frame_s; time += k_frame_s) ASSERT_TRUE(mesh.update(view, time).has_value());
    const std::vector<uint32_t> before(mesh.visible_indices().begin(), mesh.visible_indices().end());
    for (int again = 0; again < 20; ++again, time += k_frame_s) {
      const auto stats = mesh.update(view, time);
      ASSERT_EQ(stats->moving, 0u) << "stop " << stop;
      ASSERT_EQ(stats->splits + stats->merges, 0u) << "stop " << stop;
      ASSERT_TRUE(mesh.changed_vertices().empty() && mesh.changed_triangles().empty());
    }
    EXPECT_TRUE(std::equal(before.begin(), before.end(), mesh.visible_indices().begin(), mesh.visible_indices().end()));
    for (const uint32_t slot : mesh.visible_indices()) {
      const glm::dvec3 p = mesh.vertex_world(slot);
      ASSERT_NEAR(p.z, terrain.field->height(glm::dvec2(p)), 1e-6);
    }
    roam_reference::GreedyMesh greedy(*terrain.bounds, view);
    const double best = greedy.refine(decided, 0);
    const double most = roam_reference::error_of(view, best * (1 + double(options.hysteresis)));
    ASSERT_LE(mesh.bound_px(), most * (1 + 2e-5)) << "stop " << stop;
  }
  EXPECT_GT(moved, 500);
}

TEST(RoamMorph, StaysWithinTheBudgetAndValid) {
  for (const bool detail : {false, true}) {
    roam_support::TerrainOptions field;
    if (detail) field.columns = field.rows = 33, field.spacing = 20, field.detail = true;
    const Terrain terrain = make_terrain(field);
    Random random(31);
    RoamOptions options;
    options.max_triangles = 700;
    RoamMesh mesh = make_mesh(terrain, options);
    double time = -5;
    for (int frame = 0; frame < 500; ++frame) {
      // Steps from none at all to longer than any motion.
      if (frame % 7 != 0) time += random.uniform(0, frame % 11 == 0 ? 0.4 : 0.03);
      const View view =
          frame % 40 == 39 ? roam_support::random_view(*terrain.field, random) : wandering_view(*terrain.field, frame);
      const auto stats = mesh.update(view, time);
      ASSERT_TRUE(stats.has_value());
      ASSERT_LE(stats->visible, options.max_triangles) << "frame " << frame;
      const auto valid = mesh.validate();
      ASSERT_TRUE(valid.has_value()) << "frame " << frame << ": " << valid.error().message;
    }
  }
}

TEST(RoamMorph, AClockThatIsSetBackEndsAllMotions) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  uint32_t moving = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const auto stats = mesh.update(wandering_view(*terrain.field, frame), 5 + frame * k_frame_s);
    ASSERT_TRUE(stats.has_value());
    moving = stats->moving;
  }
  EXPECT_GT(moving, 0u);
  const auto stats = mesh.update(wandering_view(*terrain.field, 30), 1.0);
  ASSERT_TRUE(stats.has_value());
  EXPECT_EQ(stats->moving, 0u);
  EXPECT_TRUE(mesh.all_vertices_changed()) << "vertices carry times of the old clock";
  for (const uint32_t slot : mesh.visible_indices()) {
    EXPECT_EQ(mesh.vertices()[slot].per_second, 0);
    EXPECT_EQ(mesh.vertices()[slot].from_z, mesh.vertices()[slot].position.z);
  }
  EXPECT_TRUE(mesh.validate().has_value());
  EXPECT_TRUE(mesh.update(wandering_view(*terrain.field, 31), 1.0 + k_frame_s).has_value());
}

TEST(RoamMorph, RefusesTimesThatAreNone) {
  const Terrain terrain = make_terrain({});
  RoamMesh mesh = make_mesh(terrain, {});
  ASSERT_TRUE(mesh.update(wandering_view(*terrain.field, 0), 5.0).has_value());
  const uint64_t revision = mesh.revision();
  const double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  for (const double time : {none, endless, -endless}) {
    const auto refused = mesh.update(wandering_view(*terrain.field, 30), time);
    ASSERT_FALSE(refused.has_value()) << time;
    EXPECT_NE(refused.error().message.find("time"), std::string::npos) << refused.error().message;
  }
  EXPECT_EQ(mesh.revision(), revision);
  EXPECT_TRUE(mesh.update(wandering_view(*terrain.field, 30), 5.0).has_value());
}

TEST(RoamMorph, NoMorphIsAnUpdateWithoutATime) {
  const Terrain terrain = make_terrain({});
  RoamOptions options;
  options.max_triangles = 900;
  RoamMesh untimed = make_mesh(terrain, options);
  options.morph_s = 0;
  RoamMesh timed = make_mesh(terrain, options);
  for (int frame = 0; frame < 200; ++frame) {
    const View view = wandering_view(*terrain.field, 5 * frame);
    ASSERT_TRUE(untimed.update(view).has_value());
    const auto stats = timed.update(view, frame * k_frame_s);
    ASSERT_TRUE(stats.has_value());
    ASSERT_EQ(stats->moving, 0u);
    const auto a = untimed.visible_indices(), b = timed.visible_indices();
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "frame " << frame;
    for (const uint32_t slot : a) ASSERT_EQ(untimed.vertex_world(slot), timed.vertex_world(slot));
  }
}

// Slots copied by change alone, evaluated as the shader does.
TEST(RoamMorph, ChangedSlotsGiveADrawingHostTheDrawnHeights) {
  roam_support::TerrainOptions wide;
  wide.spacing = 60;  // the origin moves now and then
  const Terrain terrain = make_terrain(wide);
  RoamOptions options;
  options.max_triangles = 900;
  RoamMesh mesh = make_mesh(terrain, options);
  std::vector<RoamVertex> slots;
  std::vector<uint32_t> indices;
  int moving = 0, rebases = 0;
  double time = 1e6;
  for (int frame = 0; frame < 400; ++frame, time += k_frame_s) {
    const auto stats = mesh.update(wandering_view(*terrain.field, frame), time);
    ASSERT_TRUE(stats.has_value());
    moving += stats->moving > 0;
    rebases += mesh.all_vertices_changed();
    slots.resize(mesh.vertices().size());
    for (const uint32_t slot : mesh.changed_vertices()) slots[slot] = mesh.vertices()[slot];
    indices.resize(mesh.visible_indices().size());
    for (const uint32_t triangle : mesh.changed_triangles())
      for (size_t i = 3 * size_t(triangle); i < 3 * size_t(triangle) + 3 && i < indices.size(); ++i)
        indices[i] = mesh.visible_indices()[i];
    ASSERT_TRUE(std::equal(indices.begin(), indices.end(), mesh.visible_indices().begin()));
    for (const uint32_t slot : indices) {
      const RoamVertex& v = slots[slot];
      const float t = std::clamp((mesh.morph_time() - v.start_s) * v.per_second, 0.0f, 1.0f);
      const glm::dvec3 drawn = mesh.vertex_world(slot) - mesh.origin();
      ASSERT_NEAR(glm::mix(v.from_z, v.position.z, t), drawn.z, 1e-3) << "frame " << frame;
      ASSERT_LT(glm::distance(glm::dvec2(v.position), glm::dvec2(drawn)), 1e-3);
    }
  }
  EXPECT_GT(moving, 200);
  EXPECT_GT(rebases, 1);
}

}  // namespace
