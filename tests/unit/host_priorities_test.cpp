// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/many_views.h>
#include <sward/terrain/queries.h>

#include <gtest/gtest.h>

#include <limits>

#include "drawn_surface.h"
#include "roam_support.h"

namespace sward {
namespace {

using roam_support::make_terrain;
using roam_support::Random;
using roam_support::Terrain;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

Terrain hills(bool detail = false) {
  roam_support::TerrainOptions options;
  options.columns = options.rows = detail ? 65 : 257;
  options.spacing = detail ? 30 : 10;
  options.detail = detail;
  return make_terrain(options);
}

RoamMesh make_mesh(const Terrain& terrain, uint32_t triangles, bool plain = false) {
  RoamOptions options;
  options.max_triangles = triangles;
  options.plain = plain;
  return RoamMesh::create(*terrain.bounds, options).value();
}

std::string fault_of(const RoamMesh& mesh) {
  const auto valid = mesh.validate();
  return valid ? "" : valid.error().message;
}

glm::dvec2 random_place(const HeightField& field, Random& random) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  return {random.uniform(low.x, high.x), random.uniform(low.y, high.y)};
}

// A flight that turns, over the middle of the field.
View flight_view(const HeightField& field, int frame) {
  const double t = 0.04 * frame;
  const glm::dvec2 xy = 300.0 * glm::dvec2(std::cos(0.5 * t), std::sin(0.35 * t));
  return View::look({xy, field.height(xy) + 60}, 1.3 * t, -0.3, 1.0, {1280, 720}, 0.5, 1e5);
}

// Things that wander over the field.
struct Herd {
  std::vector<glm::dvec2> at, way;

  Herd(const HeightField& field, size_t count, uint32_t seed) {
    Random random(seed);
    for (size_t i = 0; i < count; ++i) {
      at.push_back(random_place(field, random));
      way.push_back({random.uniform(-2, 2), random.uniform(-2, 2)});
    }
  }
  void walk(const HeightField& field) {
    const glm::dvec2 low = field.min_corner(), high = field.max_corner();
    for (size_t i = 0; i < at.size(); ++i) {
      for (int k = 0; k < 2; ++k)
        if (at[i][k] + way[i][k] < low[k] || at[i][k] + way[i][k] > high[k]) way[i][k] = -way[i][k];
      at[i] += way[i];
    }
  }
};

bool in_frustum(const View& view, glm::dvec3 p) {
  const glm::dvec4 c = view.clip_from_relative() * glm::dvec4(p - view.eye, 1);
  return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && std::abs(c.z) <= c.w;
}

struct Standing {
  int seen = 0;
  double farthest = 0;
};

// The drawn ground below what is in sight against the finest surface.
Standing standing(const RoamMesh& mesh, const HeightField& field, const View& view, const std::vector<glm::dvec2>& at) {
  Standing s;
  for (const glm::dvec2& xy : at) {
    const double z = field.height(xy);
    if (!in_frustum(view, {xy, z})) continue;
    ++s.seen;
    const double off = std::abs(drawn_surface::drawn_height(mesh, xy) - z);
    s.farthest = std::max(s.farthest, std::isnan(off) ? 1e9 : off);
  }
  return s;
}

// A line over one drawn triangle: where, and its least height over the triangle's plane.
struct Piece {
  double begin, end, clearance;
};

struct Drawn {
  glm::dvec3 a, l, r;
  glm::dvec2 low, high;
};

std::vector<Drawn> drawn_triangles(const RoamMesh& mesh) {
  std::vector<Drawn> triangles;
  const auto indices = mesh.visible_indices();
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertex_world(indices[i]), l = mesh.vertex_world(indices[i + 1]),
                     r = mesh.vertex_world(indices[i + 2]);
    triangles.push_back({a, l - a, r - a, glm::min(glm::dvec2(a), glm::min(glm::dvec2(l), glm::dvec2(r))),
                         glm::max(glm::dvec2(a), glm::max(glm::dvec2(l), glm::dvec2(r)))});
  }
  return triangles;
}

