// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A square's fine data and a world's coarse data from samples. Bounds are those that Bounds would compute over the
// whole world: a diamond of level 2 coarse_bits or deeper depends on samples at most one coarse cell beyond its own
// cell, so a square with that margin is enough for its fine bounds; its cells' bounds are then the leaves of the coarse
// pass.

#include <sward/terrain/world_data.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "world_bounds.h"
#include "world_layout.h"

namespace sward {

namespace {

using world::WorldLayout;

// Samples around a square, first and last included.
struct Window {
  glm::ivec2 first, last;
  std::vector<float> raw;
  std::vector<uint8_t> missing;
  std::vector<uint16_t> bounds;

  int width() const { return last.x - first.x + 1; }
  int height() const { return last.y - first.y + 1; }
  size_t index(glm::ivec2 sample) const {
    return size_t(sample.y - first.y) * size_t(width()) + size_t(sample.x - first.x);
  }
};

struct SquareStorage {
  std::vector<uint16_t> words;
  std::vector<float> floats;
  std::vector<uint16_t> bounds;
  std::vector<uint64_t> holes;
};

std::string name_of(glm::ivec2 square) {
  return "square (" + std::to_string(square.x) + ", " + std::to_string(square.y) + ")";
}

Expected<void> check_heights(const WorldDesc& desc, std::span<const float> heights) {
  for (const float height : heights) {
    if (!std::isfinite(height)) return fail("a height is not finite; fill it and mark it as a hole");
    if (!desc.floats && !(height >= 0.0f && height <= 65535.0f && height == std::floor(height))) {
      return fail("height " + std::to_string(height) + " is no 16-bit integer; store the world as floats");
    }
  }
  return {};
}

// Reads what of the window lies on the data and repeats the edge in the padding.
Expected<Window> read_window(const WorldLayout& layout, glm::ivec2 square, const ReadHeights& read) {
  Window window;
  window.first = glm::max(square * layout.cells - layout.coarse_step, glm::ivec2(0));
  window.last = glm::min((square + 1) * layout.cells + layout.coarse_step, layout.grid_last);
  const glm::ivec2 data_last = glm::min(window.last, layout.data_last);
  const SampleBox box{window.first, data_last - window.first + 1};
  const size_t read_count = size_t(box.size.x) * size_t(box.size.y);
  const size_t count = size_t(window.width()) * size_t(window.height());
  std::vector<float> heights(read_count, 0.0f);
  std::vector<uint8_t> holes(read_count, 0);
  if (auto done = read(box, heights, holes); !done) return tl::unexpected<Error>(done.error());
  if (auto checked = check_heights(layout.desc, heights); !checked) return tl::unexpected<Error>(checked.error());
  if (count == read_count) {
    window.raw = std::move(heights);
    window.missing = std::move(holes);
  } else {
    window.raw.resize(count);
    window.missing.assign(count, 1);
    for (int row = 0; row < window.height(); ++row) {
      const size_t from = size_t(std::min(row, box.size.y - 1)) * size_t(box.size.x);
      const size_t to = size_t(row) * size_t(window.width());
      for (int column = 0; column < window.width(); ++column) {
        window.raw[to + size_t(column)] = heights[from + size_t(std::min(column, box.size.x - 1))];
        if (row < box.size.y && column < box.size.x) window.missing[to + size_t(column)] = holes[from + size_t(column)];
      }
    }
  }
  window.bounds.assign(count, world::k_nothing);
  return window;
}

// The square's own samples with one ring; beyond the world the edge is repeated.
template <class Sample>
std::vector<Sample> cut_ring(const WorldLayout& layout, glm::ivec2 square, const Window& window) {
  std::vector<Sample> samples(layout.ring_samples());
  const glm::ivec2 corner = square * layout.cells - 1;
  size_t at = 0;
  for (int row = 0; row < layout.ring_side(); ++row)
    for (int column = 0; column < layout.ring_side(); ++column) {
      const glm::ivec2 sample = glm::clamp(corner + glm::ivec2(column, row), window.first, window.last);
      samples[at++] = Sample(window.raw[window.index(sample)]);
    }
  return samples;
}

std::vector<uint64_t> cut_holes(const WorldLayout& layout, glm::ivec2 square, const Window& window) {
  std::vector<uint64_t> holes;
  const glm::ivec2 corner = square * layout.cells;
  const glm::ivec2 last = glm::min(corner + layout.cells, layout.data_last);
  for (int row = corner.y; row <= last.y; ++row)
    for (int column = corner.x; column <= last.x; ++column) {
      if (window.missing[window.index({column, row})] == 0) continue;
      holes.resize(layout.hole_words(), 0);
      const size_t i = size_t(row - corner.y) * size_t(layout.side()) + size_t(column - corner.x);
      holes[i / 64] |= uint64_t(1) << (i % 64);
    }
  return holes;
}

std::vector<uint16_t> cut_bounds(const WorldLayout& layout, glm::ivec2 square, const Window& window) {
  std::vector<uint16_t> bounds(layout.square_samples());
  const glm::ivec2 corner = square * layout.cells;
  for (int row = 0; row < layout.side(); ++row) {
    const auto from = window.bounds.begin() + std::ptrdiff_t(window.index(corner + glm::ivec2(0, row)));
    std::copy(from, from + layout.side(), bounds.begin() + std::ptrdiff_t(row) * layout.side());
  }
  return bounds;
}

}  // namespace

Expected<SquareData> build_square(const WorldDesc& desc, glm::ivec2 square, const ReadHeights& read, int threads) {
  if (auto checked = desc.validate(); !checked) return tl::unexpected<Error>(checked.error());
  const WorldLayout layout(desc);
  SWARD_ASSERT(layout.has(square), "the square lies outside of the world");
  auto window = read_window(layout, square, read);
  if (!window) return fail(name_of(square) + ": " + window.error().message);
  world::build_bounds({window->first, window->last, window->raw, window->missing, desc.scale, window->bounds, {}},
                      layout.coarse_step / 2, 0, threads);

  auto storage = std::make_shared<SquareStorage>();
  if (desc.floats)
    storage->floats = cut_ring<float>(layout, square, *window);
  else
    storage->words = cut_ring<uint16_t>(layout, square, *window);
  storage->bounds = cut_bounds(layout, square, *window);
  storage->holes = cut_holes(layout, square, *window);
  return SquareData{storage->words, storage->floats, storage->bounds, storage->holes, storage};
}

Expected<WorldCoarse> build_coarse(const WorldDesc& desc, const ReadHeights& read, const Progress& progress) {
  if (auto checked = desc.validate(); !checked) return tl::unexpected<Error>(checked.error());
  const WorldLayout layout(desc);
  world::CoarseBuilder builder(layout);
  size_t done = 0;
  for (int row = 0; row < layout.squares.y; ++row)
    for (int column = 0; column < layout.squares.x; ++column) {
      auto square = build_square(desc, {column, row}, read, 0);
      if (!square) return tl::unexpected<Error>(square.error());
      builder.add({column, row}, *square);
      if (progress) progress(float(++done) / float(layout.square_count()));
    }
  return builder.finish(0);
}

namespace world {

CoarseBuilder::CoarseBuilder(const WorldLayout& layout) : layout_(layout), missing_(layout.coarse_samples(), 1) {
  coarse_.heights.assign(layout.coarse_samples(), 0.0f);
  coarse_.bounds.assign(layout.coarse_samples(), k_nothing);
  coarse_.cell_bounds.assign(layout.coarse_cells(), k_nothing);
}

void CoarseBuilder::add(glm::ivec2 square, const SquareData& data) {
  const int across = 1 << layout_.desc.coarse_bits, step = layout_.coarse_step;
  const glm::ivec2 corner = square * across;
  for (int row = 0; row <= across; ++row)
    for (int column = 0; column <= across; ++column) {
      const glm::ivec2 at(column, row), own = at * step;
      const size_t to = layout_.coarse_index(corner + at);
      const glm::ivec2 sample = square * layout_.cells + own;
      const bool padding = sample.x > layout_.data_last.x || sample.y > layout_.data_last.y;
      coarse_.heights[to] = float(raw_sample(layout_, data, own));
      missing_[to] = padding || is_hole(layout_, data, own);
      if (row == across || column == across) continue;
      const glm::ivec2 centre = own + step / 2;
      coarse_.cell_bounds[layout_.cell_index(corner + at)] =
          data.bounds[size_t(centre.y) * size_t(layout_.side()) + size_t(centre.x)];
    }
}

WorldCoarse CoarseBuilder::finish(int threads) {
  const int widest = 1 << (layout_.desc.coarse_bits - 1);
  build_bounds({glm::ivec2(0), layout_.coarse_last, coarse_.heights, missing_, layout_.desc.scale, coarse_.bounds,
                coarse_.cell_bounds},
               widest, widest, threads);
  return std::move(coarse_);
}

}  // namespace world

}  // namespace sward
