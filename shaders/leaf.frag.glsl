// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of broad leaves: a stalk, an outline, a rib with veins.
#include "common_rosette.glsl"

// Half the outline's width at arc length `s`, 0..1.
float outline(float s) {
  float blade = clamp((s - 0.22) / 0.78, 0.0, 1.0);
  float broad = pow(blade, 0.55) * (1.0 - blade * blade) * 1.45;
  return max(broad, s < 0.5 ? 0.07 : 0.0);
}

float object_cover(bool shadow) {
  if (has_cutout()) return cutout_cover(part_mask.xy);
  return edge_cover(outline(part_mask.y) - abs(part_mask.x));
}

// The rib is pale, the fields between the veins bulge.
float relief() {
  float x = abs(part_mask.x);
  float footprint = part_footprint.y * 14.0;
  float veins = sin(6.2831853 * (part_mask.y * 14.0 - x * 3.0));
  float rib = exp(-40.0 * x * x);
  return 1.0 + 0.10 * veins * (1.0 - smoothstep(0.25, 0.6, footprint)) * (1.0 - rib) + 0.25 * rib;
}
