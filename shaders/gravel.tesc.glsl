// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of gravel: facets around a stone by its size on screen; the smallest are dots.
#include "common_object_control.glsl"

// Smaller than this, pixels, a stone is a dot.
const float k_dot_px = 3.0;

vec2 object_widening(float widen) { return vec2(sqrt(widen)); }

float object_parts(SpeciesParams species, float distance, float size_px) {
  if (size_px < k_dot_px) return 1.0;
  // Facets of about four pixels.
  float wanted = min(0.8 * size_px, segment_count(species, sward_layer.layer, distance));
  return max(wanted, 5.0);
}
