// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The grey map and the normal map of Knowles and Fryazinov, "Increasing realism of animated grass in real-time game
// environments" (2015), from gradient noise (Perlin, "Improving noise", 2002) instead of an artist.
#include "vegetation/wind_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sward {

namespace {

constexpr int k_side = WindMaps::k_side;
constexpr size_t k_texels = size_t(k_side) * k_side;

uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

/// Gradient noise of `period` cells a side.
float noise(glm::vec2 uv, int period, uint32_t seed) {
  const glm::vec2 q = uv * float(period), corner = glm::floor(q), f = q - corner;
  const auto slope = [&](int x, int y) {
    const uint32_t h = hash(uint32_t((int(corner.x) + x) % period), uint32_t((int(corner.y) + y) % period), seed);
    const float angle = float(h >> 8) * (6.2831853f / 16777216.0f);
    return glm::dot(glm::vec2(std::cos(angle), std::sin(angle)), f - glm::vec2(x, y));
  };
  const glm::vec2 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  return glm::mix(glm::mix(slope(0, 0), slope(1, 0), u.x), glm::mix(slope(0, 1), slope(1, 1), u.x), u.y);
}

/// Octaves from `period` cells a side on, each half as long and `gain` times as high as the one before.
std::vector<float> octaves(int period, int count, float gain, uint32_t seed) {
  std::vector<float> values(k_texels, 0.0f);
  float height = 1;
  for (int octave = 0; octave < count; ++octave, height *= gain)
    for (size_t i = 0; i < k_texels; ++i) {
      const glm::vec2 uv = (glm::vec2(i % k_side, i / k_side) + 0.5f) / float(k_side);
      values[i] += height * noise(uv, period << octave, seed + uint32_t(octave));
    }
  return values;
}

/// Replaces values by their ranks, 0 to 255: every grey is equally frequent, the mean is one half.
std::vector<uint8_t> ranked(const std::vector<float>& values) {
  std::vector<uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  std::vector<uint8_t> ranks(values.size());
  for (size_t i = 0; i < order.size(); ++i) ranks[order[i]] = uint8_t(i * 256 / order.size());
  return ranks;
}

/// The slope of heights, scaled so that 2.5 standard deviations reach 1.
std::vector<glm::vec2> slopes(const std::vector<float>& heights) {
  const auto at = [&](int x, int y) { return heights[size_t(y & (k_side - 1)) * k_side + size_t(x & (k_side - 1))]; };
  std::vector<glm::vec2> all(k_texels);
  double squares = 0;
  for (int y = 0; y < k_side; ++y)
    for (int x = 0; x < k_side; ++x) {
      const glm::vec2 slope(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
      squares += glm::dot(slope, slope);
      all[size_t(y) * k_side + size_t(x)] = slope;
    }
  const auto scale = float(1.0 / (2.5 * std::sqrt(squares / double(2 * k_texels))));
  for (glm::vec2& slope : all) slope = glm::clamp(slope * scale, -1.0f, 1.0f);
  return all;
}

WindMaps make_maps() {
  const std::vector<uint8_t> large = ranked(octaves(WindMaps::k_gusts[0], 4, 0.55f, 1));
  const std::vector<uint8_t> little = ranked(octaves(WindMaps::k_gusts[1], 4, 0.6f, 11));
  const std::vector<glm::vec2> normals = slopes(octaves(32, 2, 0.6f, 21));
  WindMaps maps;
  for (size_t i = 0; i < k_texels; ++i) {
    maps.layers[0].emplace_back(large[i], little[i], 0, 255);
    const glm::ivec2 code = 128 + glm::ivec2(glm::round(127.0f * normals[i]));
    maps.layers[1].emplace_back(code.x, code.y, 0, 255);
  }
  return maps;
}

}  // namespace

const WindMaps& wind_maps() {
  static const WindMaps maps = make_maps();
  return maps;
}

glm::vec2 sample_wind_map(int layer, glm::vec2 uv) {
  const std::vector<glm::u8vec4>& texels = wind_maps().layers[size_t(layer)];
  const glm::vec2 q = (uv - glm::floor(uv)) * float(k_side) - 0.5f, corner = glm::floor(q), f = q - corner;
  const auto texel = [&](int x, int y) {
    const int column = (int(corner.x) + x) & (k_side - 1), row = (int(corner.y) + y) & (k_side - 1);
    return glm::vec2(texels[size_t(row) * k_side + size_t(column)]);
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y) / 255.0f;
}

}  // namespace sward
