// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Whether a placed seed is worth growing. GLSL only.
#include "common_grow.glsl"
#include "common_visible.glsl"

// Below this height, pixels, a plant is left to the ground's own colour.
const float k_least_height_px = 0.3;

// Whether a plant of this height could be seen at all: asked before the ground is.
bool worth_growing(Seedling s, float height) {
  if (s.presence.fade <= 0.0) return false;
  height *= s.presence.fade;
  if (height * frame.focal.y < k_least_height_px * s.distance) return false;
  return sphere_visible(s.root, height * (1.0 + shadow_reach(sward_layer.layer, s.distance)));
}
