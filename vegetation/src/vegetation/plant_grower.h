// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The CPU twin of classification and growth, a triangle at a time.
#include <sward/vegetation/plants.h>
#include <optional>
#include <span>
#include <vector>

#include "vegetation/layer_params.h"

namespace sward {

/// One layer over one map, as the shaders' uniforms and textures have it. Keeps references to all that it is made from.
struct PlantGround {
  const ColorMap* map;  ///< The distribution map, where the layer has one; null: a mesh, whose records carry colours.
  shared::LayerParams layer;
  std::vector<shared::SpeciesParams> species;
  std::vector<const GrayMap*> masks;
  std::vector<glm::vec4> mask_headers;
  std::span<const glm::vec4> exclusions;  ///< Seeding::exclusions.
  const Disturbance* disturbance = nullptr;
  std::optional<glm::dvec2> eye = {};  ///< That the disturbance is drawn around; none: it is next to each plant.
};
PlantGround make_mesh_ground(const Layer& layer, const View& view);
PlantGround make_plant_ground(const Layer& layer, const View& view, const ColorMap& map, float sun_azimuth,
                              std::span<const glm::vec4> exclusions);

enum class SeedDistance {
  eye,   ///< Of each seed, as the shaders have it.
  near,  ///< 0: everything at full density.
};

/// Appends the plants of triangle i, whose record is given, by ranks.
void grow_triangle(const PlantGround& ground, const FixedTriangles& triangles, size_t i, const TriangleRecord& record,
                   uint32_t clusters, SeedDistance distance, std::vector<Plant>& plants);

/// Descends the drawn surface below a triangle; `z_offset` is added to the nodes' heights.
float walk_surface(const FixedTriangles& triangles, uint32_t node, float z_offset, shared::SurfaceWalk walk);

}  // namespace sward
