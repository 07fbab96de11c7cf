// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of shrubs and trees: a trunk and as many clusters of leaves as the size on screen deserves.
#include "common_object_control.glsl"

// Heights stay, crowns widen.
vec2 object_widening(float widen) { return vec2(1.0, sqrt(widen)); }

// Clusters of leaves, and the trunk. A cluster of less than six pixels is worth none of its own.
float object_parts(SpeciesParams species, float distance, float size_px) {
  float by_distance = segment_count(species, sward_layer.layer, distance);
  float by_size = size_px * size_px / 144.0;
  return max(min(by_distance, by_size), 1.0) + 1.0;
}
