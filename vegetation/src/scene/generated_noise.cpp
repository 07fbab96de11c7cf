// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/generated_noise.h"

#include <array>
#include <cmath>

namespace sward::generated {

uint32_t hash(int x, int y, uint32_t seed) {
  uint32_t h = seed * 0x9E3779B9u ^ uint32_t(x) * 0x85EBCA6Bu ^ (uint32_t(y) * 0xC2B2AE35u + 0x27D4EB2Fu);
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  return h ^ (h >> 16);
}

float hash01(int x, int y, uint32_t seed) {
  return float(hash(x, y, seed) >> 8) * 0x1p-24f;
}

namespace {

constexpr double k_tau = 6.283185307179586;

std::array<glm::vec2, 256> make_gradients() {
  std::array<glm::vec2, 256> table;
  for (size_t i = 0; i < table.size(); ++i) {
    const double angle = k_tau * double(i) / double(table.size());
    table[i] = {float(std::cos(angle)), float(std::sin(angle))};
  }
  return table;
}

const std::array<glm::vec2, 256> g_gradients = make_gradients();

float corner(int x, int y, uint32_t seed, float dx, float dy) {
  const glm::vec2 g = g_gradients[hash(x, y, seed) >> 24];
  return g.x * dx + g.y * dy;
}

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

// The next octave's point: doubled and turned by about 37 degrees (a Pythagorean triple), and moved.
glm::vec2 next_octave(glm::vec2 p) {
  return {2.0f * (0.8f * p.x - 0.6f * p.y) + 17.37f, 2.0f * (0.6f * p.x + 0.8f * p.y) - 5.71f};
}

}  // namespace

float noise(glm::vec2 p, uint32_t seed) {
  const float bx = std::floor(p.x), by = std::floor(p.y);
  const int x = int(bx), y = int(by);
  const float dx = p.x - bx, dy = p.y - by;
  const float u = fade(dx), v = fade(dy);
  const float a = corner(x, y, seed, dx, dy);
  const float b = corner(x + 1, y, seed, dx - 1, dy);
  const float c = corner(x, y + 1, seed, dx, dy - 1);
  const float d = corner(x + 1, y + 1, seed, dx - 1, dy - 1);
  const float low = a + (b - a) * u;
  const float high = c + (d - c) * u;
  return 1.5f * (low + (high - low) * v);
}

float fbm(glm::vec2 p, int octaves, float gain, uint32_t seed) {
  float sum = 0, height = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += height * noise(p, seed + uint32_t(i));
    total += height;
    height *= gain;
    p = next_octave(p);
  }
  return total > 0 ? sum / total : 0.0f;
}

float ridged(glm::vec2 p, int octaves, uint32_t seed) {
  float sum = 0, height = 0.5f, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    float crest = 1 - std::abs(noise(p, seed + uint32_t(i)));
    crest *= crest * weight;
    weight = glm::clamp(2.0f * crest, 0.0f, 1.0f);
    sum += crest * height;
    height *= 0.5f;
    p = next_octave(p);
  }
  return sum;
}

glm::vec2 warp(glm::vec2 p, int octaves, uint32_t seed) {
  return {fbm(p, octaves, 0.5f, seed), fbm(p + glm::vec2(31.7f, -12.9f), octaves, 0.5f, seed + 101)};
}

}  // namespace sward::generated
