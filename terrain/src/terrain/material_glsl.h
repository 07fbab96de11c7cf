// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The shader files that say which ground shows where, as C++ (see shaders/common_shared.glsl).
#include <glm/glm.hpp>

namespace sward::material_glsl {

using glm::clamp;
using glm::floor;
using glm::ivec2;
using glm::max;
using glm::min;
using glm::pow;
using glm::sqrt;
using glm::vec2;
using glm::vec3;
using glm::vec4;

#define SWARD_FN inline
#define SWARD_PRECISE
#include "common_classify.glsl"
#include "common_material.glsl"
#undef SWARD_FN
#undef SWARD_PRECISE

}  // namespace sward::material_glsl
