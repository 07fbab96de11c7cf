// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Outlines of strips. GLSL only.
#include "common_layer.glsl"

// Factor on the width of a line of `segments` (fractional) that gives back the area it loses by cutting corners: a blade
// of one segment is a triangle. Corners weigh as the inverse square of the segments. `foot`, `tip`: the outline at its
// ends, `mean`: over its length. Plain layers are drawn as they are cut.
float outline_kept(float foot, float tip, float mean, float segments) {
  if (sward_layer.layer.reach.z != 0.0) return 1.0;
  float lost = (mean - 0.5 * (foot + tip)) / max(segments * segments, 1.0);
  return mean / max(mean - lost, 0.3 * mean);
}
