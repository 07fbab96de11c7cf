// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/plant_image.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

namespace sward {

namespace {

constexpr int k_least_side = 8, k_most_side = 2048;

bool is_side(int side) {
  return side >= k_least_side && side <= k_most_side && std::has_single_bit(unsigned(side));
}

}  // namespace

PlantImage::PlantImage(int width, int height, std::span<const uint8_t> greys)
    : width_(width), height_(height), greys_(greys.begin(), greys.end()) {}

Expected<std::shared_ptr<const PlantImage>> PlantImage::create(int width, int height, std::span<const uint8_t> greys) {
  if (!is_side(width) || !is_side(height)) {
    return fail("a plant's image is " + std::to_string(width) + " x " + std::to_string(height) +
                " but its sides must be powers of two from 8 to 2048; scale it, to 256 x 256 say");
  }
  if (greys.size() != size_t(width) * size_t(height)) {
    return fail("a plant's image of " + std::to_string(width) + " x " + std::to_string(height) + " has " +
                std::to_string(greys.size()) + " greys; give one a pixel");
  }
  return std::shared_ptr<const PlantImage>(new PlantImage(width, height, greys));
}

namespace {

constexpr int k_side = 256;
constexpr float k_turn = 2 * std::numbers::pi_v<float>;
constexpr std::array<std::string_view, 3> k_names{"veins", "fibres", "mottled"};

uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  return h ^ h >> 15;
}

float lattice(int x, int y, int columns, int rows, uint32_t seed) {
  return float(hash(uint32_t((x + columns) % columns), uint32_t((y + rows) % rows), seed) >> 8) * 0x1p-24f;
}

/// Value noise of columns x rows cells over the image, periodic in both, -1..1.
float noise(float u, float v, int columns, int rows, uint32_t seed) {
  const float x = u * float(columns), y = v * float(rows);
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  const float a = ease(x - float(i)), b = ease(y - float(j));
  const float top = std::lerp(lattice(i, j, columns, rows, seed), lattice(i + 1, j, columns, rows, seed), a);
  const float bottom = std::lerp(lattice(i, j + 1, columns, rows, seed), lattice(i + 1, j + 1, columns, rows, seed), a);
  return 2 * std::lerp(top, bottom, b) - 1;
}

/// Parallel veins, a little uneven, a pale rib, fields between the veins of their own.
float veins(float u, float v) {
  const float across = 2 * u - 1;
  const float wander = 0.15f * noise(u, v, 4, 2, 1);
  const float ridge = std::cos(k_turn * (7.5f * across + wander));
  const float rib = std::exp(-90 * across * across);
  return 0.38f * ridge * (1 - rib) + 0.75f * rib + 0.22f * noise(u, v, 16, 3, 2) + 0.12f * noise(u, v, 64, 24, 3);
}

float fibres(float u, float v) {
  return 0.45f * noise(u, v, 24, 2, 4) + 0.35f * noise(u, v, 64, 5, 5) + 0.2f * noise(u, v, 128, 16, 6);
}

float mottled(float u, float v) {
  const float patches = noise(u, v, 3, 5, 7) + 0.6f * noise(u, v, 8, 12, 8);
  return 0.5f * patches + 0.3f * noise(u, v, 24, 36, 9) + 0.15f * noise(u, v, 96, 96, 10);
}

/// The function in greys of mean one half, most of them within the range.
std::shared_ptr<const PlantImage> paint(float (*detail)(float u, float v)) {
  std::vector<float> values;
  values.reserve(size_t(k_side) * k_side);
  double sum = 0;
  for (int row = 0; row < k_side; ++row) {
    for (int column = 0; column < k_side; ++column) {
      values.push_back(detail((float(column) + 0.5f) / k_side, (float(row) + 0.5f) / k_side));
      sum += double(values.back());
    }
  }
  const float mean = float(sum / double(values.size()));
  std::vector<uint8_t> greys;
  greys.reserve(values.size());
  for (const float value : values)
    greys.push_back(uint8_t(std::clamp(127.5f + 127.5f * (value - mean), 0.0f, 255.0f) + 0.5f));
  return *PlantImage::create(k_side, k_side, greys);
}

}  // namespace

std::span<const std::string_view> built_in_details() {
  return k_names;
}

std::shared_ptr<const PlantImage> built_in_detail(std::string_view name) {
  static const std::array<std::shared_ptr<const PlantImage>, k_names.size()> images{paint(veins), paint(fibres),
                                                                                    paint(mottled)};
  const auto found = std::find(k_names.begin(), k_names.end(), name);
  return found == k_names.end() ? nullptr : images[size_t(found - k_names.begin())];
}

}  // namespace sward
