// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "sward/commands/flight_options.h"

namespace sward::tool {

/// The mesh over a baked world instead of over a scene.
struct WorldMeshOptions {
  std::string folder;      ///< Empty: no world.
  double memory_mb = 512;  ///< Cap of heights and bounds.
  bool wait = false;       ///< Every frame waits for what it wants: for measuring and
                           ///< pictures.
  // The command's own.
  PathOptions path;
  std::string timings, output;
  std::optional<size_t> at;
  uint32_t triangles = 20000;
  float target_px = 0;
  bool all = false, no_morph = false, plain = false;
};

/// Declares --world, --memory and --wait.
void add_world_options(CLI::App& app, WorldMeshOptions& options);

/// Flies over the world, squares loaded and dropped as the flight goes.
Expected<void> mesh_over_world(const WorldMeshOptions& options);

}  // namespace sward::tool
