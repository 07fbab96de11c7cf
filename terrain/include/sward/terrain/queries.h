// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/bounds.h>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>

namespace sward {

/// From `origin` along `direction` (any length but 0), world.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
  double max_distance = std::numeric_limits<double>::infinity();  ///< Metres, >= 0.
};

struct RayHit {
  double distance = 0;         ///< Metres from the ray's origin.
  glm::dvec3 point{0.0};       ///< On the ray; its z is the finest surface's there to within 1e-6 m.
  glm::dvec3 normal{0, 0, 1};  ///< Unit normal of the finest triangle that was hit, upwards.
};

struct Sight {
  glm::dvec3 from{0.0}, to{0.0};  ///< World.
};

struct SightResult {
  bool visible = false;
  /// Where the segment first meets the ground; NaN when it is free, or when a coordinate was not finite.
  glm::dvec3 blocked_at{std::numeric_limits<double>::quiet_NaN()};
};

/// Questions answered from the finest data (HeightField::height, relief included), never from a mesh. Bounds are the
/// hierarchy: a bintree triangle is left out where the ray stays outside of its wedgie (Duchaineau et al. 1997).
///
/// All calls are const, keep no cache and are safe from any threads, while meshes over the same field update too; not
/// while the field is edited. Coordinates are world metres. Where there is no data - beyond the field, and in data
/// triangles with a hole at a corner - there is no ground: rays and sight pass, although the mesh draws the filled
/// surface over holes and height() returns it.
///
/// Batches write answer i for question i; both spans have the same length (asserted). They run on up to `threads`
/// threads, the calling one included (0: all cores), started for the call; batches under some 256 rays, or 16384
/// heights, stay on the calling thread. Answers do not depend on the number of threads.
class SWARD_API TerrainQueries {
 public:
  /// `bounds` and its field must outlive the queries.
  explicit TerrainQueries(const Bounds& bounds) : bounds_(&bounds), field_(&bounds.field()) {}

  /// HeightField::height and normal: NaN and straight up beyond the data and for coordinates that are not finite.
  double height(glm::dvec2 xy) const { return field_->height(xy); }
  glm::dvec3 normal(glm::dvec2 xy) const { return field_->normal(xy); }

  /// Nearest point at which the ray meets the surface, from above or from below; nothing when there is none, when the
  /// direction is 0, the distance negative, or a number NaN (or infinite, but for the distance). A ray that starts on
  /// the surface hits it there. Cost: some microseconds; it grows with the logarithm of what is passed over, and with
  /// the number of finest triangles only along a grazing ray.
  std::optional<RayHit> ray(const Ray& ray) const;
  /// Whether nothing of the segment is in the ground, which is solid downwards from the surface. Touching is free: what
  /// lies less than 1e-6 m below counts as on the surface, so ends may stand on the ground. An end that is deeper is
  /// not seen. Not visible, too, when a coordinate is not finite.
  SightResult line_of_sight(const Sight& sight) const;

  void heights(std::span<const glm::dvec2> xy, std::span<double> out, int threads = 0) const;
  void normals(std::span<const glm::dvec2> xy, std::span<glm::dvec3> out, int threads = 0) const;
  void rays(std::span<const Ray> rays, std::span<std::optional<RayHit>> out, int threads = 0) const;
  void lines_of_sight(std::span<const Sight> sights, std::span<SightResult> out, int threads = 0) const;

 private:
  const Bounds* bounds_;
  const HeightField* field_;
};

}  // namespace sward