std::vector<Piece> pieces_of(const std::vector<Drawn>& triangles, const NamedLine& line) {
  std::vector<Piece> pieces;
  const glm::dvec2 low = glm::min(glm::dvec2(line.from), glm::dvec2(line.to)),
                   high = glm::max(glm::dvec2(line.from), glm::dvec2(line.to));
  for (const auto& [a, l, r, least, most] : triangles) {
    if (most.x < low.x || most.y < low.y || least.x > high.x || least.y > high.y) continue;
    const double area = l.x * r.y - l.y * r.x;
    const auto place = [&, a = a, l = l, r = r](double t) {
      const glm::dvec3 q = glm::mix(line.from, line.to, t) - a;
      const double u = (q.x * r.y - q.y * r.x) / area, v = (l.x * q.y - l.y * q.x) / area;
      return glm::dvec4(1 - u - v, u, v, q.z - u * l.z - v * r.z);
    };
    const glm::dvec4 from = place(0), to = place(1);
    double begin = 0, end = 1;
    for (int k = 0; k < 3; ++k) {
      if (from[k] < 0 && to[k] < 0) end = -1;
      if (from[k] < 0 && to[k] >= 0) begin = std::max(begin, from[k] / (from[k] - to[k]));
      if (from[k] >= 0 && to[k] < 0) end = std::min(end, from[k] / (from[k] - to[k]));
    }
    if (begin < end) pieces.push_back({begin, end, std::min(place(begin).w, place(end).w)});
  }
  return pieces;
}

struct Sighting {
  int pieces = 0, wrong_pieces = 0;
  int lines = 0, wrong_lines = 0, blocked = 0;  // those of which all is drawn
};

// Every drawn piece of every line, and every line that is drawn as a whole, against the finest surface.
void compare(const RoamMesh& mesh, const TerrainQueries& queries, const std::vector<NamedLine>& lines,
             Sighting& found) {
  constexpr double k_on_ground = 1e-6, k_doubt = 1e-8;
  const std::vector<Drawn> triangles = drawn_triangles(mesh);
  for (const NamedLine& line : lines) {
    double drawn = 0, least = 1e9;
    for (const Piece& piece : pieces_of(triangles, line)) {
      drawn += piece.end - piece.begin;
      least = std::min(least, piece.clearance);
      if (std::abs(piece.clearance + k_on_ground) < k_doubt) continue;
      const Sight part{glm::mix(line.from, line.to, piece.begin), glm::mix(line.from, line.to, piece.end)};
      ++found.pieces;
      found.wrong_pieces += queries.line_of_sight(part).visible != (piece.clearance >= -k_on_ground);
    }
    if (drawn < 1 - 1e-9 || std::abs(least + k_on_ground) < k_doubt) continue;
    ++found.lines;
    const bool visible = queries.line_of_sight({line.from, line.to}).visible;
    found.blocked += !visible;
    found.wrong_lines += visible != (least >= -k_on_ground);
  }
}

NamedLine random_line(const HeightField& field, Random& random, uint64_t id) {
  const glm::dvec2 from = random_place(field, random), low = field.min_corner(), high = field.max_corner();
  const glm::dvec2 to = glm::clamp(from + glm::dvec2(random.uniform(-400, 400), random.uniform(-400, 400)), low, high);
  const double up = random.below(3) == 0 ? random.uniform(0, 3) : random.uniform(0, 40);
  return {id, {from, field.height(from) + up}, {to, field.height(to) + random.uniform(0, 2) * up}};
}

TEST(HostPriorities, RefusesWhatIsNone) {
  const Terrain terrain = hills();
  HostPriorities named(terrain.field->lattice());
  const glm::dvec2 corner = terrain.field->max_corner();
  const auto refuses = [](const Expected<void>& result, const char* says) {
    ASSERT_FALSE(result.has_value());
    EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message;
  };
  refuses(named.add(NamedPoint{1, {k_nan, 0}}), "point 1: its coordinates");
  refuses(named.add(NamedPoint{1, corner + 1.0}), "outside of the data");
  refuses(named.add(NamedPoint{1, {0, 0}, -0.1}), "tolerance");
  refuses(named.add(NamedPoint{1, {0, 0}, k_nan}), "tolerance");
  refuses(named.add(NamedLine{2, {0, 0, k_nan}, {1, 1, 1}}), "line 2: its coordinates");
  refuses(named.move(NamedPoint{1, {0, 0}}), "no named point 1");
  refuses(named.remove(1), "id 1");
  EXPECT_EQ(named.size(), 0u);
  ASSERT_TRUE(named.add(NamedPoint{1, corner}));
  ASSERT_TRUE(named.add(NamedLine{2, {0, 0, 0}, {1e7, 1, 1}}));
  refuses(named.add(NamedPoint{1, {0, 0}}), "id 1 already");
  refuses(named.add(NamedLine{1, {}, {}}), "id 1 already");
  refuses(named.move(NamedLine{1, {}, {}}), "no named line 1");
  refuses(named.move(NamedPoint{2, {0, 0}}), "no named point 2");
  refuses(named.move(NamedPoint{1, {0, k_nan}}), "coordinates");
  EXPECT_EQ(named.size(), 2u);
  EXPECT_TRUE(named.remove(2));
  EXPECT_FALSE(named.contains(2));
  named.clear();
  EXPECT_EQ(named.size(), 0u);
  EXPECT_TRUE(named.add(NamedPoint{1, corner}));
}

