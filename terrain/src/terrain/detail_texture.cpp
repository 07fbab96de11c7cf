// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/detail_texture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "terrain/detail_canvas.h"

namespace sward {

namespace {

constexpr int k_least_side = 16, k_largest_side = 8192;
constexpr float k_most = 255.0f / DetailTexture::k_unit;

float linear_of(uint8_t code) {
  const float c = float(code) / 255;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 mean_of(std::span<const glm::vec3> colors) {
  glm::dvec3 sum(0);
  for (size_t begin = 0; begin < colors.size(); begin += DetailTexture::k_side) {
    glm::vec3 row(0);
    const size_t end = std::min(begin + size_t(DetailTexture::k_side), colors.size());
    for (size_t i = begin; i < end; ++i) row += colors[i];
    sum += row;
  }
  return glm::vec3(sum / double(colors.size()));
}

/// What four texels of the level before make.
template <class T>
std::vector<T> halve(const std::vector<T>& level, int side) {
  std::vector<T> half;
  half.reserve(level.size() / 4);
  for (int y = 0; y < side; y += 2) {
    const T* row = &level[size_t(y) * size_t(side)];
    for (int x = 0; x < side; x += 2) half.push_back((row[x] + row[x + 1] + row[x + side] + row[x + side + 1]) * 0.25f);
  }
  return half;
}

glm::u8vec4 encode_shade(glm::vec3 factor, float height) {
  return {glm::u8vec3(glm::clamp(factor * DetailTexture::k_unit + 0.5f, 0.0f, 255.0f)),
          uint8_t(std::clamp(height * 255 + 0.5f, 0.0f, 255.0f))};
}

glm::i8vec2 encode_slope(glm::vec2 slope) {
  // Rounds to the nearest; already clamped.
  const glm::vec2 code = slope * (127.0f / DetailTexture::k_steepest) + 128.5f;
  return glm::i8vec2(glm::ivec2(code) - 128);
}

/// Central differences; rows run south.
std::vector<glm::vec2> slopes_of(const std::vector<float>& height) {
  constexpr int side = DetailTexture::k_side;
  std::vector<glm::vec2> slopes;
  slopes.reserve(height.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      using detail::Canvas;
      const glm::vec2 rise(height[Canvas::index(x + 1, y)] - height[Canvas::index(x - 1, y)],
                           height[Canvas::index(x, y - 1)] - height[Canvas::index(x, y + 1)]);
      // Clamped here, so that the means of coarser levels are those of what level 0 holds.
      slopes.push_back(glm::clamp(rise * (0.5f * float(side)), -DetailTexture::k_steepest, DetailTexture::k_steepest));
    }
  }
  return slopes;
}

void to_unit_range(std::vector<float>& height) {
  // The hundredth part at either end is cut: single peaks must not flatten all else. A sample of them is enough.
  std::vector<float> sorted;
  for (size_t i = 0; i < height.size(); i += 13) sorted.push_back(height[i]);
  const auto place = [&](double share) {
    const auto nth = sorted.begin() + std::ptrdiff_t(share * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), nth, sorted.end());
    return *nth;
  };
  const float low = place(0.01), high = place(0.99);
  const float scale = high > low ? 1 / (high - low) : 0.0f;
  for (float& h : height) h = std::clamp((h - low) * scale, 0.0f, 1.0f);
}

/// Factors around 1 that fit their codes.
void divide_by_mean(std::vector<glm::vec3>& color) {
  for (int pass = 0; pass < 4; ++pass) {
    const glm::vec3 inverse = 1.0f / glm::max(mean_of(color), glm::vec3(1.0e-6f));
    for (glm::vec3& c : color) c = glm::min(c * inverse, glm::vec3(k_most));
  }
}

}  // namespace

glm::vec3 DetailTexture::mean(int level) const {
  glm::dvec3 sum(0);
  for (size_t i = offset(level); i < offset(level + 1); ++i) sum += glm::dvec3(glm::u8vec3(shade[i]));
  return glm::vec3(sum / (double(k_unit) * double(side(level)) * double(side(level))));
}

void detail::shade_hollows(Canvas& canvas, float depth) {
  std::vector<float> height = canvas.height;
  to_unit_range(height);
  for (size_t i = 0; i < height.size(); ++i) canvas.color[i] *= depth + (1 - depth) * height[i];
}

void detail::calm(Canvas& canvas, float chroma) {
  const glm::vec3 mean = mean_of(canvas.color), luminance(0.2126f, 0.7152f, 0.0722f);
  const float inverse = 1 / std::max(glm::dot(mean, luminance), 1.0e-6f);
  for (glm::vec3& color : canvas.color)
    color = mean * (glm::dot(color, luminance) * inverse) * (1 - chroma) + color * chroma;
}

