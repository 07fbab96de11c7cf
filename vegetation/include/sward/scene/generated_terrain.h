// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/color_map.h>
#include <sward/terrain/height_field.h>

namespace sward {

struct GeneratorOptions {
  uint32_t seed = 1;
  int samples = 1025;      ///< Along each side, 65..8193.
  double size_m = 4096;    ///< Along each side, > 0.
  int map_texels = 2048;   ///< Base map, along each side, 64..8192.
  ReliefOptions relief;
};

struct GeneratedTerrain {
  HeightField field;
  ColorMap colors;
};

/// A place of ridges, valleys and gentle meadows with erosion-like shapes, about 400 m of relief in 4 x 4 km, and a
/// base map painted by slope, altitude, curvature and flow: grass, dry grass, soil, rock, snow. Deterministic: the same
/// bits for the same options on every run and thread count.
Expected<GeneratedTerrain> generate_meadow(const GeneratorOptions& options, const Progress& progress = {});

}  // namespace sward
