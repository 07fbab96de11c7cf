// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/viewer/camera.h"

#include <algorithm>
#include <cmath>

#include "host/scene_terrain.h"

namespace sward::tool {

namespace {

constexpr double k_steepest_look = 1.55;  // radians: just short of straight up, where yaw loses its meaning
constexpr double k_least_clearance_m = 0.3;

double ground_below(const Surface& ground, glm::dvec3 at) {
  const Lattice& lattice = ground.lattice();
  return ground.height(glm::clamp(glm::dvec2(at), lattice.min_corner(), lattice.max_corner()));
}

}  // namespace

void WalkCamera::move(const CameraInput& input, double seconds, const Surface& surface) {
  yaw = std::remainder(yaw + input.look.x, 6.283185307179586);
  pitch = std::clamp(pitch + input.look.y, -k_steepest_look, k_steepest_look);
  const double rise = walking ? 0 : pitch;
  const glm::dvec3 ahead(std::cos(yaw) * std::cos(rise), std::sin(yaw) * std::cos(rise), std::sin(rise));
  const glm::dvec3 right(std::sin(yaw), -std::cos(yaw), 0);
  glm::dvec3 way = ahead * double(input.forward) + right * double(input.right);
  if (!walking) way.z += input.up;

  const double above = std::max(position.z - ground_below(surface, position), 0.0);
  const double metres_a_second = speed * (input.fast ? 5 : 1) * (walking ? 1 : std::max(1.0, above / 10));
  if (glm::length(way) > 0) position += glm::normalize(way) * metres_a_second * seconds;

  const double ground = ground_below(surface, position);
  if (walking) {
    eye_height_m = std::max(eye_height_m + input.up * seconds, k_least_clearance_m);
    position.z = ground + eye_height_m;
  }
  position.z = std::max(position.z, ground + k_least_clearance_m);
}

View WalkCamera::view(glm::ivec2 viewport, const Surface& surface) const {
  return View::look(position, yaw, pitch, fov_y, viewport, host::k_near_plane_m, host::far_plane_m(surface));
}

}  // namespace sward::tool