TEST(HostPriorities, AreForOneLattice) {
  const Terrain terrain = hills(), other = hills(true);
  RoamMesh mesh = make_mesh(terrain, 1000);
  const HostPriorities named(other.field->lattice());
  EXPECT_FALSE(mesh.set_priorities(&named));
  const HostPriorities fit(terrain.field->lattice());
  EXPECT_TRUE(mesh.set_priorities(&fit));
  EXPECT_TRUE(mesh.set_priorities(nullptr));
}

// With morph, so that most of the ground is on its way, and without; deferred and plain.
void expect_points_to_stand(bool detail, bool plain, bool clock) {
  SCOPED_TRACE(testing::Message() << "detail " << detail << " plain " << plain << " clock " << clock);
  const Terrain terrain = hills(detail);
  const HeightField& field = *terrain.field;
  constexpr double k_tolerance[2] = {0.05, 0.5};
  HostPriorities named(field.lattice());
  Herd strict(field, 60, 1), lenient(field, 60, 2), unnamed(field, 60, 3);
  for (uint64_t i = 0; i < 60; ++i) {
    ASSERT_TRUE(named.add(NamedPoint{i, strict.at[i], k_tolerance[0]}));
    ASSERT_TRUE(named.add(NamedPoint{100 + i, lenient.at[i], k_tolerance[1]}));
  }
  const uint32_t budget = detail ? 15000 : 6000;
  RoamMesh mesh = make_mesh(terrain, budget, plain);
  ASSERT_TRUE(mesh.set_priorities(&named));
  double off_unnamed = 0;
  int seen = 0;
  uint32_t moving = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (Herd* herd : {&strict, &lenient, &unnamed}) herd->walk(field);
    for (uint64_t i = 0; i < 60; ++i) {
      ASSERT_TRUE(named.move(NamedPoint{i, strict.at[i], k_tolerance[0]}));
      ASSERT_TRUE(named.move(NamedPoint{100 + i, lenient.at[i], k_tolerance[1]}));
    }
    const View view = flight_view(field, frame);
    const auto stats = clock ? mesh.update(view, frame / 60.0) : mesh.update(view);
    ASSERT_TRUE(stats.has_value());
    ASSERT_LE(stats->visible, budget);
    ASSERT_EQ(stats->unmet, 0u) << "frame " << frame;
    moving += stats->moving;
    const Standing a = standing(mesh, field, view, strict.at), b = standing(mesh, field, view, lenient.at);
    ASSERT_LE(a.farthest, k_tolerance[0]) << "frame " << frame;
    ASSERT_LE(b.farthest, k_tolerance[1]) << "frame " << frame;
    seen += a.seen + b.seen;
    off_unnamed = std::max(off_unnamed, standing(mesh, field, view, unnamed.at).farthest);
    if (frame % 8 == 0) {
      ASSERT_EQ(fault_of(mesh), "") << "frame " << frame;
    }
  }
  EXPECT_GT(seen, 600);
  EXPECT_GT(off_unnamed, 1.0);
  EXPECT_EQ(moving > 0, clock);
}

TEST(HostPriorities, ObjectsStandOnTheGround) {
  expect_points_to_stand(false, false, true);
  expect_points_to_stand(false, false, false);
  expect_points_to_stand(false, true, false);
  expect_points_to_stand(true, false, true);
}

