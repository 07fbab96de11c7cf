// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

namespace sward::host {

/// Binds a uniform buffer to its index alone: glBindBufferBase would change the general binding as well.
inline void bind_uniforms(GLuint index, GLuint buffer) {
  glBindBuffersBase(GL_UNIFORM_BUFFER, index, 1, &buffer);
}

}  // namespace sward::host
