// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "scene/generated_grid.h"

namespace sward::generated {

/// Width of what is generated, in the generator's own metres.
inline constexpr float k_width = 4096;

/// The eroded place, wider than what is shown, so that its artificial edge is out of sight.
struct Relief {
  Grid heights;  ///< Metres, the lowest shown 0; 5 m between samples.
  Grid meadow;   ///< 1 where soil and grass cover rolling ground, 0 in the mountains.
  Grid area;     ///< Drainage area, square metres, spread.
};

/// Lays out ridges and valleys, lifts and erodes them from 40 m down to 5 m. `progress` gets 0..1.
Relief make_relief(uint32_t seed, const std::function<void(float done)>& progress);

/// Heights as shown: `samples` along each side over k_width, with hummocks in the meadows and broken rock on the slopes
/// that the 5 m of the erosion cannot hold. `threads` as for_each_row takes it.
Grid sample_surface(const Relief& relief, int samples, uint32_t seed, int threads);

}  // namespace sward::generated