void expect_lines_to_be_right(bool detail, bool plain, bool clock) {
  SCOPED_TRACE(testing::Message() << "detail " << detail << " plain " << plain << " clock " << clock);
  const Terrain terrain = hills(detail);
  const HeightField& field = *terrain.field;
  const TerrainQueries queries(*terrain.bounds);
  RoamMesh mesh = make_mesh(terrain, 30000, plain), other = make_mesh(terrain, 3000, plain);
  HostPriorities named(field.lattice());
  ASSERT_TRUE(mesh.set_priorities(&named));
  Random random(17);
  std::vector<NamedLine> lines;
  Sighting found, unnamed;
  for (int frame = 0; frame < 30; ++frame) {
    // All are new in the first frame; then some go on to another place.
    for (size_t i = 0; i < 150; ++i) {
      if (frame > 0 && random.below(10) != 0) continue;
      const NamedLine line = random_line(field, random, i);
      if (frame == 0) lines.push_back(line);
      lines[i] = line;
      ASSERT_TRUE(frame == 0 ? named.add(line) : named.move(line));
    }
    const View view = flight_view(field, frame);
    const auto stats = clock ? mesh.update(view, frame / 60.0) : mesh.update(view);
    ASSERT_TRUE(stats.has_value() && other.update(view));
    ASSERT_EQ(stats->unmet, 0u) << "frame " << frame;
    compare(mesh, queries, lines, found);
    compare(other, queries, lines, unnamed);
    ASSERT_EQ(found.wrong_pieces, 0) << "frame " << frame;
    ASSERT_EQ(found.wrong_lines, 0) << "frame " << frame;
    if (frame % 8 == 0) {
      ASSERT_EQ(fault_of(mesh), "") << "frame " << frame;
    }
  }
  EXPECT_GT(found.pieces, 2000);
  EXPECT_GT(found.lines, 200);
  EXPECT_GT(found.blocked, 20);
  EXPECT_LT(found.blocked, found.lines - 20);
  EXPECT_GT(unnamed.wrong_lines, 5);
}

TEST(HostPriorities, LinesOfSightAreOccludedAsOnTheFinestSurface) {
  expect_lines_to_be_right(false, false, true);
  expect_lines_to_be_right(false, true, false);
  expect_lines_to_be_right(true, false, true);
}

TEST(HostPriorities, ASetThatNamesNothingChangesNothing) {
  const Terrain terrain = hills();
  for (const bool plain : {false, true}) {
    RoamMesh with = make_mesh(terrain, 3000, plain), without = make_mesh(terrain, 3000, plain);
    HostPriorities named(terrain.field->lattice());
    ASSERT_TRUE(named.add(NamedPoint{1, {0, 0}}));
    ASSERT_TRUE(named.remove(1));
    ASSERT_TRUE(with.set_priorities(&named));
    for (int frame = 0; frame < 100; ++frame) {
      const View view = flight_view(*terrain.field, frame);
      const auto a = with.update(view, frame / 60.0), b = without.update(view, frame / 60.0);
      ASSERT_TRUE(a && b);
      ASSERT_EQ(a->looked_at, b->looked_at);
      ASSERT_EQ(with.bound_px(), without.bound_px());
      ASSERT_TRUE(std::ranges::equal(with.visible_indices(), without.visible_indices()));
      for (const uint32_t slot : with.visible_indices()) ASSERT_EQ(with.vertex_world(slot), without.vertex_world(slot));
    }
  }
}

// The bound is one of what is seen, named or not.
TEST(HostPriorities, TheBoundStaysTrueAndUseful) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 100, 5);
  for (uint64_t i = 0; i < 100; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0}));
  Random random(3);
  for (const uint32_t budget : {6000u, 400u}) {
    RoamMesh mesh = make_mesh(terrain, budget);
    ASSERT_TRUE(mesh.set_priorities(&named));
    for (int frame = 0; frame < 10; ++frame) {
      // High enough that no wedgie of the field crosses the near plane.
      const View view = View::look({0, 0, 1200}, 0.3 * frame, -1.5, 1.2, {1280, 720}, 0.5, 1e5);
      const auto stats = mesh.update(view);
      ASSERT_TRUE(stats);
      ASSERT_EQ(stats->unmet > 0, budget == 400);
      drawn_surface::Errors errors;
      for (int i = 0; i < 300; ++i) {
        const glm::dvec2 xy = random_place(field, random);
        drawn_surface::measure(mesh, view, xy, field.height(xy), errors);
      }
      EXPECT_GT(errors.seen, 10);
      EXPECT_EQ(errors.undrawn, 0);
      EXPECT_LE(errors.largest, mesh.bound_px());
      EXPECT_LT(mesh.bound_px(), RoamMesh::k_artificial_max);
    }
  }
}

