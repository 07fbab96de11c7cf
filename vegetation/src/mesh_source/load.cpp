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

TriangleMesh to_arrays(const PolygonMesh& mesh, bool colors) {
  TriangleMesh arrays;
  for (const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    arrays.positions.emplace_back(p[0], p[1], p[2]);
    if (!colors) continue;
    const auto& c = mesh.color(vertex);
    arrays.colors.emplace_back(c[0], c[1], c[2]);
  }
  for (const auto face : mesh.faces())
    for (const auto vertex : mesh.fv_range(face)) arrays.indices.push_back(uint32_t(vertex.idx()));
  return arrays;
}

Expected<TriangleMesh> read(const std::string& path) {
  PolygonMesh mesh;
  mesh.request_vertex_colors();
  ::omerr().disable();
  ::omlog().disable();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexColor);
  if (!OpenMesh::IO::read_mesh(mesh, path, options)) {
    return fail(path + ": cannot be read as a mesh; OBJ, PLY and OFF files are understood");
  }
  mesh.triangulate();
  if (mesh.n_faces() == 0) return fail(path + ": the mesh has no faces; export triangles or polygons");
  return to_arrays(mesh, options.vertex_has_color());
}

}  // namespace

Expected<TriangleMesh> load_mesh(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return fail(path + ": no such mesh file");
  try {
    return read(path);
  } catch (const std::exception& e) {
    return fail(path + ": cannot be read as a mesh: " + e.what());
  }
}

}  // namespace sward
