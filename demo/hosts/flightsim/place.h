// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <sward/terrain/surface.h>
#include <string>

#include "flightsim/pilot.h"

namespace flightsim {

/// Makes the place in `folder`, or keeps what an earlier run has finished: eight by eight kilometres of meadows and
/// hills, levelled for a strip, baked into world/ (64 squares of 257 x 257 samples, 4 m apart), its base map
/// ground.png, and strip.toml, the scene that names both and keeps plants off the runway.
/// Fails when the folder cannot be written.
sward::Expected<void> make_place(const std::string& folder, const sward::Progress& progress = {});

/// The strip of that place, at the height that the levelled ground has.
Strip strip_of(const sward::Surface& ground);

/// Asks the finest ground that is resident; `ground` must outlive it.
GroundBelow ground_below(const sward::Surface& ground);

}  // namespace flightsim