TEST(HostPriorities, ABudgetThatIsTooSmallIsKeptAndReported) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 400, 6);
  for (uint64_t i = 0; i < 400; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0}));
  for (const bool plain : {false, true}) {
    RoamMesh mesh = make_mesh(terrain, 500, plain);
    ASSERT_TRUE(mesh.set_priorities(&named));
    for (int frame = 0; frame < 60; ++frame) {
      const View view = flight_view(field, frame);
      const auto stats = mesh.update(view, frame / 60.0);
      ASSERT_TRUE(stats);
      ASSERT_LE(stats->visible, 500u);
      ASSERT_EQ(mesh.visible_indices().size() / 3, stats->visible);
      ASSERT_GT(stats->unmet, 0u);
      ASSERT_EQ(fault_of(mesh), "") << "frame " << frame;
    }
    // With room again all stand.
    const View view = flight_view(field, 59);
    EXPECT_GT(standing(mesh, field, view, herd.at).farthest, 1.0);
    RoamOptions options = mesh.options();
    options.max_triangles = 20000;
    ASSERT_TRUE(mesh.set_options(options));
    const auto stats = mesh.update(view, 1.0);
    ASSERT_TRUE(stats);
    EXPECT_EQ(stats->unmet, 0u);
    EXPECT_LT(standing(mesh, field, view, herd.at).farthest, 1e-6);
  }
}

// The budget is full of vertices that have just begun to rise, which cannot be given up before they stand.
TEST(HostPriorities, WhatRisesMakesRoomAtOnce) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  RoamMesh mesh = make_mesh(terrain, 1500);
  RoamOptions options = mesh.options();
  options.target_px = 1000;
  ASSERT_TRUE(mesh.set_options(options));
  const View view = flight_view(field, 0);
  ASSERT_TRUE(mesh.update(view, 0.0));
  options.target_px = 0;
  ASSERT_TRUE(mesh.set_options(options));
  const auto rising = mesh.update(view, 0.1);
  ASSERT_TRUE(rising);
  ASSERT_GT(rising->moving, 500u);
  HostPriorities named(field.lattice());
  Herd herd(field, 100, 13);
  for (uint64_t i = 0; i < 100; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0.05}));
  ASSERT_TRUE(mesh.set_priorities(&named));
  const auto stats = mesh.update(view, 0.1 + 1 / 60.0);
  ASSERT_TRUE(stats);
  EXPECT_EQ(stats->unmet, 0u);
  EXPECT_LE(standing(mesh, field, view, herd.at).farthest, 0.05);
  EXPECT_EQ(fault_of(mesh), "");
}

// A camera that stands still: what moves costs what it moves over, not the mesh nor what stays.
TEST(HostPriorities, CostFollowsWhatMoves) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 1000, 7);
  for (uint64_t i = 0; i < 1000; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 1.0}));
  RoamMesh mesh = make_mesh(terrain, 30000);
  ASSERT_TRUE(mesh.set_priorities(&named));
  const View view = flight_view(field, 0);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(mesh.update(view));
  ASSERT_EQ(mesh.update(view)->looked_at, 0u);
  uint32_t most = 0;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(named.move(NamedPoint{5, herd.at[5] + glm::dvec2(0.1 * i, 0), 1.0}));
    const auto stats = mesh.update(view);
    most = std::max(most, stats->looked_at);
  }
  EXPECT_LT(most, 200u);
  // Named anew where it is: nothing.
  ASSERT_TRUE(named.move(NamedPoint{7, herd.at[7], 1.0}));
  const auto stats = mesh.update(view);
  EXPECT_EQ(stats->splits + stats->merges, 0u);
}

