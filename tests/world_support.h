// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/terrain.h>
#include <sward/terrain/world.h>
#include <sward/terrain/world_bake.h>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <thread>
#include <utility>
#include <vector>

/// Generated worlds for tests, with all their samples at hand.
namespace world_support {

struct Heights {
  sward::WorldDesc desc;
  std::vector<float> samples;  ///< Raw units, row by row.
  std::vector<uint8_t> holes;  ///< Empty or one a sample.

  float at(int column, int row) const { return samples[size_t(row) * size_t(desc.columns) + size_t(column)]; }

  sward::ReadHeights reader() const {
    return [this](const sward::SampleBox& box, std::span<float> heights,
                  std::span<uint8_t> marked) -> sward::Expected<void> {
      for (int row = 0; row < box.size.y; ++row)
        for (int column = 0; column < box.size.x; ++column) {
          const size_t to = size_t(row) * size_t(box.size.x) + size_t(column);
          const size_t from = size_t(box.first.y + row) * size_t(desc.columns) + size_t(box.first.x) + size_t(column);
          heights[to] = samples.at(from);
          if (!holes.empty()) marked[to] = holes[from];
        }
      return {};
    };
  }
};

/// Rough ground: sines of several lengths and a hash, whole numbers of 0..65535.
inline Heights make_heights(const sward::WorldDesc& desc, uint32_t seed = 1) {
  Heights heights{desc, {}, {}};
  heights.samples.resize(size_t(desc.columns) * size_t(desc.rows));
  for (int row = 0; row < desc.rows; ++row)
    for (int column = 0; column < desc.columns; ++column) {
      uint32_t h = uint32_t(column) * 0x9E3779B1u ^ uint32_t(row) * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
      h = (h ^ h >> 15) * 0x2C1B3C6Du;
      h ^= h >> 12;
      const double smooth =
          std::sin(column * 0.05 + seed) * std::cos(row * 0.04) + 0.3 * std::sin(column * 0.4 + row * 0.3);
      heights.samples[size_t(row) * size_t(desc.columns) + size_t(column)] =
          float(std::lround(30000 + 12000 * smooth + double(h % 400)));
    }
  return heights;
}

inline sward::WorldDesc make_desc(glm::ivec2 squares, int root_bits, int coarse_bits) {
  sward::WorldDesc desc;
  desc.columns = (squares.x << root_bits) + 1;
  desc.rows = (squares.y << root_bits) + 1;
  desc.spacing = {10, 10};
  desc.scale = 0.01;
  desc.root_bits = root_bits;
  desc.coarse_bits = coarse_bits;
  return desc;
}

inline sward::LoadSquare loader_of(const Heights& heights) {
  return [desc = heights.desc, read = heights.reader()](const sward::SquareRequest& request) {
    return sward::build_square(desc, request.square, read);
  };
}

inline std::unique_ptr<sward::World> make_world(const Heights& heights, sward::LoadSquare load,
                                                const sward::WorldOptions& options) {
  auto coarse = sward::build_coarse(heights.desc, heights.reader());
  return sward::World::create(heights.desc, std::move(*coarse), std::move(load), options).value();
}

/// Everything is wanted, and fits.
inline sward::WorldOptions roomy() {
  sward::WorldOptions options;
  options.worth_px = 0;
  options.adopt_per_poll = 1000;
  options.retry_s = 3600;
  return options;
}

inline sward::View view_over(const sward::World& world, glm::dvec2 xy = glm::dvec2(0), double above = 50) {
  const double z = world.height_range().y + above;
  return sward::View::look({xy, z}, 0.3, -0.4, 0.87, {1280, 720}, 1, 1e6);
}

/// Calls `step` until it is true; false when that takes more than a minute.
inline bool wait_until(const std::function<bool()>& step) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!step()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

/// Follows a view until everything that is wanted is resident or failing; the boxes that changed.
inline std::vector<sward::LatticeBox> settle(sward::World& world, const sward::View& view) {
  std::vector<sward::LatticeBox> boxes;
  world.follow({&view, 1});
  wait_until([&] {
    const auto changed = world.poll();
    boxes.insert(boxes.end(), changed.begin(), changed.end());
    return world.settled();
  });
  return boxes;
}

/// A bintree triangle by the definition, and the level's diamonds by centre with the centres of those that have to be
/// split before them.
struct Triangle {
  sward::LatticePoint apex, left, right;
  int level = 0;
  sward::LatticePoint middle() const { return (left + right) / 2; }
};

using Key = std::pair<int, std::pair<int, int>>;
inline Key key_of(int level, sward::LatticePoint p) {
  return {level, {p.x, p.y}};
}

inline std::map<Key, std::set<Key>> all_diamonds(const sward::Lattice& lattice) {
  std::map<Key, std::set<Key>> diamonds;
  const auto descend = [&](auto&& self, const Triangle& t) -> void {
    if (t.level == lattice.max_level) return;
    auto& parents = diamonds[key_of(t.level, t.middle())];
    if (t.level > 0) parents.insert(key_of(t.level - 1, t.apex));
    self(self, {t.middle(), t.apex, t.left, t.level + 1});
    self(self, {t.middle(), t.right, t.apex, t.level + 1});
  };
  for (int row = 0; row < lattice.root_squares.y; ++row)
    for (int column = 0; column < lattice.root_squares.x; ++column) {
      const sward::LatticePoint nw = sward::LatticePoint(column, row) * sward::k_root_side,
                                se = nw + sward::k_root_side;
      const sward::LatticePoint sw(nw.x, se.y), ne(se.x, nw.y);
      descend(descend, Triangle{nw, sw, ne, 0});
      descend(descend, Triangle{se, ne, sw, 0});
    }
  return diamonds;
}

}  // namespace world_support
