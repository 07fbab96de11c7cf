// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/roam_mesh.h>
#include <span>
#include <string>

namespace sward::tool {

/// Triangles of a mesh (three vertex slots each) as a binary little-endian PLY file: vertices as double x y z, only
/// those in use, triangles counter-clockwise from above.
std::string make_ply(const RoamMesh& mesh, std::span<const uint32_t> indices);

}  // namespace sward::tool