TEST(HostPriorities, WhatIsNoLongerNamedIsGivenUp) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 100, 8);
  for (const bool plain : {false, true}) {
    RoamMesh mesh = make_mesh(terrain, 20000, plain), never = make_mesh(terrain, 20000, plain);
    RoamOptions options = mesh.options();
    options.target_px = 30;
    ASSERT_TRUE(mesh.set_options(options) && never.set_options(options));
    ASSERT_TRUE(mesh.set_priorities(&named));
    for (uint64_t i = 0; i < 100; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0}));
    const View view = flight_view(field, 3);
    const uint32_t with = mesh.update(view)->visible;
    named.clear();
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(mesh.update(view) && never.update(view));
    const double without = mesh.update(view)->visible, expected = never.update(view)->visible;
    EXPECT_GT(with, 1.05 * expected);
    EXPECT_NEAR(without, expected, 0.01 * expected);
    EXPECT_EQ(fault_of(mesh), "");
    // The same by taking the set away.
    for (uint64_t i = 0; i < 100; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0}));
    EXPECT_GT(mesh.update(view)->visible, 1.05 * expected);
    ASSERT_TRUE(mesh.set_priorities(nullptr));
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(mesh.update(view));
    EXPECT_NEAR(mesh.update(view)->visible, expected, 0.01 * expected);
    EXPECT_EQ(fault_of(mesh), "");
    named.clear();
  }
}

TEST(HostPriorities, FollowEdits) {
  Terrain terrain = hills();
  HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 50, 9);
  std::vector<NamedLine> lines;
  Random random(10);
  for (uint64_t i = 0; i < 50; ++i) {
    ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0.02}));
    lines.push_back(random_line(field, random, 100 + i));
    ASSERT_TRUE(named.add(lines.back()));
  }
  RoamMesh mesh = make_mesh(terrain, 12000);
  ASSERT_TRUE(mesh.set_priorities(&named));
  const View view = flight_view(field, 0);
  ASSERT_TRUE(mesh.update(view, 0.0));
  Sighting found;
  for (int i = 0; i < 40; ++i) {
    Edit change;
    change.kind = i % 2 ? Edit::Kind::flatten : Edit::Kind::raise;
    change.metres = i % 2 ? random.uniform(-50, 50) : random.uniform(-20, 60);
    change.region = EditRegion::disc(random_place(field, random), random.uniform(20, 300), 10);
    const auto edited = edit(field, *terrain.bounds, change);
    ASSERT_TRUE(edited);
    mesh.surface_changed(edited->changed);
    const auto stats = mesh.update(view, (i + 1) / 60.0);
    ASSERT_TRUE(stats);
    ASSERT_EQ(stats->unmet, 0u);
    ASSERT_LE(standing(mesh, field, view, herd.at).farthest, 0.02) << "edit " << i;
    compare(mesh, TerrainQueries(*terrain.bounds), lines, found);
    ASSERT_EQ(found.wrong_pieces + found.wrong_lines, 0) << "edit " << i;
    ASSERT_EQ(fault_of(mesh), "") << "edit " << i;
  }
  EXPECT_GT(found.pieces, 500);
}

// A field of which a part cannot be refined yet.
class PartlyResident final : public Surface {
 public:
  explicit PartlyResident(const Bounds& bounds) : all_(bounds) {}
  bool resident = false;

  const Lattice& lattice() const override { return all_.lattice(); }
  double height(LatticePoint p) const override { return all_.height(p); }
  glm::dvec2 relief_gradient(LatticePoint p) const override { return all_.relief_gradient(p); }
  float bound(LatticePoint centre, int level) const override { return all_.bound(centre, level); }
  bool can_split(LatticePoint, int level) const override { return resident || level < 6; }
  glm::dvec2 data_gradient(glm::dvec2 xy) const override { return all_.data_gradient(xy); }
  bool all_holes(const LatticeBox& box) const override { return all_.all_holes(box); }
  double height(glm::dvec2 xy) const override { return all_.height(xy); }
  glm::dvec2 height_range() const override { return all_.height_range(); }

 private:
  FieldSurface all_;
};

