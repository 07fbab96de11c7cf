// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/vegetation/mesh_surface.h>
#include <string_view>

namespace sward {

struct MeshShapeOptions {
  glm::dvec3 size_m{1};  ///< East, north, up, each 0.2..200; the shape stands in the middle on z = 0 and reaches 0.3 m
                         ///< below, where it is open.
  uint32_t seed = 1;     ///< Of its unevenness.
};

/// A clipped body for plants to stand on, with leaf-green vertex colours, darker towards the ground. Deterministic.
///   "box_hedge"  a box with rounded edges, clipped by hand: its sides wave by a few centimetres
///   "topiary"    a cone with a ball on its top
/// Triangles of some 0.03 m2, larger in large shapes: at most 200 000. Fails on other names and sizes out of range.
SWARD_API Expected<TriangleMesh> generate_mesh_shape(std::string_view shape, const MeshShapeOptions& options);

/// A small plant for PlantKind::mesh, 1 m high, its root in the origin, with vertex colours.
///   "thistle"  a stem with spiny leaves and a purple head; 300 faces at most
/// Fails on other names.
SWARD_API Expected<TriangleMesh> generate_plant_shape(std::string_view shape);

}  // namespace sward
