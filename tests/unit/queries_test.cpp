// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/queries.h>
#include <sward/terrain/roam_mesh.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>

#include "unit/field_reference.h"

using namespace field_reference;
using sward::Bounds;
using sward::HeightFieldDesc;
using sward::Ray;
using sward::RayHit;
using sward::Sight;
using sward::SightResult;
using sward::TerrainQueries;

namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

struct Ground {
  std::unique_ptr<HeightField> field;
  std::unique_ptr<Bounds> bounds;
  TerrainQueries queries() const { return TerrainQueries(*bounds); }
};

struct Shape {
  int columns = 65, rows = 65;
  bool relief = true;
  glm::dvec2 spacing{4.0, 6.0};
  glm::dvec3 origin{0.0};
  bool holes = false;
};

Ground make(const Shape& shape, std::vector<float> heights = {}) {
  HeightFieldDesc desc;
  desc.columns = shape.columns;
  desc.rows = shape.rows;
  desc.spacing = shape.spacing;
  desc.origin = shape.origin;
  desc.relief.enabled = shape.relief;
  desc.relief.roughness = 0.1f;
  if (heights.empty()) heights = rough_heights(shape.columns, shape.rows, 8);
  std::vector<uint8_t> holes;
  if (shape.holes) {
    std::mt19937 random(4);
    holes.assign(heights.size(), 0);
    for (int row = 0; row < shape.rows; ++row) {
      for (int column = 0; column < shape.columns; ++column) {
        const bool lake = std::hypot(column - shape.columns / 3, row - shape.rows / 2) < shape.rows / 6.0;
        holes[size_t(row) * size_t(shape.columns) + size_t(column)] = lake || random() % 40 == 0 ? 1 : 0;
      }
    }
  }
  auto field = HeightField::create(desc, std::move(heights), holes);
  if (!field) throw std::runtime_error(field.error().message);
  Ground ground;
  ground.field = std::make_unique<HeightField>(std::move(*field));
  ground.bounds = std::make_unique<Bounds>(Bounds::create(*ground.field));
  return ground;
}

