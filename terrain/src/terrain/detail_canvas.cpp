// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "terrain/detail_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::detail {

namespace {

constexpr int k_side = Canvas::k_side;

float smooth(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

/// Places on a noise's lattice along one axis.
struct LatticePlace {
  int from, to;
  float share;
};
std::vector<LatticePlace> lattice_places(int cells) {
  std::vector<LatticePlace> places;
  for (int i = 0; i < k_side; ++i) {
    const float at = float(i) * float(cells) / float(k_side);
    const int cell = int(at);
    places.push_back({cell, (cell + 1) % cells, smooth(at - float(cell))});
  }
  return places;
}

/// Calls draw(index, x, y) for the texels of a square around a place; x, y: from it.
template <class Draw>
void around(glm::vec2 centre, float reach, Draw&& draw) {
  const glm::ivec2 low(glm::floor(centre - reach)), high(glm::ceil(centre + reach));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) draw(Canvas::index(x, y), float(x) - centre.x, float(y) - centre.y);
}

}  // namespace

uint32_t PaintRandom::bits() {
  state_ = state_ * 747796405u + 2891336453u;
  const uint32_t word = ((state_ >> ((state_ >> 28) + 4)) ^ state_) * 277803737u;
  return word >> 22 ^ word;
}

std::vector<float> noise(glm::ivec2 cells, uint32_t seed) {
  PaintRandom random(seed);
  std::vector<float> lattice(size_t(cells.x) * size_t(cells.y));
  for (float& value : lattice) value = random.within(-1, 1);
  const std::vector<LatticePlace> columns = lattice_places(cells.x), rows = lattice_places(cells.y);
  std::vector<float> row(size_t(cells.x)), result(Canvas::k_texels);
  for (int y = 0; y < k_side; ++y) {
    const LatticePlace& down = rows[size_t(y)];
    for (size_t i = 0; i < row.size(); ++i) {
      const float a = lattice[size_t(down.from) * row.size() + i], b = lattice[size_t(down.to) * row.size() + i];
      row[i] = a + (b - a) * down.share;
    }
    float* out = &result[size_t(y) * k_side];
    for (int x = 0; x < k_side; ++x) {
      const LatticePlace& along = columns[size_t(x)];
      const float a = row[size_t(along.from)], b = row[size_t(along.to)];
      out[x] = a + (b - a) * along.share;
    }
  }
  return result;
}

std::vector<float> octaves(int cells, int count, uint32_t seed) {
  std::vector<float> sum(Canvas::k_texels, 0.0f);
  float share = 0.6f;
  for (int i = 0; i < count; ++i, cells *= 2, share *= 0.5f) {
    const std::vector<float> octave = noise(glm::ivec2(cells), seed + uint32_t(i));
    for (size_t t = 0; t < sum.size(); ++t) sum[t] += share * octave[t];
  }
  return sum;
}

void roughen(Canvas& canvas, int cells, int count, float height, float contrast, uint32_t seed) {
  const std::vector<float> shape = octaves(cells, count, seed);
  PaintRandom random(seed ^ 0xA5u);
  for (size_t i = 0; i < Canvas::k_texels; ++i) {
    const float value = shape[i] + 0.15f * random.within(-1, 1);
    canvas.height[i] += height * value;
    canvas.color[i] *= std::max(1 + contrast * value, 0.05f);
  }
}

void draw_stone(Canvas& canvas, const Stone& stone) {
  PaintRandom own(stone.number);
  std::array<glm::vec3, 4> cuts;  // facets: direction and distance of what is cut off, in radii
  for (glm::vec3& cut : cuts) {
    const float turn = own.within(0, 6.2831853f);
    cut = {std::cos(turn), std::sin(turn), own.within(1 - 1.6f * stone.dents, 1.05f - 0.6f * stone.dents)};
  }
  const glm::vec2 slant(own.within(-0.35f, 0.35f), own.within(-0.35f, 0.35f));
  const float c = std::cos(stone.angle), s = std::sin(stone.angle);
  around(stone.centre, std::max(stone.radius.x, stone.radius.y) + 1, [&](size_t i, float x, float y) {
    const glm::vec2 p = glm::vec2(c * x + s * y, c * y - s * x) / stone.radius;
    float away = glm::dot(p, p);
    if (away >= 1) return;
    for (const glm::vec3& cut : cuts) away = std::max(away, 1 + 6 * (p.x * cut.x + p.y * cut.y - cut.z));
    if (away >= 1) return;
    const float dome = std::sqrt(1 - away);
    const float top =
        stone.rise * (std::min(dome, 1 - stone.flat) / (1 - 0.999f * stone.flat) + 0.4f * glm::dot(slant, p) * dome);
    if (stone.base + top <= canvas.height[i]) return;
    canvas.height[i] = stone.base + top;
    canvas.color[i] = stone.color * (0.82f + 0.18f * dome);
  });
}

void draw_strand(Canvas& canvas, const Strand& strand) {
  glm::vec2 at = strand.root;
  float angle = strand.angle;
  const int steps = std::max(int(strand.length), 2);
  for (int step = 0; step < steps; ++step) {
    const float along = float(step) / float(steps);
    const float half = 0.5f * strand.width * (1 - 0.75f * along * along);
    const float lift = strand.base + strand.rise * 4 * along * (1 - 0.6f * along) * 0.6f;
    around(at, half + 0.5f, [&](size_t i, float x, float y) {
      const float across = std::sqrt(x * x + y * y) / (half + 0.5f);
      if (across >= 1) return;
      const float top = lift + 0.12f * (1 - across * across);
      if (top <= canvas.height[i]) return;
      canvas.height[i] = top;
      canvas.color[i] = strand.color * (0.8f + 0.3f * along);
    });
    at += glm::vec2(std::cos(angle), std::sin(angle));
    angle += strand.bend / float(steps);
  }
}

void draw_leaf(Canvas& canvas, const FlatLeaf& leaf) {
  const float c = std::cos(leaf.angle), s = std::sin(leaf.angle);
  around(leaf.centre, 0.5f * leaf.length + 1, [&](size_t i, float x, float y) {
    const float u = 2 * (c * x + s * y) / leaf.length, v = 2 * (c * y - s * x) / leaf.width;
    if (std::abs(u) >= 1) return;
    const float edge = (1 - u * u) * (1 - 0.25f * u);
    const float across = std::abs(v) / std::max(edge, 1.0e-3f);
    if (across >= 1) return;
    const float top = leaf.base + leaf.tilt * (0.5f + 0.5f * v) + 0.1f * across * across;
    if (top <= canvas.height[i]) return;
    canvas.height[i] = top;
    const float rib = across < 0.1f ? 0.78f : 1.0f;
    canvas.color[i] = leaf.color * rib * (0.86f + 0.14f * across);
  });
}

void wear(Canvas& canvas, int texels) {
  const float share = 1.0f / float(2 * texels + 1);
  std::vector<float> along(Canvas::k_texels);
  // A box along x, then along y: running sums.
  for (const bool down : {false, true}) {
    const auto at = [down](int i, int k) { return down ? Canvas::index(i, k) : Canvas::index(k, i); };
    for (int i = 0; i < k_side; ++i) {
      float sum = 0;
      for (int k = -texels; k <= texels; ++k) sum += canvas.height[at(i, k)];
      for (int k = 0; k < k_side; ++k) {
        along[at(i, k)] = sum * share;
        sum += canvas.height[at(i, k + texels + 1)] - canvas.height[at(i, k - texels)];
      }
    }
    canvas.height.swap(along);
  }
}

}  // namespace sward::detail
