// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <sward/terrain/color_map.h>
#include <sward/terrain/height_field.h>

namespace sward {

/// How to read a height image. Channels: exactly 1, or the first of several equal ones (grey stored as RGB); else an
/// error.
struct HeightImport {
  std::string path;
  glm::dvec2 spacing{1.0, 1.0};         ///< Metres between samples; ignored where the file has a GeoTIFF scale and
                                        ///< `use_file_spacing` is set and the file is in metres.
  double scale = 1.0;                   ///< Metres a raw unit; integers are NOT normalised to [0, 1].
  double offset = 0.0;                  ///< Metres added.
  std::optional<double> no_data;        ///< Overrides the file's own tag (GDAL_NODATA); without either, -32768 in
                                        ///< signed 16-bit files, NaN in float files.
  glm::dvec3 origin{0.0};
  ReliefOptions relief;
};

/// 8 and 16-bit PNG, int16 / uint16 / float TIFF and GeoTIFF, EXR, whatever OpenImageIO reads. 16-bit signed and 8-bit
/// data are stored in 16 bits with the offset folded in. Any thread; no partial results.
Expected<HeightField> load_height_field(const HeightImport& import);

/// 8 or 16-bit RGB(A) or grey image as base map over the rectangle. An alpha channel below one half forbids plants.
Expected<ColorMap> load_color_map(const std::string& path, glm::dvec2 min_corner, glm::dvec2 size);

/// Forbids plants (alpha 0) on every texel that touches a cell with a hole.
void mask_holes(ColorMap& colors, const HeightField& field);

/// Writes 8-bit RGB rows, top first, to PNG (or what the extension names): to a temporary file beside it, renamed when
/// complete, so that no partial file stays.
Expected<void> save_image(const std::string& path, int width, int height, std::span<const uint8_t> rgb);

}  // namespace sward
