// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>

namespace sward::tool {

/// What the keys and the mouse ask for in one frame. Moves are -1, 0 or 1.
struct CameraInput {
  int forward = 0, right = 0, up = 0;
  bool fast = false;
  glm::dvec2 look{0};  ///< Radians: yaw (counter-clockwise), pitch (up).
};

/// A camera that flies freely, or walks with its eyes at a constant height above the ground.
class WalkCamera {
 public:
  glm::dvec3 position{0};
  double yaw = 0, pitch = 0;  ///< Radians.
  double fov_y = 0.87;        ///< Radians.
  bool walking = true;
  double eye_height_m = 1.7;
  double speed = 4;  ///< Metres a second walking; flying is faster the higher it is.

  /// Moves by `seconds` of input. The camera never sinks below the ground.
  void move(const CameraInput& input, double seconds, const Surface& surface);
  View view(glm::ivec2 viewport, const Surface& surface) const;
};

}  // namespace sward::tool
