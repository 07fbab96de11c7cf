// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/vegetation/mesh_surface.h>
#include <string>

namespace sward {

/// Reads OBJ, PLY or OFF; polygons are triangulated, vertex colours kept where the file has them for all vertices.
/// Fails, naming the file, on files that do not exist, that OpenMesh cannot read, and that have no faces. Corners that
/// are not finite and faces without area stay in: MeshSurface::create counts them. Silences OpenMesh's own messages,
/// for the whole process. One thread at a time: OpenMesh's readers are shared.
SWARD_API Expected<TriangleMesh> load_mesh(const std::string& path);

}  // namespace sward
