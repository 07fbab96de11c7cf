// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_surfaces.h"

#include <sward/scene/generated_mesh.h>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#ifdef SWARD_MESH_SOURCE
#include <sward/mesh_source/mesh_source.h>
#endif

namespace sward::host {

#ifdef SWARD_MESH_SOURCE
Expected<TriangleMesh> load_mesh_file(const std::string& path) {
  return load_mesh(path);
}
#else
Expected<TriangleMesh> load_mesh_file(const std::string& path) {
  return fail(path + ": this build reads no meshes; configure it with SWARD_MESH_SOURCE=ON");
}
#endif

namespace {

Expected<TriangleMesh> make_mesh(const Scene& scene, const SceneSurface& surface) {
  if (!surface.shape.empty())
    return generate_mesh_shape(surface.shape, {.size_m = glm::dvec3(surface.size_m), .seed = surface.seed});
  return load_mesh_file(scene.resolve(surface.mesh_path));
}

Expected<double> ground_below(const SceneSurface& surface, const Surface& ground, glm::dvec2 place) {
  const double z = ground.height(place);
  if (std::isfinite(z)) return z;
  return fail("a surface of layer \"" + surface.layer + "\" stands at x " + std::to_string(place.x) + ", y " +
              std::to_string(place.y) + ", where there is no ground; move it or set above_ground = false");
}

Expected<void> place(const SceneSurface& surface, const Surface& ground, TriangleMesh& mesh) {
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), surface.yaw, glm::dvec3(0, 0, 1));
  mesh.transform(glm::translate(glm::dmat4(1.0), surface.position) * glm::scale(turned, glm::dvec3(surface.scale)));
  if (!surface.above_ground) return {};
  if (!surface.drape) {
    const auto z = ground_below(surface, ground, glm::dvec2(surface.position));
    if (!z) return tl::unexpected(z.error());
    mesh.transform(glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, *z)));
    return {};
  }
  for (glm::dvec3& p : mesh.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;  // MeshSurface leaves those out
    const auto z = ground_below(surface, ground, glm::dvec2(p));
    if (!z) return tl::unexpected(z.error());
    p.z += *z;
  }
  return {};
}

/// One of the scene's surfaces, placed and painted.
Expected<TriangleMesh> build(const Scene& scene, const SceneSurface& surface, const Surface& ground,
                             std::vector<std::string>& warnings) {
  auto mesh = make_mesh(scene, surface);
  if (!mesh) return mesh;
  if (surface.color) mesh->paint(glm::u8vec3(glm::round(*surface.color * 255.0f)));
  if (!surface.mesh_path.empty()) {
    const std::string path = scene.resolve(surface.mesh_path);
    if (mesh->colors.empty())
      return fail(path + ": the mesh has no vertex colours, and plants are chosen by them; set color = \"#rrggbb\"");
    auto checked = MeshSurface::create(*mesh);
    if (!checked) return fail(path + ": " + checked.error().message);
    const std::string odd = checked->report().text();
    if (!odd.empty()) warnings.push_back(path + ": " + odd);
  }
  if (auto placed = place(surface, ground, *mesh); !placed) return tl::unexpected(placed.error());
  return mesh;
}

}  // namespace

Expected<SceneSurfaces> build_surfaces(const Scene& scene, const Surface& ground) {
  SceneSurfaces surfaces;
  std::map<std::string, TriangleMesh> meshes;
  for (const SceneSurface& surface : scene.surfaces) {
    auto mesh = build(scene, surface, ground, surfaces.warnings);
    if (!mesh) return tl::unexpected(mesh.error());
    meshes[surface.layer].append(*mesh);
  }
  for (const auto& [layer, mesh] : meshes) {
    auto surface = MeshSurface::create(mesh);
    if (!surface) return fail("the surfaces of layer \"" + layer + "\": " + surface.error().message);
    surfaces.by_layer[layer] = std::make_shared<const MeshSurface>(std::move(*surface));
  }
  return surfaces;
}

}  // namespace sward::host
