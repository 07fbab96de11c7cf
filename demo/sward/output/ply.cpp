// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/ply.h"

#include <bit>

namespace sward::tool {

namespace {

static_assert(std::endian::native == std::endian::little, "the writer copies numbers as they lie in memory");

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::string make_ply(const RoamMesh& mesh, std::span<const uint32_t> indices) {
  constexpr int32_t k_unused = -1;
  std::vector<int32_t> place(mesh.vertices().size(), k_unused);
  std::string vertices, triangles;
  int32_t used = 0;
  for (size_t i = 0; i < indices.size(); i += 3) {
    append(triangles, uint8_t(3));
    for (const uint32_t slot : indices.subspan(i, 3)) {
      if (place[slot] == k_unused) {
        place[slot] = used++;
        const glm::dvec3 at = mesh.vertex_world(slot);
        for (int axis = 0; axis < 3; ++axis) append(vertices, at[axis]);
      }
      append(triangles, place[slot]);
    }
  }
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(used) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(indices.size() / 3) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices +
         triangles;
}

}  // namespace sward::tool
