// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The shader files that CPU and GPU share, as C++ (see shaders/common_shared.glsl).
#include <cstdint>
#include <glm/glm.hpp>

namespace sward::shared {

using glm::atan;
using glm::clamp;
using glm::floor;
using glm::ivec2;
using glm::max;
using glm::min;
using glm::pow;
using glm::sqrt;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;

inline uvec2 mul_wide(uint a, uint b) {
  const uint64_t product = uint64_t(a) * b;
  return {uint(product), uint(product >> 32)};
}

#define SWARD_FN inline
#define SWARD_PRECISE
#include "common_classify.glsl"
#include "common_philox.glsl"
#include "common_placement.glsl"
#include "common_plant.glsl"
#include "common_surface.glsl"
#include "common_kinds.glsl"
#include "common_seed.glsl"
#include "common_disturbed.glsl"
#include "common_disturbed_plant.glsl"
#undef SWARD_FN
#undef SWARD_PRECISE

}  // namespace sward::shared
