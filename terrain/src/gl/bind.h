// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Binding for a draw and putting back 0 afterwards.
#include <epoxy/gl.h>

namespace sward::gl {

/// Binds a uniform buffer to its index alone: glBindBufferBase would change the general binding as well.
inline void bind_uniforms(GLuint index, GLuint buffer) {
  glBindBuffersBase(GL_UNIFORM_BUFFER, index, 1, &buffer);
}

/// Likewise a shader storage buffer.
inline void bind_storage(GLuint index, GLuint buffer) {
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, index, 1, &buffer);
}

/// A texture, with its own sampling: a sampler object of the host's would take that one's place.
inline void bind_texture(GLuint unit, GLuint texture) {
  glBindTextureUnit(unit, texture);
  glBindSampler(unit, 0);
}

}  // namespace sward::gl
