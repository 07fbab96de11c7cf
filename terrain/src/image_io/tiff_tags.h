// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace sward::image_io {

/// What OpenImageIO keeps to itself: the tags that GDAL and GeoTIFF add to a TIFF's first directory. All empty for a
/// file that is no TIFF.
struct GeoTags {
  std::optional<std::string> no_data;     ///< GDAL_NODATA (42113), as written.
  std::optional<glm::dvec2> pixel_scale;  ///< ModelPixelScale (33550), x and y, in units of the model.
  std::optional<uint16_t> model_type;     ///< GTModelTypeGeoKey (1024): 1 projected, 2 geographic.
  std::optional<uint16_t> projection;     ///< ProjectedCSTypeGeoKey (3072), an EPSG code.
  std::optional<uint16_t> linear_units;   ///< ProjLinearUnitsGeoKey (3076): 9001 is the metre.

  /// True when the pixel scale is known to be in metres: said so, or a UTM zone on WGS 84.
  bool in_metres() const;
};

/// Reads classic and big TIFF of both byte orders. Fails when a tag points outside of the file.
Expected<GeoTags> read_geo_tags(const std::string& path);

}  // namespace sward::image_io
