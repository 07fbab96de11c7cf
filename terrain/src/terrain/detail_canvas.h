// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/detail_texture.h>
#include <cstdint>
#include <vector>

namespace sward::detail {

/// Numbers for painting: a fixed sequence from a seed.
class PaintRandom {
 public:
  explicit PaintRandom(uint32_t seed) : state_(seed * 0x9E3779B9u + 0x7F4A7C15u) {}
  uint32_t bits();
  float unit() { return float(bits() >> 8) * 0x1p-24f; }
  float within(float low, float high) { return low + (high - low) * unit(); }

 private:
  uint32_t state_;
};

/// A tile being painted: linear colour, not yet divided by its mean, and height. Places are in texels; all wraps round.
struct Canvas {
  static constexpr int k_side = DetailTexture::k_side;
  static constexpr size_t k_texels = size_t(k_side) * size_t(k_side);
  std::vector<glm::vec3> color;
  std::vector<float> height;

  explicit Canvas(glm::vec3 ground) : color(k_texels, ground), height(k_texels, 0.0f) {}
  static size_t index(int x, int y) { return size_t(y & (k_side - 1)) * size_t(k_side) + size_t(x & (k_side - 1)); }
};

/// Smooth noise that repeats after the tile, -1..1, of `cells` cells a side.
std::vector<float> noise(glm::ivec2 cells, uint32_t seed);
/// Octaves from `cells` on, each twice as fine and half as high, together about -1..1.
std::vector<float> octaves(int cells, int count, uint32_t seed);
/// Octaves and a little of every texel's own.
void roughen(Canvas& canvas, int cells, int count, float height, float contrast, uint32_t seed);

/// A stone, clod or grain: a dome over a dented ellipse, drawn where it is higher than what lies there.
struct Stone {
  glm::vec2 centre{0}, radius{1};
  float angle = 0, base = 0, rise = 1;
  float dents = 0.1f;  ///< Depth of what its outline lacks to an ellipse, 0..0.4.
  float flat = 0.5f;   ///< 0: a dome, 1: a slab.
  glm::vec3 color{1};
  uint32_t number = 0;  ///< Its own shape.
};
void draw_stone(Canvas& canvas, const Stone& stone);

/// A blade, stalk or twig: a bent line of a width that thins towards its end.
struct Strand {
  glm::vec2 root{0};
  float angle = 0, bend = 0, length = 40, width = 2, base = 0, rise = 0.3f;
  glm::vec3 color{1};
};
void draw_strand(Canvas& canvas, const Strand& strand);

/// A dead leaf: pointed, with a rib, one side higher than the other.
struct FlatLeaf {
  glm::vec2 centre{0};
  float angle = 0, length = 30, width = 14, base = 0, tilt = 0.2f;
  glm::vec3 color{1};
};
void draw_leaf(Canvas& canvas, const FlatLeaf& leaf);

/// Darkens what lies deep: colour times mix(depth, 1, height), heights first brought to 0..1.
void shade_hollows(Canvas& canvas, float depth);

/// Rounds steps of the height off, over so many texels.
void wear(Canvas& canvas, int texels);

/// Takes hues towards the mean's: 1 leaves them, 0 leaves brightness alone.
void calm(Canvas& canvas, float chroma);

/// Divides by the mean, brings heights to 0..1, and makes all levels.
DetailTexture finish(Canvas canvas);

}  // namespace sward::detail
