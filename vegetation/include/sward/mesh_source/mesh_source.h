// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/view.h>
#include <vector>

namespace sward {

/// A static triangulated surface (hedge, topiary, scan) as a source of triangles to seed, beside the terrain
/// (Papavasiliou 2015, section 2: the basic algorithm works on any mesh).
///
/// Each face is bisected at its base, like a bintree triangle, until its pieces are no larger than the area asked for.
/// Ids carry the face and the path:
/// ```
///  63..58 level | 57..35 face | 34..0 turns, first in bit 34
/// ```
/// so that plants depend on the file and the area alone. Immutable after loading; safe from several threads.
class MeshSource {
 public:
  static constexpr uint32_t k_max_faces = 1u << 23;

  /// Reads OBJ, PLY or OFF; polygons are triangulated. `world_from_mesh` places it. Degenerate faces (no area, a corner
  /// that is not finite) are dropped and counted. Silences OpenMesh's
  /// own messages. Fails on files that OpenMesh cannot read, on no usable face and on
  /// more than k_max_faces.
  static Expected<MeshSource> load(const std::string& path, const glm::dmat4& world_from_mesh = glm::dmat4(1.0));
  /// From corners, three a face, counter-clockwise seen from outside.
  static Expected<MeshSource> from_corners(std::vector<glm::dvec3> corners);

  size_t faces() const { return corners_.size() / 3; }
  size_t dropped_faces() const { return dropped_faces_; }

  /// Pieces of at most `max_area_m2` in view: the frustum, the horizon and the canopy of `options` count, its level
  /// does not. Clears `out` first.
  void fixed_level_triangles(const View& view, float max_area_m2, const FixedLevelOptions& options,
                             FixedTriangles& out) const;

 private:
  std::vector<glm::dvec3> corners_;  // apex, left, right; the base is the longest edge
  size_t dropped_faces_ = 0;
};

}  // namespace sward
