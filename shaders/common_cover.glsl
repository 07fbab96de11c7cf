// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Partial coverage of thin plants: alpha to coverage on multisampled targets, hashed alpha on others (Wyman, McGuire,
// "Hashed alpha testing", 2017, with the plant's own arc length as the place that the hash hangs on). GLSL only.
//
// The mask of samples is written here, not left to GL_SAMPLE_ALPHA_TO_COVERAGE: drivers round alpha differently, and
// their masks are nested, so that of two plants covering a quarter of a pixel each one would always hide the other.

#include "common_hash.glsl"

const int k_all_samples = -1;

// Samples that a plant of this coverage takes: as many as it covers, the fraction of one decided by the plant's own
// number, which also says where they begin.
int coverage_mask(float cover, float phase) {
  int samples = min(int(frame.eye_noise.w), 30);
  int wanted = int(cover * float(samples) + phase);
  if (wanted >= samples) return k_all_samples;
  int run = (1 << wanted) - 1;
  int turn = int(fract(phase * 61.803399) * float(samples));
  return (run << turn | run >> (samples - turn)) & ((1 << samples) - 1);
}

// Whether this part of a plant is left out where there is one sample a pixel. Parts are as long as a pixel, in steps of
// two, so that the pattern stays on the plant while the eye moves.
bool hidden_by_hash(float cover, float phase, float arc) {
  if (cover >= 1.0) return false;
  float arc_per_px = max(fwidth(arc), 1.0e-4);
  float parts = exp2(floor(-log2(arc_per_px)));
  return cover <= hash_unit(uvec2(uint(phase * 16777216.0), uint(arc * parts)));
}
