// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace sward {

/// A square piece of ground that tiles: what a texture of the ground near the eye adds to the base map's colour. It is
/// a factor around 1, so that the ground keeps the base map's colour: the mean of every channel at every level is 1.
/// Immutable after filling; safe from several threads.
struct SWARD_API DetailTexture {
  static constexpr int k_side = 512;          ///< Texels a side of level 0.
  static constexpr int k_levels = 10;         ///< Down to one texel.
  static constexpr float k_unit = 128.0f;     ///< The code that stands for the factor 1; 255 is 1.99.
  static constexpr float k_steepest = 48.0f;  ///< Slope that the code 127 stands for: heights (0..1) a tile.

  /// Red, green, blue: factors on linear colour; alpha: height, 0 lowest .. 255 highest. Levels one after the other,
  /// the largest first, rows from the north.
  std::vector<glm::u8vec4> shade;
  /// Change of the height towards the east and the north, in k_steepest / 127 a tile. As `shade`.
  std::vector<glm::i8vec2> slope;

  static constexpr int side(int level) { return k_side >> level; }
  /// Where a level begins; of k_levels: how many texels there are.
  static constexpr size_t offset(int level) {
    size_t texels = 0;
    for (int i = 0; i < level; ++i) texels += size_t(side(i)) * size_t(side(i));
    return texels;
  }
  /// Mean factor of a level.
  glm::vec3 mean(int level) const;
};

/// Names that generate_detail() knows: "soil", "grass", "gravel", "rock", "strata", "sand", "litter", "snow",
/// "mottle" (clumps and hollows without anything that has a size of its own).
SWARD_API std::span<const std::string_view> generated_details();

/// Paints one of them; the same bytes on every call and machine of the same floating point. Fails on another name,
/// listing those that there are. Any thread. Cost: 20 to 60 ms.
SWARD_API Expected<DetailTexture> generate_detail(std::string_view name);

/// From an image of any square size from 16 to 8192 texels a side (sRGB; alpha is ignored), resampled by areas. Colours
/// are divided by their mean, and brightness is taken for height. Its borders should match: it is repeated. `name`
/// begins messages. Fails where the sides differ, are out of range, or the image is black.
SWARD_API Expected<DetailTexture> detail_from_image(std::string_view name, int width, int height,
                                                    std::span<const glm::u8vec4> texels);

}  // namespace sward
