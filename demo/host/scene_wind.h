// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene_wind.h>
#include <sward/vegetation/wind.h>
#include <optional>
#include <vector>

namespace sward::host {

/// The wind of a scene at any moment: what its file says, replayed. The same moment gives the same wind, whether it is
/// reached frame by frame or at once. One thread at a time.
class SceneWindReplay {
 public:
  /// Over ground from `min` of `size_m` metres. Fails where the painted maps do not fit.
  static Expected<SceneWindReplay> create(const SceneWind& scene, glm::dvec2 min, glm::dvec2 size_m);

  /// Goes on to a moment (seconds from the scene's start; negative counts as 0) by steps of at most 1/30 s. To an
  /// earlier one it starts anew: what the host has added to wind() is gone then.
  Expected<void> follow(double time_s, glm::dvec3 eye);

  Wind& wind() { return wind_; }
  const Wind& wind() const { return wind_; }

 private:
  Expected<void> start();
  Expected<void> move_all(double from_s, double to_s);

  SceneWind scene_;
  std::shared_ptr<const PaintedWind> painted_;
  Wind wind_;
  std::vector<std::optional<WindMoverId>> movers_;  // of the scene's, those that are there
};

}  // namespace sward::host
