// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A plant's own numbers beyond its traits, for shading and shape alone: they need not agree with the CPU. GLSL only.

// [0, 1).
float hash_unit(uvec2 v) {
  uint h = v.x * 0x9E3779B1u ^ v.y * 0x85EBCA77u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return float((h ^ (h >> 15)) >> 8) * 5.9604645e-8;
}
