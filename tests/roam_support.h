// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/terrain.h>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

/// Height fields and views for tests, fuzzing and benchmarks of the mesh.
namespace roam_support {

/// A field and its bounds, at addresses that stay.
struct Terrain {
  std::unique_ptr<sward::HeightField> field;
  std::unique_ptr<sward::Bounds> bounds;
};

struct TerrainOptions {
  int columns = 65, rows = 65;
  double spacing = 10;
  double relief_m = 120;  ///< Height of the coarsest octave.
  int octaves = 6;
  double wavelength = 32;  ///< Of the coarsest octave, samples.
  bool detail = false;     ///< Relief below the data.
  glm::dvec3 origin{0};
  uint32_t seed = 1;
  std::vector<uint8_t> holes;
};

inline float lattice_noise(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  h ^= h >> 15;
  return float(h >> 8) * (2.0f / 16777216.0f) - 1.0f;
}

/// Smoothly interpolated random values, one a unit.
inline float value_noise(float x, float y, uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto ix = uint32_t(int32_t(fx)), iy = uint32_t(int32_t(fy));
  const float u = x - fx, v = y - fy;
  const float s = u * u * (3 - 2 * u), t = v * v * (3 - 2 * v);
  const float top = lattice_noise(ix, iy, seed) * (1 - s) + lattice_noise(ix + 1, iy, seed) * s;
  const float low = lattice_noise(ix, iy + 1, seed) * (1 - s) + lattice_noise(ix + 1, iy + 1, seed) * s;
  return top * (1 - t) + low * t;
}

/// Fractal hills, in part smoothed, so that bounds range over several octaves.
inline Terrain make_terrain(const TerrainOptions& options) {
  std::vector<float> samples(size_t(options.columns) * size_t(options.rows));
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      float z = 0, amplitude = float(options.relief_m), frequency = float(1 / options.wavelength);
      for (int octave = 0; octave < options.octaves; ++octave) {
        z +=
            amplitude * value_noise(float(column) * frequency, float(row) * frequency, options.seed + uint32_t(octave));
        amplitude *= 0.45f;
        frequency *= 2;
      }
      samples[size_t(row) * size_t(options.columns) + size_t(column)] = z;
    }
  }
  sward::HeightFieldDesc desc;
  desc.columns = options.columns;
  desc.rows = options.rows;
  desc.spacing = glm::dvec2(options.spacing);
  desc.origin = options.origin;
  desc.relief.enabled = options.detail;
  Terrain terrain;
  terrain.field =
      std::make_unique<sward::HeightField>(sward::HeightField::create(desc, std::move(samples), options.holes).value());
  terrain.bounds = std::make_unique<sward::Bounds>(sward::Bounds::create(*terrain.field));
  return terrain;
}

struct Random {
  std::mt19937 engine;
  explicit Random(uint32_t seed) : engine(seed) {}
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * (double(engine() >> 8) * (1.0 / 16777216.0)); }
  uint32_t below(uint32_t count) { return uint32_t(uint64_t(engine()) * count >> 32); }
};

/// Anywhere over, in or beside the field, looking anywhere; now and then from above, tele or orthographic.
inline sward::View random_view(const sward::HeightField& field, Random& random) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner(), size = high - low;
  const glm::dvec2 z = field.height_range();
  const glm::dvec3 eye(random.uniform(low.x - 0.2 * size.x, high.x + 0.2 * size.x),
                       random.uniform(low.y - 0.2 * size.y, high.y + 0.2 * size.y),
                       random.uniform(z[0] - 5, z[1] + 0.3 * size.x));
  const double azimuth = random.uniform(-3.2, 3.2), pitch = random.uniform(-1.5, 0.4);
  const double fov = random.below(4) == 0 ? random.uniform(0.05, 0.3) : random.uniform(0.6, 1.6);
  const double near_plane = std::pow(10.0, random.uniform(-1, 1));
  sward::View view = sward::View::look(eye, azimuth, pitch, fov, {1280, 720}, near_plane, near_plane * 1e5);
  if (random.below(8) == 0) {
    const double half = random.uniform(20, 0.5 * size.x);
    view.clip_from_eye = glm::dmat4(1.0);
    view.clip_from_eye[0][0] = 1 / half;
    view.clip_from_eye[1][1] = 1280.0 / 720.0 / half;
    view.clip_from_eye[2][2] = -2 / (4 * size.x);
    view.clip_from_eye[3][2] = -1;
  }
  return view;
}

}  // namespace roam_support
