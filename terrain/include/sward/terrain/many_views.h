// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>
#include <optional>
#include <span>

namespace sward {

/// One of several meshes (cameras, windows, sensors) over the same surface, and what it is to be updated for.
struct MeshUpdate {
  RoamMesh* mesh = nullptr;  ///< Not owned, not null; no mesh twice in a call.
  View view;
  std::optional<double> time_s;  ///< As RoamMesh::update(); nothing: without a clock.
  Expected<RoamStats> stats;     ///< What the update returned.
};

/// Updates the meshes on up to `threads` threads (0: all cores), the caller's among them; returns when all are done.
/// Each mesh comes out as from its own update(), and an update that fails leaves the others alone. The surfaces are
/// only read. Threads are started for each call, which costs some 30 microseconds a thread beside updates of
/// milliseconds, and leaves a host nothing to own or to end.
SWARD_API void update_all(std::span<MeshUpdate> updates, int threads = 0);

}  // namespace sward
