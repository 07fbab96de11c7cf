// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The plants of the GPU against those of the CPU (CONTRACT: CPU and GPU twins).
#include <algorithm>
#include <tuple>
#include <vector>

#include "gl/vegetation_fixture.h"

namespace sward::test {

inline auto plant_key(const Plant& p) {
  return std::tuple(p.triangle.bits, p.rank, p.species);
}

inline void sort_plants(std::vector<Plant>& plants) {
  std::sort(plants.begin(), plants.end(), [](const Plant& a, const Plant& b) { return plant_key(a) < plant_key(b); });
}

/// Classifies what was looked at, reads it back, compares; returns the plants of the GPU, sorted by plant_key.
/// `height_tolerance`: metres beside a ten-thousandth.
inline std::vector<Plant> expect_same_plants(Patch& patch, size_t at_least, float height_tolerance = 0) {
  patch.classify();
  std::vector<Plant> gpu = patch.plants_of_gpu(), cpu = patch.plants_of_cpu();
  sort_plants(gpu);
  sort_plants(cpu);
  size_t matched = 0, unmatched = 0, wrong = 0;
  for (size_t i = 0, j = 0; i < gpu.size() || j < cpu.size();) {
    if (i < gpu.size() && j < cpu.size() && plant_key(gpu[i]) == plant_key(cpu[j])) {
      const Plant &a = gpu[i++], &b = cpu[j++];
      wrong += glm::length(a.position - b.position) > 1e-3 || std::abs(a.height - b.height) > height_tolerance + 1e-4f * b.height ||
               std::abs(a.score - b.score) > 1e-4f || std::abs(a.fade - b.fade) > 1e-3f;
      ++matched;
      continue;
    }
    ++unmatched;
    const bool gpu_first = j == cpu.size() || (i < gpu.size() && plant_key(gpu[i]) < plant_key(cpu[j]));
    gpu_first ? ++i : ++j;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GE(matched, at_least);
  EXPECT_LE(double(unmatched), 0.001 * double(matched + unmatched) + 0.5);
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
  return gpu;
}

}  // namespace sward::test
