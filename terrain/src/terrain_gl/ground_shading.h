// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/frame.h>
#include <sward/gl/ground.h>

namespace sward {

/// What terrain.frag.glsl needs, whatever mesh is drawn with it: sets its uniforms, makes the program current and binds
/// what it reads; leaves program 0, those units, their samplers and those uniform buffer bindings 0 on destruction.
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

}  // namespace sward
