// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/fixed_triangles.h>

#include <algorithm>
#include <cmath>

namespace sward {

TriangleId TriangleId::root(int root, glm::ivec2 square) {
  SWARD_ASSERT(root == 0 || root == 1, "a root square has roots 0 and 1");
  SWARD_ASSERT(square.x >= -1024 && square.x < 1024 && square.y >= -1024 && square.y < 1024,
               "root squares are counted from -1024 to 1023");
  return {uint64_t(root) << 57 | uint64_t(square.x + 1024) << 46 | uint64_t(square.y + 1024) << 35};
}

TriangleId TriangleId::child(int turn) const {
  SWARD_ASSERT(level() < k_max_level, "triangles of the deepest level have no children");
  return {(bits + (uint64_t(1) << 58)) | uint64_t(turn) << (34 - level())};
}

TriangleCorners corners_of(TriangleId id) {
  const LatticePoint nw = id.square() * k_root_side;
  const LatticePoint se = nw + LatticePoint(k_root_side);
  const LatticePoint ne{se.x, nw.y}, sw{nw.x, se.y};
  TriangleCorners c = id.root() == 0 ? TriangleCorners{nw, sw, ne} : TriangleCorners{se, ne, sw};
  for (int level = 0; level < id.level(); ++level) {
    const LatticePoint m = c.left + (c.right - c.left) / 2;
    const bool second = id.bits >> (34 - level) & 1;
    c = second ? TriangleCorners{m, c.right, c.apex} : TriangleCorners{m, c.apex, c.left};
  }
  return c;
}

void FixedTriangles::clear() {
  triangles.clear();
  surface.assign(1, SurfaceNode{});
  surface_z = 0;
}

int level_for_area(const HeightField& field, double area_m2) {
  SWARD_ASSERT(area_m2 > 0, "the area of a triangle must be positive");
  const double cells = double(int64_t(1) << field.root_bits());
  const double root_area = 0.5 * cells * cells * field.desc().spacing.x * field.desc().spacing.y;
  return int(std::clamp(std::round(std::log2(root_area / area_m2)), 0.0, double(k_max_level)));
}

}  // namespace sward