// The ray cut wherever it crosses an edge of the finest triangles; between cuts the surface is linear along it. Only
// HeightField::height is asked.
class Cuts {
 public:
  Cuts(const HeightField& field, glm::dvec3 from, glm::dvec3 unit, double length)
      : field_(field), from_(from), unit_(unit) {
    const glm::dvec2 low = field.min_corner(), high = field.max_corner();
    const double step = double(field.sample_step());
    origin_ = glm::dvec2(from_.x - low.x, high.y - from_.y) / field.desc().spacing * step;
    direction_ = glm::dvec2(unit.x, -unit.y) / field.desc().spacing * step;
    double begin = 0.0, end = length;
    const glm::dvec2 last(field.lattice().last());
    for (int i = 0; i < 2; ++i) {
      if (direction_[i] == 0.0) {
        if (origin_[i] < 0.0 || origin_[i] > last[i]) end = -1.0;
        continue;
      }
      const double a = -origin_[i] / direction_[i], b = (last[i] - origin_[i]) / direction_[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (!(begin <= end)) return;
    if (end == k_infinity) end = 1e5;  // Vertical: above and below all heights here.
    t_ = {begin, end};
    const double side = double(sward::k_root_side >> (field.max_level() / 2));
    for (const glm::dvec2 normal : {glm::dvec2(1, 0), {0, 1}, {1, 1}, {1, -1}}) {
      const double offset = glm::dot(origin_, normal), rate = glm::dot(direction_, normal);
      if (std::abs(rate) < 1e-9) continue;
      const double a = (offset + begin * rate) / side, b = (offset + end * rate) / side;
      for (double k = std::ceil(std::min(a, b)); k <= std::max(a, b); k += 1.0) {
        t_.push_back(std::clamp((k * side - offset) / rate, begin, end));
      }
    }
    std::sort(t_.begin(), t_.end());
  }

  const std::vector<double>& t() const { return t_; }
  glm::dvec3 point(double t) const { return from_ + t * unit_; }
  double above(double t) const {
    const glm::dvec3 p = point(t);
    return p.z - field_.height(glm::clamp(glm::dvec2(p), field_.min_corner(), field_.max_corner()));
  }
  // In a data triangle with a hole at a corner.
  bool hole(double t) const {
    const glm::dvec2 place = (origin_ + t * direction_) / double(field_.sample_step());
    const glm::ivec2 cell = glm::clamp(glm::ivec2(glm::floor(place)), glm::ivec2(0),
                                       glm::ivec2(field_.desc().columns - 2, field_.desc().rows - 2));
    const glm::dvec2 uv = place - glm::dvec2(cell);
    const auto at = [&](int i, int j) { return field_.is_hole(cell.x + i, cell.y + j); };
    if ((cell.x + cell.y) % 2 == 0) return at(0, 0) || at(1, 1) || (uv.x > uv.y ? at(1, 0) : at(0, 1));
    return at(1, 0) || at(0, 1) || (uv.x + uv.y < 1.0 ? at(0, 0) : at(1, 1));
  }
  bool hole_between(size_t i) const { return hole(0.5 * (t_[i] + t_[i + 1])); }

 private:
  const HeightField& field_;
  glm::dvec3 from_, unit_;
  glm::dvec2 origin_, direction_;
  std::vector<double> t_;
};

double zero_between(double t0, double d0, double t1, double d1) {
  return d0 == d1 ? t0 : t0 + std::clamp(d0 / (d0 - d1), 0.0, 1.0) * (t1 - t0);
}

// Distance of the nearest hit; infinite without.
double reference_ray(const Cuts& cuts, double touch = 1e-9) {
  for (size_t i = 0; i + 1 < cuts.t().size(); ++i) {
    if (cuts.hole_between(i)) continue;
    const double t0 = cuts.t()[i], t1 = cuts.t()[i + 1], d0 = cuts.above(t0), d1 = cuts.above(t1);
    if (std::min(d0, d1) > touch || std::max(d0, d1) < -touch) continue;
    return std::abs(d0) <= touch ? t0 : zero_between(t0, d0, t1, d1);
  }
  return k_infinity;
}

double reference_sight(const Cuts& cuts) {
  for (size_t i = 0; i + 1 < cuts.t().size(); ++i) {
    if (cuts.hole_between(i)) continue;
    const double t0 = cuts.t()[i], t1 = cuts.t()[i + 1], d0 = cuts.above(t0), d1 = cuts.above(t1);
    if (std::min(d0, d1) >= -1e-6) continue;
    return d0 < -1e-6 ? t0 : zero_between(t0, d0, t1, d1);
  }
  return k_infinity;
}

struct Tally {
  int rays = 0, hits = 0, touches = 0;
};

// A ray against the reference. Where they differ, both must have it within 1e-6 m of the surface: a touch.
void check_ray(const Ground& g, const Ray& ray, Tally& tally) {
  const std::optional<RayHit> hit = g.queries().ray(ray);
  const glm::dvec3 unit = glm::normalize(ray.direction);
  const Cuts cuts(*g.field, ray.origin, unit, ray.max_distance);
  const double expected = reference_ray(cuts);
  ++tally.rays;
  const double found = hit ? hit->distance : k_infinity;
  if (hit) {
    ++tally.hits;
    ASSERT_LE(std::abs(cuts.above(found)), 1e-6) << "ray " << tally.rays;
    ASSERT_LE(glm::distance(hit->point, cuts.point(found)), 1e-9);
    ASSERT_LE(found, ray.max_distance + 1e-9);
    ASSERT_NEAR(glm::length(hit->normal), 1.0, 1e-12);
    ASSERT_GT(hit->normal.z, 0.0);
  }
  if (found == expected || std::abs(found - expected) < 1e-5) return;
  ++tally.touches;
  if (expected < found) {
    ASSERT_LE(std::abs(cuts.above(expected)), 1e-6) << "missed by ray " << tally.rays;
  }
  // The nearer one may be missed only if the surface is not crossed there.
  const double again = reference_ray(cuts, expected < found ? 0.0 : 1e-6);
  ASSERT_TRUE(again == found || std::abs(again - found) < 1e-3)
      << "ray " << tally.rays << ": " << found << " against " << expected << ", " << again;
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random) * 0.5};
}

