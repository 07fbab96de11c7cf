// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <array>
#include <glm/glm.hpp>

namespace sward {

/// One camera. World: right-handed, metres, z up, x east, y north. Clip space: OpenGL's.
struct SWARD_API View {
  glm::dvec3 eye{0};               ///< World position, metres.
  glm::dmat3 eye_from_world{1};    ///< Rotation only: world axes to eye axes (x right, y up, -z ahead).
  glm::dmat4 clip_from_eye{1};     ///< Projection; reversed and infinite ones are allowed.
  glm::ivec2 viewport{1280, 720};  ///< Pixels.

  /// Azimuth and pitch in radians: azimuth 0 looks east, counter-clockwise; pitch up positive. `fov_y` radians.
  static View look(glm::dvec3 eye, double azimuth, double pitch, double fov_y, glm::ivec2 viewport, double near_plane,
                   double far_plane);
  /// From a host's column-major matrices. The view matrix must be rigid.
  static Expected<View> from_matrices(glm::dvec3 eye, const glm::dmat4& view, const glm::dmat4& projection,
                                      glm::ivec2 viewport);

  /// Fails, saying what is wrong, on NaN or infinite numbers, an empty viewport, a singular projection, a rotation that
  /// is none.
  Expected<void> validate() const;

  /// Projection times rotation: takes world-axis vectors relative to the eye to clip space.
  glm::dmat4 clip_from_relative() const { return clip_from_eye * glm::dmat4(eye_from_world); }
  /// Focal lengths in pixels (x, y): pixels on screen of a 1 m object 1 m ahead.
  glm::dvec2 focal_px() const;
  /// Focal length against that of a 50 degree vertical field of view: 1 there, more when zoomed in.
  double zoom() const;
  /// True for a perspective projection.
  bool perspective() const { return clip_from_eye[2][3] != 0.0; }
  /// Distance ahead of the eye of the near plane, metres, for normal and reversed depth.
  double near_distance() const;
};

/// A halfspace n . p + d >= 0 in world axes relative to the eye; n has unit length.
struct Plane {
  glm::dvec3 n{0};
  double d = 0;
};

/// Left, right, bottom, top, near, far. Works for normal, reversed and infinite projections: a plane at infinity comes
/// out as one that everything satisfies (n = 0, d = 1).
SWARD_API std::array<Plane, 6> frustum_planes(const View& view);

}  // namespace sward