TEST(HostPriorities, WaitForDataThatAreNotResident) {
  const Terrain terrain = hills();
  PartlyResident surface(*terrain.bounds);
  RoamOptions options;
  options.max_triangles = 8000;
  RoamMesh mesh = RoamMesh::create(surface, options).value();
  HostPriorities named(surface.lattice());
  Herd herd(*terrain.field, 50, 11);
  for (uint64_t i = 0; i < 50; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0.1}));
  ASSERT_TRUE(mesh.set_priorities(&named));
  View view = flight_view(*terrain.field, 0);
  view.eye.z = 1000;
  ASSERT_GT(mesh.update(view)->unmet, 0u);
  EXPECT_LT(mesh.bound_px(), RoamMesh::k_artificial_max);
  EXPECT_EQ(fault_of(mesh), "");
  surface.resident = true;
  mesh.residency_changed({{0, 0}, surface.lattice().last()});
  ASSERT_EQ(mesh.update(view)->unmet, 0u);
  EXPECT_LE(standing(mesh, *terrain.field, view, herd.at).farthest, 0.1);
  surface.resident = false;
  mesh.residency_changed({{0, 0}, surface.lattice().last()});
  ASSERT_GT(mesh.update(view)->unmet, 0u);
  EXPECT_EQ(fault_of(mesh), "");
}

TEST(HostPriorities, ServeManyViews) {
  const Terrain terrain = hills();
  const HeightField& field = *terrain.field;
  HostPriorities named(field.lattice());
  Herd herd(field, 80, 12);
  for (uint64_t i = 0; i < 80; ++i) ASSERT_TRUE(named.add(NamedPoint{i, herd.at[i], 0.05}));
  std::vector<RoamMesh> meshes;
  for (size_t i = 0; i < 6; ++i) {
    meshes.push_back(make_mesh(terrain, 6000, i == 3));
    ASSERT_TRUE(meshes[i].set_priorities(&named));
  }
  std::vector<MeshUpdate> updates(meshes.size());
  int seen = 0;
  for (int frame = 0; frame < 40; ++frame) {
    herd.walk(field);
    for (uint64_t i = 0; i < 80; ++i) ASSERT_TRUE(named.move(NamedPoint{i, herd.at[i], 0.05}));
    for (size_t i = 0; i < meshes.size(); ++i) {
      updates[i].mesh = &meshes[i];
      updates[i].view = flight_view(field, frame + 30 * int(i));
      if (i % 2 == 0) updates[i].time_s = frame / 60.0;
    }
    // One of them misses every other update.
    const size_t count = meshes.size() - size_t(frame % 2);
    update_all(std::span(updates).first(count), 3);
    for (size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(updates[i].stats);
      ASSERT_EQ(updates[i].stats->unmet, 0u);
      const Standing s = standing(meshes[i], field, updates[i].view, herd.at);
      ASSERT_LE(s.farthest, 0.05);
      seen += s.seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

// Along the outer border, on corners and edges of root squares and cells, with padding.
TEST(HostPriorities, PointsOnBordersAndCornersAreHeld) {
  roam_support::TerrainOptions size;
  size.columns = 147;
  size.rows = 58;
  const Terrain terrain = make_terrain(size);
  const HeightField& field = *terrain.field;
  ASSERT_GT(field.root_squares().x, 1);
  HostPriorities named(field.lattice());
  std::vector<glm::dvec2> at;
  for (int column = 0; column < 147; column += 2)
    for (int row = 0; row < 58; row += column == 0 || column == 146 ? 1 : 19)
      at.push_back(field.world_xy(LatticePoint(column, row) * field.sample_step()));
  for (const double x : {field.min_corner().x, field.max_corner().x})
    for (int i = 0; i <= 20; ++i) at.push_back({x, glm::mix(field.min_corner().y, field.max_corner().y, i / 20.0)});
  // One at a time over a mesh that is coarse otherwise, so that no other refines what it needs.
  RoamOptions options;
  options.target_px = 1e6f;
  RoamMesh mesh = RoamMesh::create(*terrain.bounds, options).value();
  ASSERT_TRUE(mesh.set_priorities(&named));
  ASSERT_TRUE(named.add(NamedPoint{0, {0, 0}, 0}));
  const View view = View::look({0, 0, 3000}, 0, -1.55, 1.2, {1280, 720}, 1, 1e5);
  for (const glm::dvec2& xy : at) {
    ASSERT_TRUE(named.move(NamedPoint{0, xy, 0}));
    const auto stats = mesh.update(view);
    ASSERT_TRUE(stats);
    ASSERT_LT(stats->visible, 2000u);
    ASSERT_EQ(stats->unmet, 0u);
    const Standing s = standing(mesh, field, view, {xy});
    ASSERT_EQ(s.seen, 1);
    ASSERT_LT(s.farthest, 1e-6) << xy.x << ", " << xy.y;
  }
  EXPECT_EQ(fault_of(mesh), "");
}

}  // namespace
}  // namespace sward