glm::dvec3 random_point(const Ground& g, std::mt19937& random, double margin = 0.3) {
  const glm::dvec2 low = g.field->min_corner(), size = g.field->max_corner() - low, z = g.field->height_range();
  std::uniform_real_distribution<double> uniform(-margin, 1.0 + margin);
  return {low + size * glm::dvec2(uniform(random), uniform(random)), z[0] + (z[1] - z[0]) * uniform(random)};
}

void check_random_rays(const Ground& g, int count) {
  std::mt19937 random(12);
  Tally tally;
  for (int i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
    Ray ray{random_point(g, random, 0.1), random_direction(random)};
    // Half of them are sent towards the field.
    if (i % 2 == 0) ray.direction = random_point(g, random, 0.0) - ray.origin;
    if (random() % 4 == 0) ray.max_distance = double(random() % 300);
    check_ray(g, ray, tally);
  }
  EXPECT_GT(tally.hits, count / 5);
  EXPECT_LT(tally.hits, count);
  EXPECT_LE(tally.touches, count / 100);
}

TEST(Rays, AgreeWithTheFinestSurface) {
  check_random_rays(make({}), 1500);
}
TEST(Rays, AgreeWithTheFinestSurfaceWithoutRelief) {
  check_random_rays(make({.relief = false}), 6000);
}
TEST(Rays, AgreeOverSeveralRootSquaresAndPadding) {
  const Ground g = make({.columns = 130, .rows = 70, .relief = false});
  ASSERT_GT(g.field->root_squares().x * g.field->root_squares().y, 1);
  check_random_rays(g, 4000);
  check_random_rays(make({.columns = 47, .rows = 90}), 1000);
}
TEST(Rays, AgreeFarFromTheOrigin) {
  check_random_rays(make({.relief = false, .origin = {1.0e6, -2.0e6, 500.0}}), 2000);
}
TEST(Rays, PassThroughHoles) {
  check_random_rays(make({.relief = false, .holes = true}), 4000);
  check_random_rays(make({.holes = true}), 1000);
  // Straight down into the lake.
  const Ground g = make({.relief = false, .holes = true});
  const glm::dvec2 lake = g.field->world_xy(LatticePoint(65 / 3, 65 / 2) * g.field->sample_step());
  EXPECT_FALSE(g.queries().ray({{lake, 1e4}, {0, 0, -1}}));
  EXPECT_FALSE(std::isnan(g.queries().height(lake)));
}

TEST(Rays, FromFarOutsideTheField) {
  const Ground g = make({.relief = false});
  std::mt19937 random(5);
  Tally tally;
  for (int i = 0; i < 3000 && !HasFatalFailure(); ++i) {
    const glm::dvec3 target = random_point(g, random, 0.0), way = glm::normalize(random_direction(random));
    check_ray(g, {target - 5.0e4 * way, way}, tally);
  }
  EXPECT_GT(tally.hits, 1000);
}

// Straight up and down, through samples, edges and anywhere.
TEST(Rays, Vertical) {
  const Ground g = make({.columns = 70, .rows = 45});
  std::mt19937 random(6);
  const int step = g.field->sample_step();
  for (int i = 0; i < 4000; ++i) {
    LatticePoint p(int(random() % uint32_t(69 * step + 1)), int(random() % uint32_t(44 * step + 1)));
    if (i % 4 == 0) p.x = p.x / step * step;
    if (i % 3 == 0) p.y = p.y / step * step;
    const glm::dvec2 xy = g.field->world_xy(p);
    const double z = g.field->height(xy);
    const bool down = random() % 2 == 0;
    const auto hit = g.queries().ray({{xy, z + (down ? 700.0 : -700.0)}, {0, 0, down ? -2.0 : 2.0}});
    ASSERT_TRUE(hit) << i;
    ASSERT_NEAR(hit->distance, 700.0, 1e-6);
    ASSERT_NEAR(hit->point.z, z, 1e-6);
    const auto away = g.queries().ray({{xy, z + (down ? 1.0 : -1.0)}, {0, 0, down ? 2.0 : -2.0}});
    ASSERT_FALSE(away);
  }
}

