// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/view.h>

#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <string>

namespace sward {

namespace {

// Rotations come from hosts that compute in single precision.
constexpr double k_rotation_tolerance = 1e-4;
// Share of the product of the columns' lengths below which a determinant counts as zero.
constexpr double k_singular = 1e-12;
// Half of the field of view that zoom() is measured against.
constexpr double k_reference_half_fov = 25.0 * 3.14159265358979323846 / 180.0;

template <class Matrix>
bool all_finite(const Matrix& m) {
  for (int column = 0; column < Matrix::length(); ++column) {
    for (int row = 0; row < Matrix::col_type::length(); ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

bool is_rotation(const glm::dmat3& m) {
  const glm::dmat3 product = glm::transpose(m) * m;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (std::abs(product[column][row] - (column == row ? 1.0 : 0.0)) > k_rotation_tolerance) return false;
    }
  }
  return glm::determinant(m) > 0.0;
}

bool is_singular(const glm::dmat4& m) {
  double size = 1.0;
  for (int column = 0; column < 4; ++column) size *= glm::length(m[column]);
  return !(std::abs(glm::determinant(m)) > k_singular * size);
}

glm::dmat4 perspective_projection(double fov_y, double aspect, double near_plane, double far_plane) {
  const double focal = 1.0 / std::tan(0.5 * fov_y);
  const bool infinite = std::isinf(far_plane);
  glm::dmat4 m(0.0);
  m[0][0] = focal / aspect;
  m[1][1] = focal;
  m[2][2] = infinite ? -1.0 : -(far_plane + near_plane) / (far_plane - near_plane);
  m[2][3] = -1.0;
  m[3][2] = infinite ? -2.0 * near_plane : -2.0 * far_plane * near_plane / (far_plane - near_plane);
  return m;
}

// Distances ahead of the eye at which depth is -w and +w; infinite or negative where there is none in front.
glm::dvec2 depth_limits(const View& view) {
  const glm::dmat4& m = view.clip_from_eye;
  // At (0, 0, -d): z = m32 - m22 d and w = m33 - m23 d.
  const double at_minus = (m[3][2] + m[3][3]) / (m[2][2] + m[2][3]);
  const double at_plus = (m[3][2] - m[3][3]) / (m[2][2] - m[2][3]);
  return {at_minus, at_plus};
}

// A perspective projection's far limit may lie behind the eye (depth in [0, 1]) or at infinity.
bool is_reversed(const View& view) {
  const glm::dvec2 limits = depth_limits(view);
  if (!view.perspective()) return limits[1] < limits[0];
  const auto rank = [](double distance) {
    return distance > 0.0 && std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
  };
  return rank(limits[1]) < rank(limits[0]);
}

Plane normalised(const glm::dvec4& plane, double scale) {
  const glm::dvec3 n(plane);
  const double length = glm::length(n);
  if (!(length > k_singular * scale)) return {glm::dvec3(0.0), 1.0};
  return {n / length, plane.w / length};
}

}  // namespace

View View::look(glm::dvec3 eye, double azimuth, double pitch, double fov_y, glm::ivec2 viewport, double near_plane,
                double far_plane) {
  const glm::dvec3 ahead(std::cos(azimuth) * std::cos(pitch), std::sin(azimuth) * std::cos(pitch), std::sin(pitch));
  const glm::dvec3 right(std::sin(azimuth), -std::cos(azimuth), 0.0);
  const glm::dvec3 up = glm::cross(right, ahead);
  View view;
  view.eye = eye;
  view.eye_from_world = glm::transpose(glm::dmat3(right, up, -ahead));
  view.viewport = viewport;
  const double aspect = double(viewport.x) / double(viewport.y);
  view.clip_from_eye = perspective_projection(fov_y, aspect, near_plane, far_plane);
  return view;
}

Expected<View> View::from_matrices(glm::dvec3 eye, const glm::dmat4& view, const glm::dmat4& projection,
                                   glm::ivec2 viewport) {
  if (!all_finite(view)) return fail("the view matrix has a number that is NaN or infinite");
  const glm::dvec4 bottom = glm::row(view, 3);
  if (glm::any(glm::greaterThan(glm::abs(bottom - glm::dvec4(0, 0, 0, 1)), glm::dvec4(k_rotation_tolerance)))) {
    return fail("the view matrix is not rigid: its bottom row must be 0 0 0 1");
  }
  View result;
  result.eye = eye;
  result.eye_from_world = glm::dmat3(view);
  result.clip_from_eye = projection;
  result.viewport = viewport;
  if (auto valid = result.validate(); !valid) return tl::unexpected<Error>(valid.error());
  return result;
}

Expected<void> View::validate() const {
  if (viewport.x <= 0 || viewport.y <= 0) {
    return fail("the viewport of " + std::to_string(viewport.x) + " x " + std::to_string(viewport.y) +
                " pixels is empty");
  }
  if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z)) {
    return fail("the eye position has a number that is NaN or infinite");
  }
  if (!all_finite(eye_from_world)) return fail("the view rotation has a number that is NaN or infinite");
  if (!all_finite(clip_from_eye)) return fail("the projection has a number that is NaN or infinite");
  if (!is_rotation(eye_from_world)) {
    return fail("the view rotation is not a rotation: its axes must be of unit length, at right angles, right-handed");
  }
  if (is_singular(clip_from_eye)) return fail("the projection is singular: check field of view, near and far plane");
  return {};
}

glm::dvec2 View::focal_px() const {
  const double divisor = std::abs(perspective() ? clip_from_eye[2][3] : clip_from_eye[3][3]);
  const glm::dvec2 focal(std::abs(clip_from_eye[0][0]), std::abs(clip_from_eye[1][1]));
  return focal / divisor * 0.5 * glm::dvec2(viewport);
}

double View::zoom() const {
  if (!perspective()) return 1.0;
  return std::abs(clip_from_eye[1][1] / clip_from_eye[2][3]) * std::tan(k_reference_half_fov);
}

double View::near_distance() const {
  const glm::dvec2 limits = depth_limits(*this);
  return is_reversed(*this) ? limits[1] : limits[0];
}

std::array<Plane, 6> frustum_planes(const View& view) {
  // Gribb and Hartmann (2001): a point is inside where -w <= x, y, z <= w, each a linear form of the point.
  const glm::dmat4 clip = view.clip_from_relative();
  const glm::dvec4 w = glm::row(clip, 3);
  std::array<Plane, 6> planes;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec4 form = glm::row(clip, axis);
    const double scale = glm::length(w) + glm::length(form);
    planes[size_t(2 * axis)] = normalised(w + form, scale);
    planes[size_t(2 * axis + 1)] = normalised(w - form, scale);
  }
  if (is_reversed(view)) std::swap(planes[4], planes[5]);
  return planes;
}

}  // namespace sward
