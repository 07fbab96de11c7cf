// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/height_field.h>
#include <sward/terrain/view.h>
#include <cstdint>
#include <memory>
#include <span>
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
struct SWARD_API TriangleId {
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
SWARD_API TriangleCorners corners_of(TriangleId id);

/// A triangle of a layer's level, ready for seeding: one element of FixedTriangles. x and y of its corners are static;
/// z is the surface drawn in this frame.
struct FixedTriangle {
  glm::dvec3 apex{0};     ///< World.
  glm::vec3 to_left{0};   ///< left - apex, metres; x, y exact.
  glm::vec3 to_right{0};  ///< right - apex.
  TriangleId id;
  uint32_t surface = 0;   ///< Root of its refinement in FixedTriangles::nodes(); 0: the triangle is flat.
  float area = 0;         ///< Static area for densities: horizontal area over the cosine of the data's slope at its
                          ///< centre, square metres.
  float screen_area = 0;  ///< Projected area in units of (half the viewport's height) squared; infinite when a corner
                          ///< lies behind the near plane.
  float distance = 0;     ///< From the eye to the nearest point of the triangle, metres.
  /// z of the finest data at apex, left, right, world, metres; static, NaN where there are none, and where
  /// FixedLevelOptions::altitudes does not ask for them: nothing with a rule of altitude stands there.
  glm::vec3 altitude{0};
};

/// One split of the drawn surface below a fixed-level triangle: z of the split vertex, absolute against
/// FixedTriangles::surface_z(), and the nodes of the two children (0: not split further). Node 0 is unused.
struct SurfaceNode {
  float z = 0;
  uint32_t child[2] = {0, 0};
  uint32_t unused = 0;  ///< Keeps 16 bytes: one texel of an RGBA32UI buffer texture.
};

/// What a terrain keeps from frame to frame beside the triangles that it wrote, so that the next frame costs less.
class SWARD_API FixedTrianglesMemory {
 public:
  virtual ~FixedTrianglesMemory() = default;
};

/// What any terrain hands to the vegetation, as structure of arrays: element i of each column belongs to triangle i.
///
/// Owned by the caller, one for each layer and view, and reused from frame to frame: columns keep their memory, and a
/// mesh rebuilds only what changed since it wrote into the same object. Copies have the triangles, not that memory. One
/// thread at a time.
class SWARD_API FixedTriangles {
 public:
  FixedTriangles();
  FixedTriangles(const FixedTriangles& other);
  FixedTriangles(FixedTriangles&&) noexcept;
  FixedTriangles& operator=(const FixedTriangles& other);
  FixedTriangles& operator=(FixedTriangles&&) noexcept;
  ~FixedTriangles();

  size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }

  // Columns, each of size() elements, as in FixedTriangle. Valid until the next call that is not const.
  std::span<const glm::dvec3> apex() const { return {columns_.apex.data(), count_}; }
  std::span<const glm::vec3> to_left() const { return {columns_.to_left.data(), count_}; }
  std::span<const glm::vec3> to_right() const { return {columns_.to_right.data(), count_}; }
  std::span<const TriangleId> id() const { return {columns_.id.data(), count_}; }
  std::span<const uint32_t> surface() const { return {columns_.surface.data(), count_}; }
  std::span<const float> area() const { return {columns_.area.data(), count_}; }
  std::span<const float> screen_area() const { return {columns_.screen_area.data(), count_}; }
  std::span<const float> distance() const { return {columns_.distance.data(), count_}; }
  std::span<const glm::vec3> altitude() const { return {columns_.altitude.data(), count_}; }

  /// Splits of the drawn surface below triangles; node 0 is a placeholder, always there.
  std::span<const SurfaceNode> nodes() const { return {nodes_.data(), node_count_}; }
  /// World z that SurfaceNode::z is relative to, metres.
  double surface_z() const { return surface_z_; }

  /// Gathers one triangle.
  FixedTriangle operator[](size_t i) const;

  // For hosts that feed triangles of their own, one at a time.

  void push_back(const FixedTriangle& triangle);
  /// Replaces triangle i < size().
  void set(size_t i, const FixedTriangle& triangle);
  /// Appends a node; returns its index.
  uint32_t add_node(const SurfaceNode& node);
  void set_surface_z(double z);
  /// No triangles, no nodes but the placeholder.
  void clear();

  /// Columns to be written in bulk.
  struct Writer {
    std::span<glm::dvec3> apex;
    std::span<glm::vec3> to_left, to_right;
    std::span<TriangleId> id;
    std::span<uint32_t> surface;
    std::span<float> area, screen_area, distance;
    std::span<SurfaceNode> nodes;  ///< The placeholder included.
    std::span<glm::vec3> altitude;
  };
  /// Changes size() and the number of nodes (at least 1). What was there before stays, what is new is unspecified, node
  /// 0 is the placeholder. The spans are valid until the next call that is not const. Does not free memory.
  Writer write(size_t triangles, size_t nodes);

  /// A number that changes whenever the contents may have; never 0.
  uint64_t contents() const { return contents_; }
  /// The slot for what the source of these triangles keeps; empty until a source fills it.
  std::unique_ptr<FixedTrianglesMemory>& memory() { return memory_; }

 private:
  struct Columns {
    std::vector<glm::dvec3> apex;
    std::vector<glm::vec3> to_left, to_right;
    std::vector<TriangleId> id;
    std::vector<uint32_t> surface;
    std::vector<float> area, screen_area, distance;
    std::vector<glm::vec3> altitude;
    void grow(size_t count);
  };
  Columns columns_;  // as long as the longest so far: only what is new is ever initialised
  std::vector<SurfaceNode> nodes_;
  size_t count_ = 0, node_count_ = 1;
  double surface_z_ = 0;
  uint64_t contents_ = 1;
  std::unique_ptr<FixedTrianglesMemory> memory_;
};

struct FixedLevelOptions {
  int level = 24;         ///< Bintree level to emit.
  float horizon_m = 100;  ///< 3-D distance from the eye beyond which nothing is emitted.
  float canopy_m = 1;     ///< Height of what grows on it, for culling.
  /// Leave out ground whose plane is more than canopy_m above the eye. Cheaper; but what stands upright shows its tips
  /// over the edge of ground that has just turned away, and vanishes with it.
  bool skip_back_faces = true;
  int threads = 0;  ///< At most so many work on it, the calling one included; 0: one a core. Small sets stay on
                    ///< the calling thread, and the result is the same whatever the number.
  bool altitudes = false;  ///< Fill FixedTriangles::altitude(): three heights of the data a triangle, once.
  /// How far what grows on it, or its shadow, reaches beyond it on the level, for culling by the frustum: triangles
  /// beside the picture are emitted whose crowns are in it. >= 0.
  float spread_m = 0;
};

/// The level whose triangles' area is nearest to `area_m2` (geometrically), within [0, k_max_level].
SWARD_API int level_for_area(const Lattice& lattice, double area_m2);
SWARD_API int level_for_area(const HeightField& field, double area_m2);

}  // namespace sward
