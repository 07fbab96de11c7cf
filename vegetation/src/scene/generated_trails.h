// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/generated_grid.h"

namespace sward::generated {

using Trail = std::vector<glm::vec2>;

/// Footpaths over the meadows: least effort between a few way points, one of which lies some metres east of the middle.
std::vector<Trail> find_trails(const Grid& heights, uint32_t seed);

/// How worn the ground is by the trails, 0..1, texel by texel of a square map over `width` metres: 1 along their
/// middle.
std::vector<uint8_t> trail_wear(std::span<const Trail> trails, int texels, float width);

}  // namespace sward::generated
