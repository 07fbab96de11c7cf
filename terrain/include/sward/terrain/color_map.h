// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sward {

/// The base map: the ground's colour, sRGB as stored in files, and where plants are forbidden outright (alpha 0).
/// Row 0 is the northern edge. Texel (i, j)'s centre lies at u = (i + 0.5) / width, u = (x - min.x) / size.x, and
/// v = (j + 0.5) / height counted from the north. Immutable after filling; safe from several threads.
struct ColorMap {
  int width = 0;
  int height = 0;
  std::vector<glm::u8vec4> texels;  ///< width * height, sRGB + alpha (255: plants may stand).
  glm::dvec2 min_corner{0};         ///< World, metres: west, south.
  glm::dvec2 size{1};               ///< Metres east and north.

  Expected<void> validate() const;
};

}  // namespace sward
