// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Mip levels of cutouts keep their coverage after I. Castano, "Computing alpha mipmaps" (2010).

#include "vegetation/plant_image_array.h"

#include <algorithm>
#include <cmath>

namespace sward {

namespace {

constexpr int k_levels = 9;
static_assert(1 << (k_levels - 1) == k_plant_image_side);

struct Level {
  int side;
  std::vector<float> values;
};

/// Bilinear where the image is smaller, the mean of what a texel covers where it is larger.
Level resized(const PlantImage& image) {
  Level level{k_plant_image_side, {}};
  const double dx = double(image.width()) / level.side, dy = double(image.height()) / level.side;
  const int nx = std::max(int(dx), 1), ny = std::max(int(dy), 1);
  const auto texel = [&](int x, int y) {
    return float(image.greys()[size_t(std::clamp(y, 0, image.height() - 1)) * size_t(image.width()) +
                               size_t(std::clamp(x, 0, image.width() - 1))]);
  };
  const auto sample = [&](double x, double y) {
    const double cx = x - 0.5, cy = y - 0.5;
    const int i = int(std::floor(cx)), j = int(std::floor(cy));
    const auto a = float(cx - i), b = float(cy - j);
    return std::lerp(std::lerp(texel(i, j), texel(i + 1, j), a), std::lerp(texel(i, j + 1), texel(i + 1, j + 1), a), b);
  };
  for (int row = 0; row < level.side; ++row) {
    for (int column = 0; column < level.side; ++column) {
      float sum = 0;
      for (int part = 0; part < nx * ny; ++part)
        sum += sample((column + (part % nx + 0.5) / nx) * dx, (row + (double(part / nx) + 0.5) / ny) * dy);
      level.values.push_back(sum / float(nx * ny));
    }
  }
  return level;
}

Level halved(const Level& from) {
  Level level{from.side / 2, {}};
  for (int row = 0; row < level.side; ++row) {
    for (int column = 0; column < level.side; ++column) {
      const float* at = &from.values[size_t(2 * row * from.side + 2 * column)];
      level.values.push_back(0.25f * (at[0] + at[1] + at[from.side] + at[from.side + 1]));
    }
  }
  return level;
}

/// Share of the texels above `limit`.
double coverage(const Level& level, float limit) {
  const auto above = std::count_if(level.values.begin(), level.values.end(), [=](float v) { return v > limit; });
  return double(above) / double(level.values.size());
}

/// The limit above which lies this share, as a factor that brings it to half grey.
float scale_to(const Level& level, double share) {
  if (share <= 0 || share >= 1) return 1;
  float low = 0, high = 255;
  for (int step = 0; step < 16; ++step) {
    const float middle = 0.5f * (low + high);
    (coverage(level, middle) > share ? low : high) = middle;
  }
  return 127.5f / std::max(0.5f * (low + high), 1.0f);
}

std::vector<uint8_t> bytes(const Level& level, float scale) {
  std::vector<uint8_t> result;
  result.reserve(level.values.size());
  for (const float value : level.values) result.push_back(uint8_t(std::clamp(value * scale, 0.0f, 255.0f) + 0.5f));
  return result;
}

}  // namespace

std::vector<std::vector<uint8_t>> plant_image_levels(const PlantImage& image, bool cutout) {
  Level level = resized(image);
  const double share = coverage(level, 127.5f);
  std::vector<std::vector<uint8_t>> levels{bytes(level, 1)};
  while (level.side > 1) {
    level = halved(level);
    // Below 8 texels a side the mean coverage says more than any shape.
    levels.push_back(bytes(level, cutout && level.side >= 8 ? scale_to(level, share) : 1));
  }
  return levels;
}

PlantImageArray PlantImageArray::create(const Layer& layer) {
  PlantImageArray array;
  const auto add = [&](const PlantImage* image, bool cutout) {
    if (image != nullptr && array.number(image, cutout) < 0) array.entries_.push_back({image, cutout});
  };
  for (const Species& species : layer.species) {
    add(species.detail.get(), false);
    add(species.cutout.get(), true);
  }
  const auto layers = GLsizei(std::max(array.entries_.size(), size_t(1)));
  const gl::DefaultUnpack unpack;
  array.texture_ = gl::create_texture(GL_TEXTURE_2D_ARRAY);
  const GLuint id = array.texture_.id();
  glTextureStorage3D(id, k_levels, GL_R8, k_plant_image_side, k_plant_image_side, layers);
  for (size_t i = 0; i < array.entries_.size(); ++i) {
    const auto levels = plant_image_levels(*array.entries_[i].image, array.entries_[i].cutout);
    for (int level = 0; level < k_levels; ++level) {
      const GLsizei side = k_plant_image_side >> level;
      glTextureSubImage3D(id, level, 0, 0, GLint(i), side, side, 1, GL_RED, GL_UNSIGNED_BYTE,
                          levels[size_t(level)].data());
    }
  }
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return array;
}

float PlantImageArray::number(const PlantImage* image, bool cutout) const {
  const auto found = std::find(entries_.begin(), entries_.end(), Entry{image, cutout});
  return found == entries_.end() ? -1.0f : float(found - entries_.begin());
}

glm::vec4 PlantImageArray::of(const Species& species) const {
  return {number(species.detail.get(), false), species.detail_strength, species.detail_repeat,
          number(species.cutout.get(), true)};
}

}  // namespace sward
