// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/handles.h>

namespace sward::gl {

/// Fails where the device has no texture of this size; `what` begins the message.
Expected<void> check_texture_size(const char* what, glm::ivec2 size);
/// Whether set_trilinear() makes filters anisotropic: where the device has that in hardware.
bool anisotropic_filters();
/// Trilinear and clamped; anisotropic where the device has that in hardware.
void set_trilinear(GLuint texture);

}  // namespace sward::gl
