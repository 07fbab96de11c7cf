// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "scene/generated_erosion.h"

namespace sward::generated {

/// The plan of a place, before any erosion.
struct Layout {
  Grid mountain;      ///< How high the mountains stand: 0 in the meadows, about 1 on the highest ridge.
  Grid first_ground;  ///< Metres above an arbitrary base, > 0.
  Forces forces;
};

/// The plan on a grid whose spacing is at most some 20 m.
Layout make_layout(int samples, float spacing, uint32_t seed);
/// The same over the same square with 2^n times more or fewer cells.
Grid resampled(Grid grid, int samples);
Forces resampled(const Forces& forces, int samples);

}  // namespace sward::generated
