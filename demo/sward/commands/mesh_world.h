// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <optional>
#include <string>

#include "sward/commands/flight_options.h"

namespace sward::tool {

/// The mesh over a scene's world.
struct WorldMeshOptions {
  bool wait = false;  ///< Every frame waits for what it wants: for measuring.
  PathOptions path;
  std::string timings, output;
  std::optional<size_t> at;
  uint32_t triangles = 20000;
  float target_px = 0;
  bool all = false, no_morph = false, plain = false;
};

/// Flies over the world, squares loaded and dropped as the flight goes.
Expected<void> mesh_over_world(const Scene& scene, const WorldMeshOptions& options);

}  // namespace sward::tool
