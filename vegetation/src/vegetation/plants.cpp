// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/plants.h>

#include "vegetation/plant_grower.h"

namespace sward {

double surface_height(const FixedTriangles& triangles, const FixedTriangle& triangle, float a, float b) {
  const shared::SurfaceWalk walk = shared::begin_walk(0.0f, triangle.to_left.z, triangle.to_right.z, glm::vec2(a, b));
  const float z_offset = float(triangles.surface_z() - triangle.apex.z);
  return triangle.apex.z + double(walk_surface(triangles, triangle.surface, z_offset, walk));
}

std::vector<Plant> grow_plants(const Layer& layer, const View& view, const ColorMap& map,
                               const FixedTriangles& triangles, const Seeding& seeding, float sun_azimuth) {
  const PlantGround ground = make_plant_ground(layer, view, map, sun_azimuth, seeding.exclusions);
  std::vector<Plant> plants;
  for (const DensityBin& bin : seeding.bins) {
    for (uint32_t i = bin.first; i < bin.first + bin.triangles; ++i) {
      SWARD_ASSERT(seeding.source[i] < triangles.size(), "the seeding comes from other triangles");
      grow_triangle(ground, triangles, seeding.source[i], seeding.records[i], bin.clusters, SeedDistance::eye, plants);
    }
  }
  return plants;
}

}  // namespace sward
