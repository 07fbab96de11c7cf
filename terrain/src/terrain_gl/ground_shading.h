// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/frame.h>
#include <sward/gl/ground.h>

namespace sward {

/// What terrain.frag.glsl needs, whatever mesh is drawn with it: sets its uniforms, makes the program current and binds
/// frame, base map and slope map; leaves program 0, those units and that uniform buffer binding 0 on destruction.
class GroundShading {
 public:
  GroundShading(const gl::Program& program, const gl::Bindings& bindings, const View& view, const gl::Frame& frame,
                const gl::GroundTextures& ground);
  ~GroundShading();
  GroundShading(const GroundShading&) = delete;
  GroundShading& operator=(const GroundShading&) = delete;

 private:
  const gl::Bindings& bindings_;
};

/// Binds a uniform buffer to its index alone: glBindBufferBase would change the general binding as well.
void bind_uniforms(GLuint index, GLuint buffer);

}  // namespace sward
