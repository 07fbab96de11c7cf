// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The recursion of bounds.cpp (Duchaineau et al. 1997, section 4; the geometry of the two kinds of diamonds and the
// rule for missing data stand there) over a part of a grid whose nodes keep their indices in the whole: what it gives
// for diamonds whose descendants lie within the part are the bits that the whole would give.

#include "world_bounds.h"

#include <sward/terrain/bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bounds_parallel.h"
#include "world_layout.h"

namespace sward::world {

namespace {

struct Below {
  double bound = 0;
  bool any = false;
};

// Rounding up to a float first changes nothing: every code stands for a float.
uint16_t encode_up(double metres) {
  const float rounded = float(metres);
  return Bounds::encode_up(double(rounded) < metres ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                                                    : rounded);
}

class Pass {
 public:
  explicit Pass(const BoundsGrid& grid) : g_(grid), width_(grid.last.x - grid.first.x + 1) {}

  // Diamonds with a base of 2 h along an axis, in a row that is a multiple of h.
  void side_row(int row, int h) const {
    const bool along_row = row / h % 2 == 0;
    const glm::ivec2 half = along_row ? glm::ivec2(h, 0) : glm::ivec2(0, h);
    const int q = h / 2;
    const std::array<glm::ivec2, 4> corners{{{-q, -q}, {q, -q}, {-q, q}, {q, q}}};
    for (int column = g_.first.x + (along_row ? h : 0); column <= g_.last.x; column += 2 * h) {
      const glm::ivec2 centre(column, row);
      store(centre, half, h == 1 ? largest_cell(centre) : largest(centre, corners));
    }
  }

  // Diamonds with a base along a diagonal of a square of side 2 h, in a row that is an odd multiple of h.
  void square_row(int row, int h, bool root) const {
    const std::array<glm::ivec2, 4> sides{{{-h, 0}, {h, 0}, {0, -h}, {0, h}}};
    for (int column = g_.first.x + h; column <= g_.last.x; column += 2 * h) {
      const glm::ivec2 centre(column, row);
      const bool falls_east = (row / (2 * h) + column / (2 * h)) % 2 == 0;
      store(centre, falls_east && !root ? glm::ivec2(h, h) : glm::ivec2(h, -h), largest(centre, sides));
    }
  }

 private:
  size_t index(glm::ivec2 node) const {
    return size_t(node.y - g_.first.y) * size_t(width_) + size_t(node.x - g_.first.x);
  }

  static Below as_below(uint16_t highest) {
    if (highest == 0) return {};
    return {double(Bounds::decode(uint16_t(highest - 1))), true};
  }

  // Codes rise with what they stand for; one above, k_nothing wraps to 0, below all others.
  Below largest(glm::ivec2 centre, const std::array<glm::ivec2, 4>& offsets) const {
    uint16_t highest = 0;
    for (const glm::ivec2 offset : offsets) {
      const glm::ivec2 node = centre + offset;
      if (node.x < g_.first.x || node.y < g_.first.y || node.x > g_.last.x || node.y > g_.last.y) continue;
      highest = std::max(highest, uint16_t(g_.stored[index(node)] + 1));
    }
    return as_below(highest);
  }

  Below largest_cell(glm::ivec2 centre) const {
    if (g_.cells.empty()) return {};
    uint16_t highest = 0;
    for (int y = std::max(centre.y - 1, g_.first.y); y <= std::min(centre.y, g_.last.y - 1); ++y)
      for (int x = std::max(centre.x - 1, g_.first.x); x <= std::min(centre.x, g_.last.x - 1); ++x) {
        const size_t at = size_t(y - g_.first.y) * size_t(width_ - 1) + size_t(x - g_.first.x);
        highest = std::max(highest, uint16_t(g_.cells[at] + 1));
      }
    return as_below(highest);
  }

  void store(glm::ivec2 centre, glm::ivec2 half, const Below& below) const {
    const size_t at = index(centre);
    if (!below.any && g_.missing[at] != 0) {
      g_.stored[at] = k_nothing;
      return;
    }
    const double bend = std::abs(raw(centre) - 0.5 * (raw(centre - half) + raw(centre + half)));
    g_.stored[at] = encode_up(below.bound + std::abs(g_.scale) * bend);
  }

  double raw(glm::ivec2 node) const { return double(g_.raw[index(node)]); }

  const BoundsGrid& g_;
  int width_;
};

}  // namespace

void build_bounds(const BoundsGrid& grid, int widest, int root_spacing, int threads) {
  const Pass pass(grid);
  const glm::ivec2 size = grid.last - grid.first;
  for (int h = 1; h <= widest; h *= 2) {
    parallel_rows({size.y / h + 1, size.x / (2 * h) + 1, threads}, {},
                  [&](int k) { pass.side_row(grid.first.y + k * h, h); });
    parallel_rows({size.y / (2 * h), size.x / (2 * h), threads}, {},
                  [&](int k) { pass.square_row(grid.first.y + (2 * k + 1) * h, h, h == root_spacing); });
  }
}

}  // namespace sward::world
