// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Gradient noise on the ground that repeats every 1024 m, so that it stays where it is however far the eye travels.
// Perlin, "Improving noise" (2002), with an integer hash instead of a table, and with its derivative.

uint noise_hash(uvec2 cell, uint seed) {
  uint h = cell.x * 0x9E3779B1u ^ cell.y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

// One of 256 slopes of a lattice point.
vec2 noise_slope(uvec2 cell, uint seed) {
  uint h = noise_hash(cell, seed);
  return vec2(float(h & 0xFFFFu), float(h >> 16)) * (2.0 / 65535.0) - 1.0;
}

// Noise of one octave at `p` metres (modulo 1024). `cells` a metre is a power of two between 1/1024 and 64. Returns the
// value, about -0.7 to 0.7, and its derivative a metre east and north.
vec3 ground_noise(vec2 p, float cells, uint seed) {
  vec2 q = p * cells;
  vec2 corner = floor(q);
  vec2 f = q - corner;
  uvec2 mask = uvec2(uint(1024.0 * cells) - 1u);
  uvec2 c00 = uvec2(ivec2(corner)) & mask;
  uvec2 c11 = (c00 + 1u) & mask;
  vec2 g00 = noise_slope(c00, seed);
  vec2 g10 = noise_slope(uvec2(c11.x, c00.y), seed);
  vec2 g01 = noise_slope(uvec2(c00.x, c11.y), seed);
  vec2 g11 = noise_slope(c11, seed);
  float v00 = dot(g00, f);
  float v10 = dot(g10, f - vec2(1.0, 0.0));
  float v01 = dot(g01, f - vec2(0.0, 1.0));
  float v11 = dot(g11, f - vec2(1.0, 1.0));
  vec2 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec2 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  float cross_term = v00 - v10 - v01 + v11;
  float value = v00 + u.x * (v10 - v00) + u.y * (v01 - v00) + u.x * u.y * cross_term;
  vec2 slope = g00 + u.x * (g10 - g00) + u.y * (g01 - g00) + u.x * u.y * (g00 - g10 - g01 + g11) +
               du * (vec2(v10 - v00, v01 - v00) + u.yx * cross_term);
  return vec3(value, slope * cells);
}
