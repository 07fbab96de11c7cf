// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/handles.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace sward::host {

/// Off-screen colour (RGBA8) and depth (32F), multisampled when samples > 1. GL thread.
class RenderTarget {
 public:
  /// samples 0: the device's maximum. More than that is an error that names the maximum.
  static Expected<RenderTarget> create(glm::ivec2 size, int samples);
  static int max_samples();

  GLuint framebuffer() const { return draw_framebuffer_.id(); }
  int samples() const { return samples_; }
  glm::ivec2 size() const { return size_; }
  /// Binds for drawing, sets the viewport, clears colour and depth (1), enables the depth test (GL_LESS).
  void begin();
  /// Resolves and reads back 8-bit RGB rows, top first.
  std::vector<uint8_t> read_rgb();

 private:
  gl::Framebuffer draw_framebuffer_, resolve_framebuffer_;
  gl::Texture color_, depth_, resolved_;
  glm::ivec2 size_{0};
  int samples_ = 1;
};

}  // namespace sward::host
