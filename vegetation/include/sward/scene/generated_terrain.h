// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/height_field.h>

namespace sward {

struct GeneratorOptions {
  uint32_t seed = 1;
  int samples = 1025;     ///< Along each side, 65..8193.
  double size_m = 4096;   ///< Along each side, 64..1e6. Everything keeps its shape: heights grow with it.
  int map_texels = 2048;  ///< Base map, along each side, 64..8192.
  ReliefOptions relief;
};

struct GeneratedTerrain {
  HeightField field;
  ColorMap colors;
};

/// A place of ridges, valleys and gentle meadows, eroded, about 600 m of relief in 4 x 4 km: a high range in the north,
/// a spur of it in the east, hills in the west and south-west; around the middle, meadows that drain to the south.
/// Heights count from about the lowest ground. The base map is painted by slope, altitude, curvature and flow: grass,
/// dry grass, soil, rock, snow; alpha is 255 everywhere. Deterministic: the same bits for the same options on every run
/// and thread count.
///
/// A good first view: 1.7 m above the ground at (0, 0), yaw 80 to 95 degrees, pitch 2 degrees, sun in the west.
///
/// Fails on options out of range and where HeightField::create fails. Any thread; uses all of the machine's for
/// painting. Takes some seconds at the default size; memory is about 80 MB and 5 bytes a texel.
SWARD_API Expected<GeneratedTerrain> generate_meadow(const GeneratorOptions& options, const Progress& progress = {});

}  // namespace sward
