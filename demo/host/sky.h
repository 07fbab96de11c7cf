// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/frame.h>
#include <sward/gl/shader_library.h>

namespace sward::host {

/// A simple analytic sky behind everything (drawn at the far plane, after the terrain, depth test LEQUAL). GL thread.
class Sky {
 public:
  static Expected<Sky> create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  /// Binds program, vertex array, uniform buffer frame; sets the depth function to LEQUAL and back to LESS; leaves 0s.
  void draw(const gl::Frame& frame);

 private:
  gl::Bindings bindings_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
};

}  // namespace sward::host