DetailTexture detail::finish(Canvas canvas) {
  divide_by_mean(canvas.color);
  to_unit_range(canvas.height);
  DetailTexture texture;
  texture.shade.reserve(DetailTexture::offset(DetailTexture::k_levels));
  texture.slope.reserve(DetailTexture::offset(DetailTexture::k_levels));
  std::vector<glm::vec3> color = std::move(canvas.color);
  std::vector<float> height = std::move(canvas.height);
  std::vector<glm::vec2> slope = slopes_of(height);
  for (int level = 0; level < DetailTexture::k_levels; ++level) {
    for (size_t i = 0; i < color.size(); ++i) {
      texture.shade.push_back(encode_shade(color[i], height[i]));
      texture.slope.push_back(encode_slope(slope[i]));
    }
    const int side = DetailTexture::side(level);
    if (side == 1) break;
    color = halve(color, side);
    height = halve(height, side);
    slope = halve(slope, side);
  }
  return texture;
}

namespace {

/// Shares of source texels in one of the tile's along an axis: box filter enlarged, bilinear (wrapping) magnified.
struct Tap {
  int texel;
  float share;
};
std::vector<Tap> taps(int to, int side) {
  const double scale = double(side) / DetailTexture::k_side;
  const double reach = std::max(scale, 1.0), centre = (to + 0.5) * scale;
  std::vector<Tap> all;
  double sum = 0;
  for (int at = int(std::floor(centre - reach)); at <= int(std::ceil(centre + reach)); ++at) {
    const double share = std::max(0.0, 1 - std::abs(at + 0.5 - centre) / reach);
    if (share <= 0) continue;
    all.push_back({(at % side + side) % side, float(share)});
    sum += share;
  }
  for (Tap& tap : all) tap.share = float(tap.share / sum);
  return all;
}

std::vector<glm::vec3> resample(int side, std::span<const glm::u8vec4> texels) {
  constexpr int k_side = DetailTexture::k_side;
  std::array<float, 256> linear{};
  for (size_t i = 0; i < linear.size(); ++i) linear[i] = linear_of(uint8_t(i));
  std::vector<std::vector<Tap>> axis;
  for (int i = 0; i < k_side; ++i) axis.push_back(taps(i, side));
  std::vector<glm::vec3> rows(size_t(side) * k_side, glm::vec3(0)), result(size_t(k_side) * k_side, glm::vec3(0));
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < k_side; ++x)
      for (const Tap& tap : axis[size_t(x)]) {
        const glm::u8vec4 texel = texels[size_t(y) * size_t(side) + size_t(tap.texel)];
        rows[size_t(y) * k_side + size_t(x)] +=
            tap.share * glm::vec3(linear[texel.r], linear[texel.g], linear[texel.b]);
      }
  for (int y = 0; y < k_side; ++y)
    for (const Tap& tap : axis[size_t(y)])
      for (int x = 0; x < k_side; ++x)
        result[size_t(y) * k_side + size_t(x)] += tap.share * rows[size_t(tap.texel) * k_side + size_t(x)];
  return result;
}

}  // namespace

Expected<DetailTexture> detail_from_image(std::string_view name, int width, int height,
                                          std::span<const glm::u8vec4> texels) {
  const std::string what =
      std::string(name) + " is " + std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width != height) return fail(what + "; a detail texture must be square: crop or scale it");
  if (width < k_least_side || width > k_largest_side) {
    return fail(what + "; a detail texture must have 16 to 8192 texels a side: scale it");
  }
  SWARD_ASSERT(texels.size() == size_t(width) * size_t(height), "detail_from_image: width times height texels");
  detail::Canvas canvas(glm::vec3(1));
  canvas.color = resample(width, texels);
  const glm::vec3 mean = mean_of(canvas.color);
  const glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
  const float brightness = glm::dot(mean, luminance);
  if (brightness < 1.0e-4f) return fail(what + " and black: there is no mean to divide its colours by");
  for (size_t i = 0; i < canvas.color.size(); ++i) {
    const float own = glm::dot(canvas.color[i], luminance);
    canvas.height[i] = std::sqrt(own);
    // A channel that is nearly nowhere follows brightness.
    for (int c = 0; c < 3; ++c)
      if (mean[c] < 0.02f * brightness) canvas.color[i][c] = own;
  }
  return detail::finish(std::move(canvas));
}

}  // namespace sward
