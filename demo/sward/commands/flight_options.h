// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "host/flight.h"
#include "host/scene_terrain.h"

namespace CLI {
class App;
}

namespace sward::tool {

/// The options that name a camera path.
struct PathOptions {
  std::string flight = "paper";   ///< "paper", "still" (of commands that call make_still) or a CSV file.
  double from_s = 0;              ///< Leaves out what comes before.
  std::optional<double> seconds;  ///< Cuts the path off; empty: all of it.
  double fps = 60;
  std::string size = "1920x1080";  ///< Viewport of paths that have none.
};

void add_path_options(CLI::App& app, PathOptions& options);

/// Checks the numbers that need no field: call it before long work.
Expected<void> check_path(const PathOptions& options);
/// Loads or computes the frames over the scene's ground. Over a world they come from a file.
Expected<std::vector<host::FlightFrame>> make_path(const PathOptions& options, const host::SceneTerrain& terrain);
/// Frames of a camera that stands where the scene's does: for what moves by itself.
Expected<std::vector<host::FlightFrame>> make_still(const PathOptions& options, const Scene& scene,
                                                    const host::SceneTerrain& terrain);
/// Fails when the path has no frame of that number (--at).
Expected<void> check_frame(size_t at, const std::vector<host::FlightFrame>& path);

}  // namespace sward::tool
