// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/vegetation/placement.h>
#include <sward/vegetation/wind.h>
#include <memory>
#include <string>
#include <vector>

namespace sward {

/// A mover and its way.
struct SceneWindMover {
  WindMover mover;
  /// Seconds, x, y (world, metres), metres above the ground; times rising. It is there from the first time to the last;
  /// with one place for ever from its time on.
  std::vector<glm::dvec4> path;
};

/// The wind as a scene file names it. Maps are named, not loaded.
struct SceneWind {
  Weather weather;
  std::vector<WindSource> sources;
  std::vector<SceneWindMover> movers;
  std::string strength_file, turn_file;     ///< Grey images over the ground's map; empty: none.
  std::shared_ptr<const GrayMap> strength;  ///< 128: the wind as it is, 0: none, 255: twice as strong.
  std::shared_ptr<const GrayMap> turn;      ///< 128: not turned, 192: a quarter to the left, 64: to the right.
  std::string where;                        ///< "FILE:LINE", for errors of the maps.
};

/// The painted map over ground from `min` of `size_m` metres; null without maps. Fails where a map is named and not
/// loaded, or the two differ in size.
SWARD_API Expected<std::shared_ptr<const PaintedWind>> painted_wind(const SceneWind& wind, glm::dvec2 min,
                                                                    glm::dvec2 size_m);

}  // namespace sward
