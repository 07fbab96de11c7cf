// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace sward {

/// Least and greatest red, green, blue, alpha of square tiles of a colour map: what lets seeding leave out ground that
/// can feed no species without a look at its texels. Row 0 is the northern edge, as the map's.
struct ColorBounds {
  static constexpr int k_tile = 16;  ///< Texels along a side; tiles at the eastern and southern edges may have less.
  int columns = 0, rows = 0;
  std::vector<glm::u8vec4> least, greatest;  ///< columns * rows.
};

/// The base map: the ground's colour, sRGB as stored in files, and where plants are forbidden outright (alpha 0).
/// Row 0 is the northern edge. Texel (i, j)'s centre lies at u = (i + 0.5) / width, u = (x - min.x) / size.x, and
/// v = (j + 0.5) / height counted from the north. Immutable after filling; safe from several threads.
struct SWARD_API ColorMap {
  int width = 0;
  int height = 0;
  std::vector<glm::u8vec4> texels;  ///< width * height, sRGB + alpha (255: plants may stand).
  glm::dvec2 min_corner{0};         ///< World, metres: west, south.
  glm::dvec2 size{1};               ///< Metres east and north.
  /// Of these texels (bound_colors), or null: seeding then submits barren ground too, which classification drops.
  std::shared_ptr<const ColorBounds> bounds = nullptr;

  Expected<void> validate() const;
};

/// One pass over the texels of a map that validates. Ask again where texels were changed.
SWARD_API std::shared_ptr<const ColorBounds> bound_colors(const ColorMap& map);

}  // namespace sward
