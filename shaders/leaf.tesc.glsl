// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of rosettes of broad leaves or fronds: one line a plant, bent like a blade.
#include "common_object_control.glsl"

vec2 object_widening(float widen) { return vec2(sqrt(widen)); }

float object_parts(SpeciesParams species, float distance, float size_px) {
  return max(min(segment_count(species, sward_layer.layer, distance), 0.25 * size_px), 1.0);
}
