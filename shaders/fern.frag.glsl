// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of ferns: leaflets left and right of a rib, shorter towards the tip and the stalk.
#include "common_rosette.glsl"

const float k_leaflets = 19.0;

// Half the frond's width at arc length `s`: a bare stalk, broadest below the middle, pointed.
float outline(float s) {
  float blade = clamp((s - 0.1) / 0.9, 0.0, 1.0);
  return smoothstep(0.0, 0.2, blade) * pow(1.0 - blade, 0.8) * 1.1;
}

// Place across a leaflet, -1..1, where leaflets lean towards the tip.
float across_leaflet() { return 2.0 * fract(part_mask.y * k_leaflets - abs(part_mask.x) * 2.2) - 1.0; }

float object_cover(bool shadow) {
  if (has_cutout()) return cutout_cover(part_mask.xy);
  float x = abs(part_mask.x), s = part_mask.y;
  float width = max(outline(s), 1.0e-3);
  float soft_x = max(part_footprint.x, 1.0e-3), soft_s = max(part_footprint.y * k_leaflets, 1.0e-3);
  float rest = x / width;
  // Leaflets are pointed, their edges toothed.
  float thick = 0.9 * sqrt(max(1.0 - rest * rest, 0.0)) * (0.9 + 0.1 * sin(rest * 40.0));
  float gap = (thick - abs(across_leaflet())) / (2.0 * soft_s + 2.0 * soft_x) + 0.5;
  float leaflet = mix(clamp(gap, 0.0, 1.0), 0.78 * thick, smoothstep(0.3, 0.9, soft_s));
  leaflet *= clamp((width - x) / soft_x + 0.5, 0.0, 1.0);
  float rib = clamp((0.035 * (1.2 - s) - x) / soft_x + 0.5, 0.0, 1.0);
  return max(leaflet, rib);
}

// Leaflets arch, so that one side of each is brighter.
float relief() {
  float fine = 1.0 - smoothstep(0.3, 0.9, part_footprint.y * k_leaflets);
  return 1.0 + 0.22 * fine * across_leaflet() + 0.12 * exp(-900.0 * part_mask.x * part_mask.x);
}
