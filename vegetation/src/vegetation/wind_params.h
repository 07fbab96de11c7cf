// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// shaders/common_wind_params.glsl as C++.
#include <cstddef>
#include <glm/glm.hpp>

namespace sward::wind_shared {

using glm::vec2;
using glm::vec4;

#include "common_wind_params.glsl"

// std140.
static_assert(sizeof(WindSourceParams) == 64);
static_assert(offsetof(WindParams, gust_place) == 32);
static_assert(offsetof(WindParams, painted) == 160);
static_assert(sizeof(WindParams) == 176 + 64 * k_wind_sources);

}  // namespace sward::wind_shared
