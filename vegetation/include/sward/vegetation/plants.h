// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/color_map.h>
#include <sward/vegetation/seeding.h>

namespace sward {

/// One plant as the GPU grows it; the CPU twin computes the same (CONTRACT: CPU and GPU twins).
struct Plant {
  TriangleId triangle;
  uint32_t rank = 0;
  uint32_t species = 0;    ///< Index in the layer.
  glm::dvec3 position{0};  ///< Root, world, metres; x, y the same in every view, z the drawn surface's.
  float height = 0, width = 0, stiffness = 0;  ///< Full-grown, before fade and widening; metres, metres, 0..1.
  float azimuth = 0;                           ///< Direction of bending, radians: 0 east, counter-clockwise.
  float score = 0;                             ///< s' of equation 18.
  float fade = 0;                              ///< 0..1: growing in, sinking.
};

/// All plants with fade > 0 of a seeded layer, in the order bins, triangles, ranks. Needs no GL context. The seeding
/// must come from the same layer, view, map and triangles. `sun_azimuth`: radians, 0 east, counter-clockwise; only
/// phototropic species ask for it. Cost: one look at the map a cluster and one a seed that is shown. Any thread.
std::vector<Plant> grow_plants(const Layer& layer, const View& view, const ColorMap& map,
                               const FixedTriangles& triangles, const Seeding& seeding, float sun_azimuth = 0.0f);

/// Drawn surface z (world) at the point `to_left * a + to_right * b` from the apex, a, b >= 0, a + b <= 1.
double surface_height(const FixedTriangles& triangles, const FixedTriangle& triangle, float a, float b);

}  // namespace sward
