// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Updates allocate nothing once they have seen a flight.
#include <gtest/gtest.h>

#include "counted_allocations.h"
#include "roam_support.h"

namespace sward {
namespace {

View view_of(const HeightField& field, int frame) {
  // A round that ends where it began.
  const double a = 6.283185307179586 * frame / 300;
  const glm::dvec2 xy = 500.0 * glm::dvec2(std::cos(a), std::sin(a));
  return View::look({xy, field.height(xy) + 12 + 8 * std::sin(3 * a)}, a + 1.6, -0.2, 0.9, {1280, 720}, 0.5, 1e5);
}

// Objects and a line of sight that go round with the camera.
void move_named(HostPriorities& named, const HeightField& field, int frame) {
  const double a = 6.283185307179586 * frame / 300;
  glm::dvec3 last(0);
  for (uint64_t i = 0; i < 30; ++i) {
    const double angle = a + 0.2 * double(i);
    const glm::dvec2 xy = (300.0 + 10 * double(i)) * glm::dvec2(std::cos(angle), std::sin(angle));
    const glm::dvec3 here(xy, field.height(xy) + 2);
    const NamedPoint point{i, xy, 0.1};
    const NamedLine line{1000, here, last};
    EXPECT_TRUE(named.contains(i) ? named.move(point) : named.add(point));
    EXPECT_TRUE(named.contains(1000) ? named.move(line) : named.add(line));
    last = here;
  }
}

// Allocations in the last of several rounds.
long last_round(const RoamOptions& options, bool timed, bool names = false) {
  roam_support::TerrainOptions size;
  size.columns = size.rows = 129;
  const roam_support::Terrain terrain = roam_support::make_terrain(size);
  RoamMesh mesh = RoamMesh::create(*terrain.bounds, options).value();
  HostPriorities named(terrain.field->lattice());
  EXPECT_TRUE(mesh.set_priorities(&named));
  long before = 0;
  uint32_t changes = 0;
  for (int frame = 0; frame < 1200; ++frame) {
    if (frame == 900) before = g_allocations;
    const View view = view_of(*terrain.field, frame % 300);
    if (names) move_named(named, *terrain.field, frame % 300);
    const auto stats = timed ? mesh.update(view, frame / 60.0) : mesh.update(view);
    EXPECT_TRUE(stats.has_value());
    if (frame >= 900) changes += stats->splits + stats->merges;
  }
  EXPECT_GT(changes, 1000u);
  return g_allocations - before;
}

TEST(RoamMemory, UpdatesAllocateNothingInSteadyState) {
  RoamOptions options;
  options.max_triangles = 2000;
  EXPECT_EQ(last_round(options, false), 0);
  EXPECT_EQ(last_round(options, true), 0);
  EXPECT_EQ(last_round(options, true, true), 0);
  options.plain = true;
  EXPECT_EQ(last_round(options, false), 0);
}

}  // namespace
}  // namespace sward