TEST(Rays, AlongTheLattice) {
  const Ground g = make({.columns = 66, .rows = 40});
  std::mt19937 random(7);
  const int step = g.field->sample_step();
  Tally tally;
  const glm::dvec2 spacing = g.field->desc().spacing;
  for (int i = 0; i < 1500 && !HasFatalFailure(); ++i) {
    const LatticePoint p(int(random() % 66) * step, int(random() % 40) * step);
    const double z = g.field->height(p) + double(random() % 1000) * 0.02 - 10.0;
    const glm::dvec2 ways[] = {
        {1, 0}, {-1, 0}, {0, 1}, {0, -1}, spacing, -spacing, spacing * glm::dvec2(1, -1), spacing * glm::dvec2(-1, 1)};
    const double rise = i % 2 == 0 ? 0.0 : 1e-2 * (double(random() % 100) - 50.0);
    check_ray(g, {{g.field->world_xy(p), z}, {ways[random() % 8], rise}}, tally);
  }
  EXPECT_GT(tally.hits, 500);
}

// In the surface of a finest triangle, and close above flat ground.
TEST(Rays, Grazing) {
  const Ground g = make({.columns = 40, .rows = 40});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(0.0, 6.28);
  Tally tally;
  for (int i = 0; i < 2000 && !HasFatalFailure(); ++i) {
    const glm::dvec2 xy = random_point(g, random, -0.02);
    const glm::dvec3 normal = g.field->normal(xy);
    const double a = angle(random);
    glm::dvec3 way(std::cos(a), std::sin(a), 0.0);
    way.z = -(normal.x * way.x + normal.y * way.y) / normal.z;
    const double lift = i % 2 == 0 ? 0.0 : 1e-3;
    check_ray(g, {glm::dvec3(xy, g.field->height(xy) + lift) - 3.0 * way, way}, tally);
  }
  EXPECT_GT(tally.hits, 1000);

  const Ground flat = make({.relief = false}, std::vector<float>(65 * 65, 3.0f));
  EXPECT_FALSE(flat.queries().ray({{-100, 7, 3.001}, {1, 0.1, 0}}));
  EXPECT_FALSE(flat.queries().ray({{-100, 7, 2.999}, {1, 0.1, 0}}));
  const auto along = flat.queries().ray({{-1000, 7, 3.0}, {1, 0, 0}});
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->point.x, flat.field->min_corner().x, 1e-9);
}

TEST(Rays, StartOnTheSurfaceHitsIt) {
  const Ground g = make({});
  std::mt19937 random(10);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 xy = random_point(g, random, -0.01);
    const auto hit = g.queries().ray({{xy, g.field->height(xy)}, random_direction(random)});
    ASSERT_TRUE(hit);
    ASSERT_LE(hit->distance, 1e-6);
    ASSERT_LE(glm::distance(hit->normal, g.field->normal(xy)), 1e-6);
  }
}

TEST(Rays, LengthOfTheDirectionDoesNotMatter) {
  const Ground g = make({});
  const auto hit = g.queries().ray({{1, 2, 500}, {0.03, 0.02, -1}});
  ASSERT_TRUE(hit);
  for (const double scale : {1e-308, 1e-200, 1e-3, 1e6, 1e300}) {
    const auto scaled = g.queries().ray({{1, 2, 500}, glm::dvec3(0.03, 0.02, -1) * scale});
    ASSERT_TRUE(scaled) << scale;
    EXPECT_NEAR(scaled->distance, hit->distance, 1e-9);
  }
  EXPECT_TRUE(g.queries().ray({{1, 2, 500}, {0.03, 0.02, -1}, hit->distance + 1e-6}));
  EXPECT_FALSE(g.queries().ray({{1, 2, 500}, {0.03, 0.02, -1}, hit->distance - 1e-6}));
}

