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
  return {};
}

}  // namespace sward
