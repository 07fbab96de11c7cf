// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/sky.h"

#include "host/uniforms.h"

namespace sward::host {

Expected<Sky> Sky::create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  gl::ProgramDesc desc;
  desc.name = "sky";
  desc.vertex = "sky.vert.glsl";
  desc.fragment = "sky.frag.glsl";
  desc.defines = gl::binding_defines(bindings);
  Expected<gl::Program> program = shaders.build(desc);
  if (!program) return tl::unexpected(program.error());
  Sky sky;
  sky.bindings_ = bindings;
  sky.program_ = std::move(*program);
  sky.vertex_array_ = gl::create_vertex_array();
  return sky;
}

void Sky::draw(const gl::Frame& frame) {
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  glDepthFunc(GL_LEQUAL);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
  bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward::host
