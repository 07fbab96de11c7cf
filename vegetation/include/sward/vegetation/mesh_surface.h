// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/view.h>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace sward {

/// Triangles of a host, of a file (sward/mesh_source/mesh_source.h) or generated: plain arrays.
struct SWARD_API TriangleMesh {
  std::vector<glm::dvec3> positions;  ///< Metres.
  std::vector<glm::u8vec3> colors;    ///< sRGB, one a position; empty: the mesh has none.
  std::vector<uint32_t> indices;      ///< Three a face, counter-clockwise seen from outside.

  /// Moves, turns and scales all positions.
  void transform(const glm::dmat4& matrix);
  /// Gives every position this colour.
  void paint(glm::u8vec3 color);
  /// Adds the faces of another; where only one of the two has colours, the other's positions become white.
  void append(const TriangleMesh& other);
};

/// What is odd about a mesh. None of it is an error: plants stand on the faces that are left.
struct SWARD_API MeshReport {
  size_t dropped_faces = 0;        ///< Without area, or with a corner that is not finite: left out.
  size_t first_dropped = 0;        ///< The first of them, counted from 0.
  size_t open_edges = 0;           ///< With one face: rims of holes.
  size_t non_manifold_edges = 0;   ///< With more than two.
  /// One line that names what was found and what to do, empty where nothing was.
  std::string text() const;
};

/// A static triangulated surface (hedge, topiary, scan) as a source of triangles to seed, beside the terrain
/// (Papavasiliou 2015, section 2: the basic algorithm works on any mesh).
///
/// Each face is bisected at its base, like a bintree triangle, until its pieces are no larger than the area asked for.
/// Ids carry the face, in the mesh's order, and the path:
/// ```
///  63..58 level | 57..35 face | 34..0 turns, first in bit 34
/// ```
/// so that plants depend on the mesh and the area alone. Immutable; safe from several threads.
class SWARD_API MeshSurface {
 public:
  static constexpr uint32_t k_max_faces = 1u << 23;

  /// From a host's own arrays, copied: as in TriangleMesh; `colors` may be empty, the mesh is then white. Faces without
  /// area and faces with a corner that is not finite are left out and counted. Fails on indices that are no multiple of
  /// three or lie beyond the positions, colours that are not one a position, no usable face, and more than k_max_faces.
  static Expected<MeshSurface> create(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                                      std::span<const glm::u8vec3> colors = {});
  static Expected<MeshSurface> create(const TriangleMesh& mesh) {
    return create(mesh.positions, mesh.indices, mesh.colors);
  }

  size_t faces() const { return corners_.size() / 3; }
  const MeshReport& report() const { return report_; }
  /// Corners of the faces, three each, apex first: opposite the longest edge. All the same in faces left out.
  std::span<const glm::dvec3> corners() const { return corners_; }
  std::span<const glm::u8vec3> colors() const { return colors_; }

  /// Pieces of at most `max_area_m2` in view: frustum, horizon, canopy and skip_back_faces of `options` count, its level
  /// does not. Back faces are those that have turned away by more than 17 degrees and whose plane is more than the
  /// canopy above the eye: what grows behind an edge shows its tips over it. Clears `out` first. Cost: linear in the
  /// faces of the blocks of 64 that are in view.
  void fixed_level_triangles(const View& view, float max_area_m2, const FixedLevelOptions& options,
                             FixedTriangles& out) const;
  /// All pieces, whatever view: distances are 0, projected areas infinite.
  void all_triangles(float max_area_m2, FixedTriangles& out) const;
  /// Colours at apex, left, right of a piece that either of these wrote.
  std::array<glm::u8vec3, 3> piece_colors(TriangleId id) const;

 private:
  struct Block {
    glm::dvec3 low{0}, high{0};
  };
  void bound_blocks();

  std::vector<glm::dvec3> corners_;  // apex, left, right; the base is the longest edge
  std::vector<glm::u8vec3> colors_;
  std::vector<Block> blocks_;
  MeshReport report_;
};

}  // namespace sward
