// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/mesh_source/mesh_source.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#pragma GCC diagnostic pop

#include <exception>
#include <filesystem>

namespace sward {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolygonMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

std::vector<glm::dvec3> world_corners(const PolygonMesh& mesh, const glm::dmat4& world_from_mesh) {
  std::vector<glm::dvec3> corners;
  corners.reserve(mesh.n_faces() * 3);
  for (const auto face : mesh.faces()) {
    for (const auto vertex : mesh.fv_range(face)) {
      const auto& p = mesh.point(vertex);
      corners.emplace_back(world_from_mesh * glm::dvec4(p[0], p[1], p[2], 1.0));
    }
  }
  return corners;
}

Expected<PolygonMesh> read(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return fail(path + ": no such mesh file");
  PolygonMesh mesh;
  ::omerr().disable();
  ::omlog().disable();
  try {
    if (!OpenMesh::IO::read_mesh(mesh, path)) {
      return fail(path + ": cannot be read as a mesh; OBJ, PLY and OFF files are understood");
    }
  } catch (const std::exception& e) {
    return fail(path + ": cannot be read as a mesh: " + e.what());
  }
  mesh.triangulate();
  return mesh;
}

}  // namespace

Expected<MeshSource> MeshSource::load(const std::string& path, const glm::dmat4& world_from_mesh) {
  auto mesh = read(path);
  if (!mesh) return tl::unexpected(mesh.error());
  auto source = from_corners(world_corners(*mesh, world_from_mesh));
  if (!source) return fail(path + ": " + source.error().message);
  return source;
}

}  // namespace sward
