// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/frame.h>
#include <sward/gl/shader_library.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <sward/vegetation/wind.h>
#include <vector>

namespace sward::host {

/// Arrows of Wind::at() over the ground around the camera, blue in calm over green and yellow (10 m/s) to red (20 m/s
/// and more). Half a metre apart near the eye, farther out wider, to 384 m; at 10 m/s as long as they are apart. GL
/// thread.
class WindOverlay {
 public:
  static Expected<WindOverlay> create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  /// Draws over what is there, with its depths. Binds program, vertex array, uniform buffer frame; leaves 0s.
  void draw(const gl::Frame& frame, const View& view, const Wind& wind, const Surface& ground);

 private:
  struct Vertex {
    glm::vec3 position{0};  // relative to the eye
    float speed = 0;
  };
  void add_arrow(const Wind& wind, const Surface& ground, glm::dvec2 at, double length);

  gl::Bindings bindings_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer buffer_;
  glm::dvec3 eye_{0};
  std::vector<Vertex> lines_;
};

}  // namespace sward::host
