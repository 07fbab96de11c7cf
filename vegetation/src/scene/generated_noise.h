// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace sward::generated {

/// A well-mixed 32-bit hash of a lattice point and a seed.
uint32_t hash(int x, int y, uint32_t seed);
/// The same as a number in [0, 1).
float hash01(int x, int y, uint32_t seed);

/// Gradient noise of wavelength 1 (Perlin 2002: quintic fade, gradients of equal length in 256 directions), about
/// [-1, 1], zero on the integer lattice.
float noise(glm::vec2 p, uint32_t seed);

/// Octaves of noise: each half the wavelength and `gain` times the height of the one before, turned so that lattices
/// never coincide. Normalised by the sum of the heights.
float fbm(glm::vec2 p, int octaves, float gain, uint32_t seed);

/// Ridged multifractal (Musgrave 1998): sharp crests, smooth bottoms, finer octaves only near the crests. About [0, 1].
float ridged(glm::vec2 p, int octaves, uint32_t seed);

/// Two independent fbm values, to move the domain of something else.
glm::vec2 warp(glm::vec2 p, int octaves, uint32_t seed);

inline float smooth_step(float low, float high, float x) {
  const float t = glm::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace sward::generated
