// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/generated_relief.h"

namespace sward::generated {

/// What the ground is covered with.
enum class Ground { grass, dry_grass, soil, rock, snow };
inline constexpr int k_grounds = 5;

struct Paint {
  std::vector<glm::u8vec4> texels;  ///< sRGB + alpha 255, row 0 north, over k_width.
  std::vector<Ground> ground;       ///< What covers most of each texel.
};

/// Paints the place as it looks from the air at noon, without light or shadow. `surface` is what sample_surface made;
/// `threads` as for_each_row takes it; `progress` gets 0..1.
Paint paint_ground(const Relief& relief, const Grid& surface, int texels, uint32_t seed, int threads,
                   const std::function<void(float done)>& progress);

}  // namespace sward::generated
