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

namespace {

std::vector<Plant> grow_seeding(const PlantGround& ground, const FixedTriangles& triangles, const Seeding& seeding) {
  std::vector<Plant> plants;
  for (const DensityBin& bin : seeding.bins) {
    for (uint32_t i = bin.first; i < bin.first + bin.triangles; ++i) {
      SWARD_ASSERT(seeding.source[i] < triangles.size(), "the seeding comes from other triangles");
      grow_triangle(ground, triangles, seeding.source[i], seeding.records[i], bin.clusters, SeedDistance::eye, plants);
    }
  }
  return plants;
}

}  // namespace

std::vector<Plant> grow_plants(const Layer& layer, const View& view, const ColorMap& map,
                               const FixedTriangles& triangles, const Seeding& seeding, float sun_azimuth,
                               const Disturbance* disturbance) {
  PlantGround ground = make_plant_ground(layer, view, map, sun_azimuth, seeding.exclusions);
  ground.disturbance = disturbance;
  ground.eye = glm::dvec2(view.eye);
  return grow_seeding(ground, triangles, seeding);
}

std::vector<Plant> grow_plants(const Layer& layer, const View& view, const FixedTriangles& triangles,
                               const Seeding& seeding) {
  SWARD_ASSERT(layer.on_mesh, "a layer on terrain grows by a base map");
  return grow_seeding(make_mesh_ground(layer, view), triangles, seeding);
}

}  // namespace sward
