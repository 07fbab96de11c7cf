// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <sward/vegetation/disturbance.h>
#include <memory>

namespace sward::host {

/// A scene's disturbance as time goes on: its file, then its walkers and events, replayed in steps of 1/25 s of the
/// scene's own time, so that what comes of it is the same at every frame rate. One thread at a time.
class DisturbanceReplay {
 public:
  /// Fails on options and files that Disturbance refuses. Cost: that of loading the file.
  static Expected<DisturbanceReplay> create(const Scene& scene);

  /// Lets the scene's time come to `time_s`, seconds; before 0 counts as 0. Where a scene has walkers or events, going
  /// back begins again from the file, and what else was done to the disturbance is lost; where it has none, going back
  /// changes nothing. Fails where the disturbance refuses a brush. Cost: some 40 us a step of a walker.
  Expected<void> advance_to(double time_s);

  /// The host's own brushes are welcome too. Stays at its place for life.
  Disturbance& disturbance() { return *disturbance_; }
  const Disturbance& disturbance() const { return *disturbance_; }

 private:
  DisturbanceReplay() = default;
  Expected<void> begin();
  Expected<void> step();

  SceneDisturbance scene_;
  std::string path_;  ///< Of the file.
  std::unique_ptr<Disturbance> disturbance_;
  double time_ = 0;
  double end_ = 0;      ///< After it nothing happens any more.
  int64_t steps_ = -1;  ///< Number of the last step taken.
};

}  // namespace sward::host
