// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The curve of a blade in the wind as C++: the shaders' own files.
#include <sward/vegetation/blade_shape.h>

#include "vegetation/shared_glsl.h"

namespace sward::shared {

using glm::atan;
using glm::clamp;
using glm::cos;
using glm::log;
using glm::mix;
using glm::normalize;
using glm::sin;

#define SWARD_FN inline
#define SWARD_PRECISE
#include "common_shells.glsl"
#include "common_sway.glsl"
#undef SWARD_FN

/// Functions of common_curve.glsl and common_bend.glsl over a table of shapes, which must outlive it.
class CurveTwin {
 public:
  explicit CurveTwin(const WindShapes& shapes) : texels_(shapes.texels) {}

#define SWARD_FN
#define SWARD_WIND 1
#define SWARD_BLADE_COLUMNS k_blade_columns
#define SWARD_BLADE_ROWS k_blade_rows
#define SWARD_WIND_LAYERS k_wind_layers
#define SWARD_CALM_LAYER k_calm_layer
#include "common_bend.glsl"
#undef SWARD_FN
#undef SWARD_WIND
#undef SWARD_BLADE_COLUMNS
#undef SWARD_BLADE_ROWS
#undef SWARD_WIND_LAYERS
#undef SWARD_CALM_LAYER
#undef SWARD_PRECISE

 private:
  vec4 blade_texel(int index) const {
    return texels_[size_t(index)];
  }

  std::span<const vec4> texels_;
};

}  // namespace sward::shared
