// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Of PlantKind::mesh: what growth reads of a small mesh.
#include <sward/vegetation/species.h>
#include <string>
#include <vector>

namespace sward {

/// Empty where the mesh can be grown, else what is wrong with it. A mesh that is not there is not wrong.
std::string fault_of(const PlantMesh& plant);

/// Faces that have an area.
int face_count(const PlantMesh& plant);

/// Texels of shaders/mesh_plant.geom.glsl, six a face, in a random order that is always the same: any first share of
/// them stands for all. The mesh must have no fault.
std::vector<glm::vec4> make_mesh_texels(const PlantMesh& plant);

}  // namespace sward
