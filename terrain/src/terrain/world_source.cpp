// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What keeps a host's answers from doing harm.

#include <sward/terrain/bounds.h>

#include <array>
#include <cmath>
#include <exception>
#include <mutex>
#include <string>
#include <unordered_map>

#include "checksum.h"
#include "world_loader.h"

namespace sward::world {

namespace {

enum Side { k_north, k_south, k_west, k_east };
using Borders = std::array<uint64_t, 4>;

Borders borders_of(const WorldLayout& layout, const SquareData& data) {
  Borders sums{};
  std::vector<double> line(size_t(layout.side()));
  const auto sum = [&](glm::ivec2 first, glm::ivec2 step) {
    for (int i = 0; i < layout.side(); ++i) line[size_t(i)] = raw_sample(layout, data, first + i * step);
    return checksum(line.data(), line.size() * sizeof(double));
  };
  sums[k_north] = sum({0, 0}, {1, 0});
  sums[k_south] = sum({0, layout.cells}, {1, 0});
  sums[k_west] = sum({0, 0}, {0, 1});
  sums[k_east] = sum({layout.cells, 0}, {0, 1});
  return sums;
}

// Remembers the borders of all squares that were accepted, so that none is accepted later that differs.
class BorderRegister {
 public:
  explicit BorderRegister(const WorldLayout& layout) : layout_(layout) {}

  Expected<void> enter(glm::ivec2 square, const SquareData& data) {
    const Borders borders = borders_of(layout_, data);
    constexpr std::array<glm::ivec2, 4> k_across{{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
    constexpr std::array<Side, 4> k_opposite{k_south, k_north, k_east, k_west};
    const std::lock_guard lock(mutex_);
    for (size_t side = 0; side < 4; ++side) {
      const glm::ivec2 other = square + k_across[side];
      if (!layout_.has(other)) continue;
      const auto known = known_.find(layout_.square_index(other));
      if (known != known_.end() && known->second[k_opposite[side]] != borders[side]) {
        return fail("differs from square (" + std::to_string(other.x) + ", " + std::to_string(other.y) +
                    ") on their shared border");
      }
    }
    known_[layout_.square_index(square)] = borders;
    return {};
  }

 private:
  WorldLayout layout_;
  std::mutex mutex_;
  std::unordered_map<size_t, Borders> known_;
};

Expected<void> check_sizes(const WorldLayout& layout, const SquareData& data) {
  const size_t words = layout.desc.floats ? 0 : layout.ring_samples();
  const size_t floats = layout.desc.floats ? layout.ring_samples() : 0;
  if (data.words.size() != words || data.floats.size() != floats) {
    return fail("has " + std::to_string(data.words.size()) + " integer and " + std::to_string(data.floats.size()) +
                " float samples; expected " + std::to_string(words) + " and " + std::to_string(floats));
  }
  if (data.bounds.size() != layout.square_samples()) {
    return fail("has " + std::to_string(data.bounds.size()) + " bounds; expected " +
                std::to_string(layout.square_samples()));
  }
  if (!data.holes.empty() && data.holes.size() != layout.hole_words()) {
    return fail("has a hole mask of " + std::to_string(data.holes.size()) + " words; expected " +
                std::to_string(layout.hole_words()));
  }
  for (const float height : data.floats) {
    if (!std::isfinite(height)) return fail("has a height that is not finite");
  }
  return {};
}

// Coarse samples must be those of the world, and no bound may exceed that of its coarse cell.
Expected<void> check_against_coarse(const WorldLayout& layout, const WorldCoarse& coarse, glm::ivec2 square,
                                    const SquareData& data) {
  const int across = 1 << layout.desc.coarse_bits, step = layout.coarse_step;
  const glm::ivec2 corner = square * across;
  for (int row = 0; row <= across; ++row)
    for (int column = 0; column <= across; ++column) {
      const glm::ivec2 at(column, row);
      if (raw_sample(layout, data, at * step) != double(coarse.heights[layout.coarse_index(corner + at)])) {
        return fail("has other heights than the world's coarse data: both must come from the same samples");
      }
      if (row == across || column == across) continue;
      const uint16_t cell = coarse.cell_bounds[layout.cell_index(corner + at)];
      const glm::ivec2 centre = at * step + step / 2;
      // One above, k_nothing wraps to 0.
      const auto rank = [](uint16_t code) { return uint16_t(code + 1); };
      const size_t i = size_t(centre.y) * size_t(layout.side()) + size_t(centre.x);
      if (rank(data.bounds[i]) > rank(cell)) return fail("has larger bounds than the world's coarse data");
    }
  return {};
}

}  // namespace

LoadSquare checked_source(const WorldLayout& layout, std::shared_ptr<const WorldCoarse> coarse, LoadSquare load) {
  const auto borders = std::make_shared<BorderRegister>(layout);
  return [layout, coarse, load, borders](const SquareRequest& request) -> Expected<SquareData> {
    auto data = load(request);
    if (!data) return data;
    if (auto checked = check_sizes(layout, *data); !checked) return tl::unexpected<Error>(checked.error());
    if (auto checked = check_against_coarse(layout, *coarse, request.square, *data); !checked)
      return tl::unexpected<Error>(checked.error());
    if (auto checked = borders->enter(request.square, *data); !checked) return tl::unexpected<Error>(checked.error());
    return data;
  };
}

LoadSquare guarded_source(LoadSquare load) {
  return [load](const SquareRequest& request) -> Expected<SquareData> {
    try {
      return load(request);
    } catch (const std::bad_alloc&) {
      return fail("could not be loaded: out of memory");
    } catch (const std::exception& error) {
      return fail(std::string("could not be loaded: ") + error.what());
    } catch (...) {
      return fail("could not be loaded: the callback threw something that is no exception");
    }
  };
}

}  // namespace sward::world
