// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/height_field.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

namespace sward {

/// How to read a height image. Channels: exactly 1, or several equal ones (grey stored as RGB); else an error.
struct HeightImport {
  std::string path;
  glm::dvec2 spacing{1.0, 1.0};  ///< Metres between samples, x and y, > 0. Not used with `use_file_spacing`.
  /// Take the spacing from the file: GeoTIFF's pixel scale. Fails when the file has none, or not in metres.
  bool use_file_spacing = false;
  double scale = 1.0;   ///< Metres a raw unit, not 0; integers are NOT normalised to [0, 1].
  double offset = 0.0;  ///< Metres added.
  /// No-data value in raw units. Overrides the file's own tag (GDAL_NODATA); without either, -32768 in signed 16-bit
  /// files. NaN and infinite samples are holes always.
  std::optional<double> no_data{};
  glm::dvec3 origin{0.0};
  ReliefOptions relief{};
};

/// 8 and 16-bit PNG, int16 / uint16 / float TIFF and GeoTIFF, EXR, whatever OpenImageIO reads: what the file is, its
/// first bytes decide before its extension. 8-bit and signed 16-bit samples are stored in 16 bits with the offset
/// folded in; half and double become float; 32-bit integers become float where they fit (up to 2^24), else an error.
/// Missing, empty, damaged and truncated files are errors. Any thread; no partial results.
SWARD_API Expected<HeightField> load_height_field(const HeightImport& import);

/// 8 or 16-bit sRGB picture, grey or RGB, with or without alpha, as base map over the rectangle (metres, size > 0).
/// Alpha below one half forbids plants; the colours under it are kept as stored. 16 bits are rounded to 8.
SWARD_API Expected<ColorMap> load_color_map(const std::string& path, glm::dvec2 min_corner, glm::dvec2 size);

/// Forbids plants (alpha 0) on every texel that touches a cell with a hole, a cell being the rectangle between four
/// samples. Sharing an edge or a corner is touching.
SWARD_API void mask_holes(ColorMap& colors, const HeightField& field);

/// Writes 8-bit RGB rows, top first, 3 * width * height bytes, as the extension says: png, jpg, jpeg, bmp, tga, ppm; 1
/// to 65500 pixels a side. To a temporary file in the same folder, renamed when complete, so that no partial file stays
/// and an older file stays whole when writing fails. Fails on a missing folder, naming it.
SWARD_API Expected<void> save_image(const std::string& path, int width, int height, std::span<const uint8_t> rgb);

}  // namespace sward
