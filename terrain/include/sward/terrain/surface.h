// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/bounds.h>
#include <sward/terrain/lattice.h>
#include <glm/glm.hpp>
#include <span>

namespace sward {

/// Lattice points first + stride (i, j), 0 <= i < count.x, 0 <= j < count.y: row by row, north first.
struct LatticeGrid {
  LatticePoint first{0};
  int stride = 1;
  glm::ivec2 count{0};
  size_t size() const { return size_t(count.x) * size_t(count.y); }
};

/// What a RoamMesh refines over: heights and bounds of a whole field, or of a world of which only parts are resident.
///
/// The same lattice point has the same height whatever is resident. Calls are const, made once for each vertex or
/// triangle that comes into being, and must be safe from the threads of all meshes over the surface; what they answer
/// may change only between updates, and then every mesh is told by RoamMesh::surface_changed().
class SWARD_API Surface {
 public:
  virtual ~Surface() = default;

  virtual const Lattice& lattice() const = 0;
  /// Surface height at a lattice point, relief included, metres, world. Defined for corners of root squares and for
  /// centres of diamonds that can_split() allows.
  virtual double height(LatticePoint p) const = 0;
  /// Gradient of the relief alone (dz/dx, dz/dy) at such a point.
  virtual glm::dvec2 relief_gradient(LatticePoint p) const = 0;
  /// Bound in metres of the triangles of `level` whose base edge's middle is `centre`; nested; 0 at max_level.
  virtual float bound(LatticePoint centre, int level) const = 0;
  /// False while the diamond cannot be split because the height of its centre or the bounds below it are not resident.
  /// Nested: where a diamond can be split, so can every diamond that has to be split before it.
  virtual bool can_split(LatticePoint centre, int level) const = 0;
  /// The height at this point and the bound around it are going to be asked for: what can be fetched into the cache
  /// without waiting for it may be. Does nothing unless overridden.
  virtual void prefetch(LatticePoint) const {}
  /// Slope of the data (dz/dx, dz/dy), as HeightField::data_gradient.
  virtual glm::dvec2 data_gradient(glm::dvec2 xy) const = 0;
  /// True when no valid sample lies in the box (its corners included, clamped to the data).
  virtual bool all_holes(const LatticeBox& box) const = 0;

  /// Height at world x, y from the finest data there is at this moment; NaN outside of the data.
  virtual double height(glm::dvec2 xy) const = 0;
  /// Between which heights all of it lies, relief included, metres, world.
  virtual glm::dvec2 height_range() const = 0;
  /// Slopes of the data at the samples first + stride (i, j), 0 <= i < count.x, 0 <= j < count.y, row by row, north
  /// first; beyond the data those of its edge. Strides above 1 may take differences over a stride, so that a slope
  /// stands for the ground around. `out` has count.x * count.y places.
  virtual void data_gradients(glm::ivec2 first, int stride, glm::ivec2 count, std::span<glm::vec2> out) const;

  /// Heights of a grid from the finest data there is at this moment, metres above `base` (world); beyond the data those
  /// of its edge. `out` has grid.size() places. Cost: that of height() for each.
  virtual void grid_heights(const LatticeGrid& grid, double base, std::span<float> out) const;
  /// relief_gradient() of the same points.
  virtual void grid_relief(const LatticeGrid& grid, std::span<glm::vec2> out) const;
};

/// A field with its bounds, all of it resident. `bounds` and its field must outlive it.
class SWARD_API FieldSurface final : public Surface {
 public:
  explicit FieldSurface(const Bounds& bounds) : bounds_(&bounds), field_(&bounds.field()) {}

  const Lattice& lattice() const override { return field_->lattice(); }
  double height(LatticePoint p) const override { return field_->height(p); }
  glm::dvec2 relief_gradient(LatticePoint p) const override { return field_->relief_gradient(p); }
  float bound(LatticePoint centre, int level) const override { return bounds_->bound(centre, level); }
  bool can_split(LatticePoint, int) const override { return true; }
  void prefetch(LatticePoint p) const override {
    field_->prefetch(p);
    bounds_->prefetch(p);
  }
  glm::dvec2 data_gradient(glm::dvec2 xy) const override { return field_->data_gradient(xy); }
  bool all_holes(const LatticeBox& box) const override;
  double height(glm::dvec2 xy) const override { return field_->height(xy); }
  void grid_heights(const LatticeGrid& grid, double base, std::span<float> out) const override;
  void grid_relief(const LatticeGrid& grid, std::span<glm::vec2> out) const override;
  glm::dvec2 height_range() const override {
    return field_->height_range() + glm::dvec2(-1, 1) * field_->relief_amplitude();
  }

 private:
  const Bounds* bounds_;
  const HeightField* field_;
};

}  // namespace sward
