// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/image_io/image_io.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "image_io/raw_image.h"

namespace sward {

namespace {

using image_io::RawImage;
using image_io::SampleType;

uint8_t to_8_bit(uint8_t value) {
  return value;
}
uint8_t to_8_bit(uint16_t value) {
  return uint8_t((uint32_t(value) + 128) / 257);
}

template <class T>
void fill_texels(const RawImage& image, ColorMap& map) {
  constexpr T half = T(1) << (8 * sizeof(T) - 1);
  const std::span<const T> samples = image.samples<T>();
  const size_t channels = size_t(image.channels);
  const bool grey = image.channels < 3;
  map.texels.resize(image.pixels());
  for (size_t i = 0; i < map.texels.size(); ++i) {
    const T* pixel = &samples[i * channels];
    const bool allowed = image.alpha_channel < 0 || pixel[image.alpha_channel] >= half;
    map.texels[i] = {to_8_bit(pixel[0]), to_8_bit(pixel[grey ? 0 : 1]), to_8_bit(pixel[grey ? 0 : 2]),
                     allowed ? uint8_t(255) : uint8_t(0)};
  }
}

/// Grey or RGB first, alpha last if at all.
Expected<void> check_channels(const RawImage& image, const std::string& name) {
  const int colors = image.alpha_channel < 0 ? image.channels : image.channels - 1;
  const bool alpha_last = image.alpha_channel < 0 || image.alpha_channel == image.channels - 1;
  if ((colors != 1 && colors != 3) || !alpha_last) {
    return fail(name + " has " + std::to_string(image.channels) +
                " channels, expected grey, grey and alpha, RGB or RGBA");
  }
  if (image.type != SampleType::uint8 && image.type != SampleType::uint16) {
    return fail(name + " has " + image_io::describe(image.type) + " samples, expected sRGB in 8 or 16 bits");
  }
  return {};
}

Expected<ColorMap> load(const std::string& path, glm::dvec2 min_corner, glm::dvec2 size) {
  const std::string name = image_io::named("base map", path);
  const auto image = image_io::read_image(path, "base map");
  if (!image) return tl::unexpected(image.error());
  if (auto checked = check_channels(*image, name); !checked) return tl::unexpected(checked.error());
  ColorMap map;
  map.width = image->width;
  map.height = image->height;
  map.min_corner = min_corner;
  map.size = size;
  if (image->type == SampleType::uint8)
    fill_texels<uint8_t>(*image, map);
  else
    fill_texels<uint16_t>(*image, map);
  if (auto valid = map.validate(); !valid) return fail(name + ": " + valid.error().message);
  map.bounds = bound_colors(map);
  return map;
}

/// Texels whose closed extents meet [from, to] (in texels, from the western or northern edge).
struct TexelRange {
  int begin, end;
};
TexelRange touched(double from, double to, int count) {
  // Extents that meet up to rounding count as touching.
  constexpr double slack = 1e-6;
  const double first = std::floor(from - slack), last = std::floor(to + slack);
  return {int(std::clamp(first, 0.0, double(count))), int(std::clamp(last + 1, 0.0, double(count)))};
}

}  // namespace

Expected<ColorMap> load_color_map(const std::string& path, glm::dvec2 min_corner, glm::dvec2 size) {
  try {
    return load(path, min_corner, size);
  } catch (const std::exception& error) {
    return fail(image_io::named("base map", path) + " cannot be read: " + error.what());
  }
}

void mask_holes(ColorMap& colors, const HeightField& field) {
  if (field.hole_count() == 0) return;
  const HeightFieldDesc& desc = field.desc();
  const glm::dvec2 texels_per_m = glm::dvec2(colors.width, colors.height) / colors.size;
  const double west = desc.origin.x - 0.5 * (desc.columns - 1) * desc.spacing.x;
  const double north = desc.origin.y + 0.5 * (desc.rows - 1) * desc.spacing.y;
  const double map_north = colors.min_corner.y + colors.size.y;
  const auto texel_x = [&](int column) {
    return (west + column * desc.spacing.x - colors.min_corner.x) * texels_per_m.x;
  };
  const auto texel_y = [&](int row) { return (map_north - (north - row * desc.spacing.y)) * texels_per_m.y; };

  for (int row = 0; row < desc.rows; ++row) {
    for (int column = 0; column < desc.columns; ++column) {
      if (!field.is_hole(column, row)) continue;
      // The cells around a sample reach to its neighbours.
      const auto x =
          touched(texel_x(std::max(column - 1, 0)), texel_x(std::min(column + 1, desc.columns - 1)), colors.width);
      const auto y = touched(texel_y(std::max(row - 1, 0)), texel_y(std::min(row + 1, desc.rows - 1)), colors.height);
      for (int j = y.begin; j < y.end; ++j) {
        for (int i = x.begin; i < x.end; ++i) colors.texels[size_t(j) * size_t(colors.width) + size_t(i)].a = 0;
      }
    }
  }
}

}  // namespace sward
