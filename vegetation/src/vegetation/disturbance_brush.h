// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/vegetation/disturbance.h>
#include <vector>

#include "vegetation/disturbance_tiles.h"

namespace sward {

/// Fails naming the number that is out of range.
Expected<void> validate(const DisturbanceBrush& brush, const DisturbanceTouch& touch);

/// Tiles of a level that a brush reaches; empty where they are more than `most`.
std::vector<TileKey> brushed_tiles(const DisturbanceBrush& brush, int level, size_t most);

/// Applies a brush to a tile's cells; true where something changed.
bool brush_tile(const DisturbanceBrush& brush, const DisturbanceTouch& touch, TileKey key, DisturbanceTile& tile,
                const CellClock& clock);

/// The planes that a touch may make.
PlaneSet planes_of(const DisturbanceTouch& touch);

}  // namespace sward
