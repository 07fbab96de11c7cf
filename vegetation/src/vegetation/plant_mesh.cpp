// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/plant_mesh.h"

#include <sward/vegetation/mesh_surface.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sward {

namespace {

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

glm::dvec3 cross_of(const TriangleMesh& mesh, size_t face) {
  const glm::dvec3 a = mesh.positions[mesh.indices[3 * face]];
  return glm::cross(mesh.positions[mesh.indices[3 * face + 1]] - a, mesh.positions[mesh.indices[3 * face + 2]] - a);
}

/// Faces with an area.
std::vector<uint32_t> faces_of(const TriangleMesh& mesh) {
  std::vector<uint32_t> faces;
  for (uint32_t face = 0; face < mesh.indices.size() / 3; ++face)
    if (cross_of(mesh, face) != glm::dvec3(0)) faces.push_back(face);
  return faces;
}

glm::dvec2 height_range(const TriangleMesh& mesh) {
  glm::dvec2 range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
  for (const glm::dvec3& p : mesh.positions) range = {std::min(range.x, p.z), std::max(range.y, p.z)};
  return range;
}

/// Largest distance from the axis.
double radius_of(const TriangleMesh& mesh) {
  double radius = 0;
  for (const glm::dvec3& p : mesh.positions) radius = std::max(radius, std::hypot(p.x, p.y));
  return radius;
}

/// Of corners, smooth over the faces that share a position in the mesh's own numbering.
std::vector<glm::dvec3> normals_of(const TriangleMesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0));
  for (size_t i = 0; i < mesh.indices.size(); ++i) normals[mesh.indices[i]] += cross_of(mesh, i / 3);
  for (glm::dvec3& n : normals) n = glm::dot(n, n) > 0 ? glm::normalize(n) : glm::dvec3(0, 0, 1);
  return normals;
}

/// A fixed shuffle.
void shuffle(std::vector<uint32_t>& faces) {
  uint32_t state = 12345;
  for (size_t i = faces.size(); i > 1; --i) {
    state = state * 1664525u + 1013904223u;
    std::swap(faces[i - 1], faces[size_t(uint64_t(state) * i >> 32)]);
  }
}

}  // namespace

std::string fault_of(const PlantMesh& plant) {
  if (!plant.mesh) return {};
  const TriangleMesh& mesh = *plant.mesh;
  if (mesh.indices.size() % 3 != 0) return "has indices that are no multiple of three";
  if (mesh.indices.size() / 3 > size_t(k_most_plant_faces)) {
    return "has " + std::to_string(mesh.indices.size() / 3) + " faces but at most " +
           std::to_string(k_most_plant_faces) + " fit; simplify it";
  }
  for (const uint32_t index : mesh.indices)
    if (index >= mesh.positions.size())
      return "has a face with corner " + std::to_string(index) + ", which is not there";
  for (const glm::dvec3& p : mesh.positions)
    if (!finite(p)) return "has a position that is not finite";
  if (mesh.colors.size() != mesh.positions.size()) return "has no colour for each position; paint its vertices";
  if (!plant.heights.empty() && plant.heights.size() != mesh.positions.size())
    return "has " + std::to_string(plant.heights.size()) + " heights for " + std::to_string(mesh.positions.size()) +
           " positions";
  for (const float height : plant.heights)
    if (!(height >= 0.0f && height <= 1.0f)) return "has a height coordinate that is not in [0, 1]";
  if (faces_of(mesh).empty()) return "has no face with an area";
  const glm::dvec2 range = height_range(mesh);
  if (!(range.y > range.x)) return "has no height; its axis is z";
  if (!(radius_of(mesh) > 0)) return "has no width about its axis, which is x = y = 0";
  return {};
}

int face_count(const PlantMesh& plant) {
  return plant.mesh ? int(faces_of(*plant.mesh).size()) : 0;
}

std::vector<glm::vec4> make_mesh_texels(const PlantMesh& plant) {
  const TriangleMesh& mesh = *plant.mesh;
  const glm::dvec2 range = height_range(mesh);
  const double diameter = 2 * radius_of(mesh);
  const std::vector<glm::dvec3> normals = normals_of(mesh);
  std::vector<uint32_t> faces = faces_of(mesh);
  shuffle(faces);
  std::vector<glm::vec4> texels;
  texels.reserve(faces.size() * 6);
  for (const uint32_t face : faces) {
    for (size_t corner = 0; corner < 3; ++corner) {
      const uint32_t i = mesh.indices[3 * face + corner];
      const glm::dvec3 p = mesh.positions[i];
      const double up = (p.z - range.x) / (range.y - range.x);
      const double height = plant.heights.empty() ? up : double(plant.heights[i]);
      const glm::u8vec3 c = mesh.colors[i];
      texels.emplace_back(p.x / diameter, p.y / diameter, height, float(int(c.r) << 16 | int(c.g) << 8 | int(c.b)));
      texels.emplace_back(glm::vec3(normals[i]), float(up - height));
    }
  }
  return texels;
}

}  // namespace sward
