// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/frame.h>
#include <sward/gl/shader_library.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <span>

namespace sward::host {

/// A solid ball that rolls over the ground without slipping, slowed by what it rolls through.
struct RollingBall {
  glm::dvec3 centre{0};    ///< World, metres.
  glm::dvec2 velocity{0};  ///< Level, m/s.
  glm::dmat3 turn{1};      ///< From its own axes to the world's.
  double radius_m = 0.35;

  /// Rolls on by `seconds`, in steps of at most 1/120 s. Beyond the data it stops.
  void roll(double seconds, const Surface& ground);
  bool rests() const { return glm::dot(velocity, velocity) < 0.0025; }
};

/// Draws balls. GL thread.
class BallRenderer {
 public:
  static Expected<BallRenderer> create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  /// Binds program, vertex array, uniform buffer frame; leaves 0s.
  void draw(const gl::Frame& frame, const View& view, std::span<const RollingBall> balls);

 private:
  gl::Bindings bindings_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
};

}  // namespace sward::host