TEST(Rays, WhatIsNotARayHitsNothing) {
  const Ground g = make({});
  const glm::dvec3 good(1, 2, 500), down(0, 0, -1);
  ASSERT_TRUE(g.queries().ray({good, down}));
  for (int i = 0; i < 3; ++i) {
    for (const double bad : {k_nan, k_infinity, -k_infinity}) {
      glm::dvec3 origin = good, way = down;
      origin[i] = bad;
      EXPECT_FALSE(g.queries().ray({origin, down}));
      way[i] = bad;
      EXPECT_FALSE(g.queries().ray({good, way}));
      const SightResult sight = g.queries().line_of_sight({good, origin});
      EXPECT_FALSE(sight.visible);
      EXPECT_TRUE(std::isnan(sight.blocked_at.x));
    }
  }
  EXPECT_FALSE(g.queries().ray({good, {0, 0, 0}}));
  EXPECT_FALSE(g.queries().ray({good, down, k_nan}));
  EXPECT_FALSE(g.queries().ray({good, down, -1.0}));
  EXPECT_TRUE(std::isnan(g.queries().height({k_nan, 0})));
  EXPECT_TRUE(std::isnan(g.queries().height({1e9, 0})));
  EXPECT_EQ(g.queries().normal({0, k_nan}), glm::dvec3(0, 0, 1));
  EXPECT_FALSE(g.queries().ray({{1e308, -1e308, 1e308}, {1e308, 1e308, 1e-308}}));
  EXPECT_FALSE(g.queries().line_of_sight({{1e308, 0, 0}, {-1e308, 0, 0}}).visible);
}

void check_sights(const Ground& g, int count, double margin) {
  std::mt19937 random(14);
  int visible = 0, touches = 0;
  for (int i = 0; i < count; ++i) {
    Sight sight{random_point(g, random, margin), random_point(g, random, margin)};
    // Half of them stand on the ground or a little above.
    for (glm::dvec3* end : {&sight.from, &sight.to}) {
      const double z = g.field->height(glm::dvec2(*end));
      if (random() % 2 == 0 && !std::isnan(z)) end->z = z + (random() % 2 == 0 ? 0.0 : 20.0);
    }
    const SightResult result = g.queries().line_of_sight(sight);
    const double length = glm::distance(sight.from, sight.to);
    const Cuts cuts(*g.field, sight.from, (sight.to - sight.from) / length, length);
    const double expected = reference_sight(cuts);
    visible += result.visible ? 1 : 0;
    if (result.visible != (expected == k_infinity)) {
      // Within rounding of the depth that is forgiven.
      double deepest = 0.0;
      for (const double t : cuts.t()) deepest = std::min(deepest, cuts.above(t));
      ASSERT_NEAR(deepest, -1e-6, 1e-7) << i;
      ++touches;
      continue;
    }
    if (result.visible) {
      ASSERT_TRUE(std::isnan(result.blocked_at.x));
    } else {
      ASSERT_NEAR(glm::distance(result.blocked_at, sight.from), expected, 1e-3) << i;
    }
  }
  EXPECT_GT(visible, count / 20);
  EXPECT_LT(visible, count * 19 / 20);
  EXPECT_LT(touches, 5);
}

TEST(Sights, AgreeWithTheFinestSurface) {
  check_sights(make({}), 1500, 0.1);
}
TEST(Sights, AgreeOverSeveralRootSquaresAndPadding) {
  check_sights(make({.columns = 130, .rows = 70, .relief = false}), 4000, 0.2);
}
TEST(Sights, AgreeWithHoles) {
  check_sights(make({.relief = false, .holes = true}), 4000, 0.1);
}

