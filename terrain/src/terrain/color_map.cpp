// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/color_map.h>

#include <cmath>
#include <string>

namespace sward {

Expected<void> ColorMap::validate() const {
  const std::string name = "colour map of " + std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width <= 0 || height <= 0) return fail(name + " is empty");
  if (texels.size() != size_t(width) * size_t(height)) {
    return fail(name + " holds " + std::to_string(texels.size()) + " texels; it needs width times height");
  }
  if (!std::isfinite(min_corner.x) || !std::isfinite(min_corner.y)) return fail(name + " has a corner that is NaN");
  if (!(size.x > 0.0 && size.y > 0.0) || !std::isfinite(size.x) || !std::isfinite(size.y)) {
    return fail(name + " has a size that is not above 0 metres");
  }
  const int columns = (width + ColorBounds::k_tile - 1) / ColorBounds::k_tile;
  const int rows = (height + ColorBounds::k_tile - 1) / ColorBounds::k_tile;
  const size_t tiles = size_t(columns) * size_t(rows);
  if (bounds && (bounds->columns != columns || bounds->rows != rows || bounds->least.size() != tiles ||
                 bounds->greatest.size() != tiles)) {
    return fail(name + " has bounds of another map");
  }
  return {};
}

std::shared_ptr<const ColorBounds> bound_colors(const ColorMap& map) {
  auto bounds = std::make_shared<ColorBounds>();
  bounds->columns = (map.width + ColorBounds::k_tile - 1) / ColorBounds::k_tile;
  bounds->rows = (map.height + ColorBounds::k_tile - 1) / ColorBounds::k_tile;
  const size_t tiles = size_t(bounds->columns) * size_t(bounds->rows);
  bounds->least.assign(tiles, glm::u8vec4(255));
  bounds->greatest.assign(tiles, glm::u8vec4(0));
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const size_t tile =
          size_t(row / ColorBounds::k_tile) * size_t(bounds->columns) + size_t(column / ColorBounds::k_tile);
      const glm::u8vec4 texel = map.texels[size_t(row) * size_t(map.width) + size_t(column)];
      bounds->least[tile] = glm::min(bounds->least[tile], texel);
      bounds->greatest[tile] = glm::max(bounds->greatest[tile], texel);
    }
  }
  return bounds;
}

}  // namespace sward
