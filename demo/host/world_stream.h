// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <sward/terrain/view.h>
#include <sward/terrain/world.h>
#include <map>
#include <utility>
#include <vector>

#include "host/scene_terrain.h"

namespace sward::host {

/// What a frame does about squares that it wants and that are not there.
enum class Streaming {
  live,  ///< Goes on with what is resident.
  wait,  ///< Waits: every run gives the same pictures.
};

/// A host's part in streaming a world: the control calls, one after the other, on one thread.
class WorldStream {
 public:
  explicit WorldStream(World& world) : world_(&world) {}

  /// One frame's share. Returns the boxes in which answers have changed, for every mesh and slope map. A square that
  /// cannot be loaded is named on stderr, once.
  std::vector<LatticeBox> step(const View& view);
  /// The same until everything that the view wants is resident. Fails, naming squares, when some cannot be loaded or
  /// when nothing has come for a minute; `progress` gets the share that is there.
  Expected<std::vector<LatticeBox>> wait(const View& view, const Progress& progress = {});

 private:
  void report_failures();

  World* world_;
  uint64_t failures_seen_ = 0;
  std::map<std::pair<int, int>, std::string> reported_;
};

/// Loads what the scene's first view wants, the ground below its camera first. Does nothing where the ground is no
/// world. No mesh has to be told: call it before one is made.
Expected<void> load_first_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport,
                               const Progress& progress = {});

}  // namespace sward::host
