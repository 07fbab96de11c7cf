// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <sward/terrain/height_field.h>
#include <sward/terrain/view.h>
#include <vector>

namespace sward {

/// Identity of a bintree triangle, whatever the mesh is:
/// ```
///  63..58 level | 57 root | 56..46 root square column + 1024 | 45..35 root square row + 1024 | 34..0 turns
/// ```
/// The first turn stands in bit 34; unused turns are 0. Turn 0 leads to child (m, apex, left), turn 1 to child
/// (m, right, apex), m the middle of left-right.
///
///        apex                 Root square: root 0 = (NW, SW, NE), root 1 = (SE, NE, SW).
///        /|\                  Corners (apex, left, right) run counter-clockwise seen from above; they are v0, v1, v2
///       / | \                 of equations 3 and 25 of Papavasiliou (2015).
///   left--m--right
struct TriangleId {
  uint64_t bits = 0;

  static TriangleId root(int root, glm::ivec2 square);
  TriangleId child(int turn) const;
  int level() const { return int(bits >> 58); }
  int root() const { return int(bits >> 57) & 1; }
  glm::ivec2 square() const { return {int(bits >> 46 & 0x7ff) - 1024, int(bits >> 35 & 0x7ff) - 1024}; }
  uint32_t low() const { return uint32_t(bits); }
  uint32_t high() const { return uint32_t(bits >> 32); }
  bool operator==(const TriangleId&) const = default;
};

/// Lattice corners (apex, left, right) of a triangle.
struct TriangleCorners {
  LatticePoint apex, left, right;
};
TriangleCorners corners_of(TriangleId id);

/// A triangle of a layer's level, ready for seeding. x and y of its corners are static; z is the surface drawn in this
/// frame.
struct FixedTriangle {
  glm::dvec3 apex{0};      ///< World.
  glm::vec3 to_left{0};    ///< left - apex, metres; x, y exact.
  glm::vec3 to_right{0};   ///< right - apex.
  TriangleId id;
  uint32_t surface = 0;    ///< Root of its refinement in FixedTriangles::surface; 0: the triangle is flat.
  float area = 0;          ///< Static area for densities: horizontal area over the cosine of the data's slope at its
                           ///< centre, square metres.
  float screen_area = 0;   ///< Projected area in units of (half the viewport's height) squared; infinite when a corner
                           ///< lies behind the near plane.
  float distance = 0;      ///< From the eye to the nearest point of the triangle, metres.
};

/// One split of the drawn surface below a fixed-level triangle: z of the split vertex, absolute against
/// FixedTriangles::surface_z, and the nodes of the two children (0: not split further). Node 0 is unused.
struct SurfaceNode {
  float z = 0;
  uint32_t child[2] = {0, 0};
  uint32_t unused = 0;  ///< Keeps 16 bytes: one texel of an RGBA32UI buffer texture.
};

/// What any terrain hands to the vegetation. Owned by the caller and reused from frame to frame.
struct FixedTriangles {
  std::vector<FixedTriangle> triangles;
  std::vector<SurfaceNode> surface;  ///< Node 0 is a placeholder.
  double surface_z = 0;              ///< World z that SurfaceNode::z is relative to.
  void clear();
};

struct FixedLevelOptions {
  int level = 24;             ///< Bintree level to emit.
  float horizon_m = 100;      ///< 3-D distance from the eye beyond which nothing is emitted.
  float canopy_m = 1;         ///< Height of what grows on it, for culling.
  bool skip_back_faces = true;
};

/// The level whose triangles' area is nearest to `area_m2` (geometrically), within [0, k_max_level].
int level_for_area(const HeightField& field, double area_m2);

}  // namespace sward
