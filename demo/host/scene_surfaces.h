// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <sward/terrain/surface.h>
#include <sward/vegetation/mesh_surface.h>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sward::host {

/// A scene's surfaces, those of a layer in one mesh.
struct SceneSurfaces {
  std::map<std::string, std::shared_ptr<const MeshSurface>> by_layer;
  std::vector<std::string> warnings;  ///< What is odd about mesh files, a line each.
};

/// load_mesh(), or an error where this build reads no meshes.
Expected<TriangleMesh> load_mesh_file(const std::string& path);

/// Generates or loads the scene's surfaces and places them on the ground. Fails naming file or place.
Expected<SceneSurfaces> build_surfaces(const Scene& scene, const Surface& ground);

}  // namespace sward::host