TEST(Sights, OverARidge) {
  std::vector<float> heights(33 * 33, 0.0f);
  for (int row = 0; row < 33; ++row) heights[size_t(row * 33 + 16)] = 10.0f;
  const Ground g = make({.columns = 33, .rows = 33, .relief = false, .spacing = {2, 2}}, heights);
  const TerrainQueries queries = g.queries();
  EXPECT_TRUE(queries.line_of_sight({{-20, 1, 10.0}, {20, 1, 10.0}}).visible);
  const SightResult low = queries.line_of_sight({{-20, 1, 5.0}, {20, 1, 5.0}});
  EXPECT_FALSE(low.visible);
  EXPECT_NEAR(glm::distance(low.blocked_at, glm::dvec3(-1, 1, 5)), 0.0, 1e-9);
  // On the ground, to itself, in the ground.
  EXPECT_TRUE(queries.line_of_sight({{-20, 1, 0}, {-4, 5, 0}}).visible);
  EXPECT_TRUE(queries.line_of_sight({{-20, 1, 0}, {-20, 1, 0}}).visible);
  EXPECT_FALSE(queries.line_of_sight({{-20, 1, -1}, {-20, 1, -1}}).visible);
  EXPECT_NEAR(queries.line_of_sight({{-20, 1, -1}, {-20, 1, 9}}).blocked_at.z, -1.0, 1e-12);
  EXPECT_NEAR(queries.line_of_sight({{-20, 1, 9}, {-20, 1, -1}}).blocked_at.z, 0.0, 1e-9);
  // Beyond the data there is no ground.
  EXPECT_TRUE(queries.line_of_sight({{-90, 1, -50}, {-40, 1, -50}}).visible);
}

TEST(Queries, BatchesAreTheSingleAnswers) {
  const Ground g = make({.columns = 90, .rows = 70});
  const TerrainQueries queries = g.queries();
  std::mt19937 random(15);
  const size_t count = 5003;
  std::vector<Ray> rays(count);
  std::vector<Sight> sights(count);
  std::vector<glm::dvec2> places(count * 8);
  for (size_t i = 0; i < count; ++i) {
    rays[i] = {random_point(g, random), random_direction(random)};
    sights[i] = {random_point(g, random), random_point(g, random)};
  }
  for (glm::dvec2& place : places) place = random_point(g, random, 0.05);
  places[7] = glm::dvec2(k_nan);
  for (const int threads : {1, 3, 0}) {
    std::vector<std::optional<RayHit>> hits(count);
    std::vector<SightResult> seen(count);
    std::vector<double> heights(places.size());
    std::vector<glm::dvec3> normals(places.size());
    queries.rays(rays, hits, threads);
    queries.lines_of_sight(sights, seen, threads);
    queries.heights(places, heights, threads);
    queries.normals(places, normals, threads);
    for (size_t i = 0; i < count; ++i) {
      const auto hit = queries.ray(rays[i]);
      ASSERT_EQ(hit.has_value(), hits[i].has_value());
      if (hit) {
        ASSERT_EQ(hit->distance, hits[i]->distance);
      }
      ASSERT_EQ(queries.line_of_sight(sights[i]).visible, seen[i].visible);
    }
    for (size_t i = 0; i < places.size(); ++i) {
      const double z = g.field->height(places[i]);
      ASSERT_TRUE(heights[i] == z || (std::isnan(z) && std::isnan(heights[i])));
      ASSERT_EQ(normals[i], g.field->normal(places[i]));
    }
  }
  queries.rays({}, {});
}

// The thread sanitizer watches this one.
TEST(Queries, AnswerWhileAMeshUpdates) {
  const Ground g = make({});
  auto mesh = sward::RoamMesh::create(*g.bounds, {.max_triangles = 3000});
  ASSERT_TRUE(mesh);
  std::atomic<bool> done{false};
  std::thread updates([&] {
    for (int i = 0; i < 60; ++i) {
      const glm::dvec3 eye(-100.0 + 3.0 * i, 20.0, g.field->height_range()[1] + 10.0);
      if (!mesh->update(sward::View::look(eye, 0.1 * i, -0.4, 1.0, {640, 480}, 0.5, 2000))) break;
    }
    done = true;
  });
  std::mt19937 random(16);
  std::vector<Ray> rays(600);
  for (Ray& ray : rays) ray = {random_point(g, random), random_direction(random)};
  std::vector<std::optional<RayHit>> first(rays.size()), again(rays.size());
  g.queries().rays(rays, first, 2);
  do {
    g.queries().rays(rays, again, 2);
  } while (!done);
  updates.join();
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(first[i].has_value(), again[i].has_value());
    if (first[i]) {
      ASSERT_EQ(first[i]->distance, again[i]->distance);
    }
  }
}

}  // namespace
