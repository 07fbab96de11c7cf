// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <glm/glm.hpp>

namespace sward::gl {

inline constexpr int k_disturbance_levels = 3;

/// Mirror of `SwardDisturbance` in shaders/common_disturbance.glsl, std140. All 0: nothing has been touched.
struct DisturbanceBlock {
  glm::vec4 state{0};  ///< Levels held, 0: none; factors on press and on water; layers in use: 0, 1 burn, 2 paint too.
  std::array<glm::vec4, k_disturbance_levels> level{};  ///< Texture place of the eye; 1 / width (1/m); reach (m).
};
static_assert(sizeof(DisturbanceBlock) == 16 * (1 + k_disturbance_levels));

/// What terrain and plants read of a disturbance. Names of objects that others own; 0: nothing is disturbed.
struct DisturbedGround {
  GLuint block = 0;  ///< Uniform buffer, a DisturbanceBlock.
  GLuint map = 0;    ///< Texture, RGBA16F array.
};

}  // namespace sward::gl
