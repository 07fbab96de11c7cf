// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Large forms are eroded on a coarse grid for long, small ones on finer grids for ever shorter times.

#include "scene/generated_relief.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/generated_erosion.h"
#include "scene/generated_layout.h"
#include "scene/generated_noise.h"

namespace sward::generated {

namespace {

struct Stage {
  int samples;
  int steps;
  float dt;
  int steps_per_routing;
  float roughening;  // metres of noise that start new gullies
};

constexpr float k_simulated_width = 5120;
constexpr std::array<Stage, 4> k_stages{
    {{129, 20, 0.02f, 1, 14.0f}, {257, 20, 0.010f, 2, 6.0f}, {513, 12, 0.005f, 3, 2.5f}, {1025, 5, 0.003f, 5, 1.0f}}};
constexpr float k_relief = 600;  // metres from the lowest to the highest shown

bool shown(glm::vec2 p) {
  return std::max(std::abs(p.x), std::abs(p.y)) <= 0.5f * k_width;
}

// Bends straight valleys: they are only as straight as the coarse grid's eight directions made them.
Grid bent(const Grid& ground, uint32_t seed) {
  Grid result(ground.side, ground.spacing);
  const float wavelength = 15 * ground.spacing;
  for (int row = 0; row < ground.side; ++row) {
    for (int column = 0; column < ground.side; ++column) {
      const glm::vec2 p = ground.position(column, row);
      result.at(column, row) = ground.bicubic(p + 0.17f * wavelength * warp(p / wavelength, 3, seed + 65));
    }
  }
  return result;
}

void roughen(Grid& ground, const Grid& mountain, float metres, uint32_t seed) {
  for (int row = 1; row + 1 < ground.side; ++row) {
    for (int column = 1; column + 1 < ground.side; ++column) {
      const glm::vec2 p = ground.position(column, row);
      float& z = ground.at(column, row);
      z = std::max(1.0f, z + metres * mountain.bilinear(p) * fbm(p / (5 * ground.spacing), 2, 0.6f, seed + 70));
    }
  }
}

// Moves and scales heights so that the shown part spans k_relief from 0.
void normalise(Grid& ground) {
  float low = 1.0e9f, high = -1.0e9f;
  for (int row = 0; row < ground.side; ++row) {
    for (int column = 0; column < ground.side; ++column) {
      if (!shown(ground.position(column, row))) continue;
      low = std::min(low, ground.at(column, row));
      high = std::max(high, ground.at(column, row));
    }
  }
  const float scale = k_relief / (high - low);
  for (float& z : ground.values) z = (z - low) * scale;
}

// 1 in the meadows, 0 in the mountains.
Grid meadow_mask(const Grid& mountain) {
  Grid mask = mountain;
  for (float& value : mask.values) value = 1 - smooth_step(0.08f, 0.36f, value);
  return mask;
}

}  // namespace

Relief make_relief(uint32_t seed, const std::function<void(float done)>& progress) {
  Relief relief;
  constexpr int k_plan = 257;
  const Layout layout = make_layout(k_plan, k_simulated_width / float(k_plan - 1), seed);
  constexpr std::array<float, 4> k_done{0.1f, 0.25f, 0.5f, 1.0f};
  for (size_t i = 0; i < k_stages.size(); ++i) {
    const Stage& stage = k_stages[i];
    const uint32_t stage_seed = seed + 1000 * uint32_t(i);
    relief.heights = i == 0 ? resampled(layout.first_ground, stage.samples) : bent(refined(relief.heights), stage_seed);
    roughen(relief.heights, layout.mountain, stage.roughening, stage_seed);
    erode(relief.heights, resampled(layout.forces, stage.samples), {stage.steps, stage.dt, stage.steps_per_routing},
          stage_seed);
    if (progress) progress(k_done[i]);
  }
  Flow flow;
  route_flow(relief.heights, seed + 9000, flow);
  relief.area = spread_area(relief.heights, flow);
  relief.meadow = meadow_mask(layout.mountain);
  normalise(relief.heights);
  return relief;
}

namespace {

// Octaves between a first wavelength and twice the sample spacing.
int octaves_above(float wavelength, float spacing, int most) {
  int octaves = 0;
  while (octaves < most && wavelength >= 2 * spacing) {
    wavelength *= 0.5f;
    ++octaves;
  }
  return octaves;
}

struct Roughness {
  int hummock_octaves, rock_octaves, crag_octaves;
};

float surface_height(const Relief& relief, const Grid& steepness, const Roughness& rough, glm::vec2 p, uint32_t seed) {
  const float meadow = relief.meadow.bilinear(p);
  const float steep = smooth_step(0.4f, 0.95f, steepness.bilinear(p));
  float z = relief.heights.bicubic(p);
  // Hummocks: lower in some places than in others.
  const float lively = 0.55f + 0.45f * noise(p / 390.0f, seed + 80);
  z += meadow * lively * 3.2f * fbm(p / 118.0f, rough.hummock_octaves, 0.36f, seed + 81);
  if (rough.rock_octaves > 0 && steep > 0)
    z += steep * 6.0f * (ridged(p / 46.0f, rough.rock_octaves, seed + 90) - 0.45f);
  // Crags along the crests.
  const float crest = smooth_step(240, 460, z);
  if (crest > 0) z += crest * (0.3f + 0.7f * steep) * 24 * (ridged(p / 135.0f, rough.crag_octaves, seed + 95) - 0.42f);
  return z;
}

}  // namespace

Grid sample_surface(const Relief& relief, int samples, uint32_t seed, int threads) {
  Grid surface(samples, k_width / float(samples - 1));
  Grid steepness(relief.heights.side, relief.heights.spacing);
  for (int row = 0; row < steepness.side; ++row)
    for (int column = 0; column < steepness.side; ++column)
      steepness.at(column, row) = glm::length(gradient(relief.heights, column, row));
  const Roughness rough{octaves_above(118, surface.spacing, 6), octaves_above(46, surface.spacing, 6),
                        std::min(2, octaves_above(135, surface.spacing, 6))};
  for_each_row(samples, threads, [&](int row) {
    for (int column = 0; column < samples; ++column)
      surface.at(column, row) = surface_height(relief, steepness, rough, surface.position(column, row), seed);
  });
  return surface;
}

}  // namespace sward::generated
