// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Partial coverage of thin plants: alpha-to-coverage on multisampled targets, hashed alpha on others (Wyman, McGuire,
// "Hashed alpha testing", 2017, with the plant's own arc length as the place that the hash hangs on). GLSL only.

float hash_unit(uvec2 v) {
  uint h = v.x * 0x9E3779B1u ^ v.y * 0x85EBCA77u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return float((h ^ (h >> 15)) >> 8) * 5.9604645e-8;
}

// Alpha for a coverage, 0: draw nothing. Drivers turn alpha into whole samples, some rounding up, some to the nearest:
// the value lies where both give the number wanted. The plant's own number decides on the fraction of a sample, so that
// a field of thin plants has the right mean.
float sample_alpha(float cover, float phase) {
  float samples = frame.eye_noise.w;
  float wanted = min(floor(cover * samples + phase), samples);
  return wanted >= samples ? 1.0 : max(wanted - 0.25, 0.0) / samples;
}

// Whether this part of a plant is left out where there is one sample a pixel. Parts are as long as a pixel, in steps of
// two, so that the pattern stays on the plant while the eye moves.
bool hidden_by_hash(float cover, float phase, vec4 point) {
  if (cover >= 1.0) return false;
  float arc_per_px = max(fwidth(point.w), 1.0e-4);
  float parts = exp2(floor(-log2(arc_per_px)));
  return cover <= hash_unit(uvec2(uint(phase * 16777216.0), uint(point.w * parts)));
}
