// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/surface.h>
#include <sward/vegetation/disturbance.h>
#include <sward/vegetation/seeding.h>

namespace sward {

/// One plant as the GPU grows it; the CPU twin computes the same (CONTRACT: CPU and GPU twins).
struct Plant {
  TriangleId triangle;
  uint32_t rank = 0;
  uint32_t species = 0;    ///< Index in the layer.
  glm::dvec3 position{0};  ///< Root, world, metres; x, y the same in every view, z the drawn surface's.
  float height = 0, width = 0, stiffness = 0;  ///< Full-grown, before fade and widening, as cut, burnt and pressed;
                                               ///< metres, metres, 0..1. 0 m: cut to the ground.
  float azimuth = 0;                           ///< Direction of bending, radians: 0 east, counter-clockwise.
  float score = 0;                             ///< s' of equation 18.
  float fade = 0;                              ///< 0..1: growing in, sinking.
  glm::vec3 axis{0, 0, 1};  ///< Along which it grows, unit: world up on terrain, the surface's normal on a mesh, where
                            ///< azimuth counts from downhill, and counter-clockwise seen against the axis.
};

/// All plants with fade > 0 of a seeded layer, in the order bins, triangles, ranks. Needs no GL context. The seeding
/// must come from the same layer, view, map and triangles. `sun_azimuth`: radians, 0 east, counter-clockwise; only
/// phototropic species ask for it. `disturbance`: what has touched the ground, as it is drawn around the view's eye;
/// null: nothing; plants keep ids and places. Cost: one look at the map a cluster and one a seed that is shown. Any
/// thread, while the disturbance is not touched.
SWARD_API std::vector<Plant> grow_plants(const Layer& layer, const View& view, const ColorMap& map,
                                         const FixedTriangles& triangles, const Seeding& seeding,
                                         float sun_azimuth = 0.0f, const Disturbance* disturbance = nullptr);

/// The same for a layer on a mesh, whose colours the seeding holds.
SWARD_API std::vector<Plant> grow_plants(const Layer& layer, const View& view, const FixedTriangles& triangles,
                                         const Seeding& seeding);

/// A part of the world seen from above: a rectangle, or a disc.
struct SWARD_API PlantRegion {
  glm::dvec2 low{0}, high{0};  ///< Western, southern and eastern, northern corner, metres; of a disc its bounds.
  double radius_m = 0;         ///< > 0: a disc in the middle of them.

  static PlantRegion rectangle(glm::dvec2 low, glm::dvec2 high) { return {low, high, 0.0}; }
  static PlantRegion disc(glm::dvec2 centre, double radius_m) {
    return {centre - radius_m, centre + radius_m, radius_m};
  }
  bool contains(glm::dvec2 place) const;
};

struct PlantQueryOptions {
  size_t most_plants = 1000000;            ///< More are an error.
  const Exclusions* exclusions = nullptr;  ///< As given to seed().
  float sun_azimuth = 0.0f;                ///< Radians; only phototropic species ask for it.
  const Disturbance* disturbance = nullptr;  ///< As plants next to the eye have it: what is mown is as high as that.
};

/// The plants whose roots lie in a region at full density, z from the finest data: exactly those that the GPU draws near
/// by under the distance law; under the other laws as many as the ceiling lets, of which a view may draw fewer. Needs neither a view nor a context. Order: triangles, ranks.
/// Over a world the data are those that are resident. Fails on a layer that does not validate or lacks maps, on a
/// region that is empty or not finite, and where more than `most_plants` stand there or more than 64 times as many
/// would have to be looked at. Cost: that of grow_plants for the region's triangles, and three heights each. Any
/// thread, while the surface does not change.
SWARD_API Expected<std::vector<Plant>> query_plants(const Layer& layer, const Surface& surface, const ColorMap& map,
                                                    const PlantRegion& region, const PlantQueryOptions& options = {});

/// The plants of a layer on a mesh whose roots lie below or above a region, at full density. As query_plants else.
SWARD_API Expected<std::vector<Plant>> query_plants(const Layer& layer, const MeshSurface& surface,
                                                    const PlantRegion& region, const PlantQueryOptions& options = {});

/// Drawn surface z (world) at the point `to_left * a + to_right * b` from the apex, a, b >= 0, a + b <= 1.
SWARD_API double surface_height(const FixedTriangles& triangles, const FixedTriangle& triangle, float a, float b);

}  // namespace sward
