// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Regrowth: cells get a time from which and one until which what lasts fades.

#include <sward/vegetation/disturbance.h>

#include <algorithm>
#include <cmath>

#include "vegetation/disturbance_tiles.h"

namespace sward {

namespace {

struct Disc {
  glm::dvec2 centre{0};
  double radius = 0;
};

bool stands(const DisturbanceTile& tile, size_t cell) {
  return (tile.lasting && (tile.lasting->cut[cell] != 0 || tile.lasting->burn[cell] != 0)) ||
         (tile.paint && tile.paint->paint[cell][3] != 0);
}

/// What stands now is what fades from now on.
void settle_cell(DisturbanceTile& tile, size_t i, uint32_t now) {
  const float share = share_standing(tile, int(i), now);
  const auto keep = [share](uint8_t& value) { value = uint8_t(std::lround(float(value) * share)); };
  if (tile.lasting) keep(tile.lasting->cut[i]), keep(tile.lasting->burn[i]);
  if (tile.paint) std::ranges::for_each(tile.paint->paint[i], keep);
}

/// Starts the cells of a tile whose middle lies in the disc; true where there are any.
bool start_cells(TileKey key, DisturbanceTile& tile, const Disc* disc, uint32_t now, uint32_t end) {
  bool any = false;
  for (int cell = 0; cell < k_tile_cells; ++cell) {
    const auto i = size_t(cell);
    if (!stands(tile, i)) continue;
    const glm::dvec2 place = glm::dvec2(key.place) * tile_m(key.level) +
                             (glm::dvec2(cell % k_tile_side, cell / k_tile_side) + 0.5) * k_cell_m[key.level];
    if (disc != nullptr && glm::length(place - disc->centre) > disc->radius) continue;
    settle_cell(tile, i, now);
    if (!tile.regrow) tile.regrow = std::make_unique<RegrowPlane>();
    tile.regrow->start[i] = now;
    tile.regrow->end[i] = end;
    any = true;
  }
  if (any) tile.grown = tile.grown == 0 ? end : std::min(tile.grown, end);
  return any;
}

bool meets(TileKey key, const Disc& disc) {
  const glm::dvec2 low = glm::dvec2(key.place) * tile_m(key.level);
  return glm::length(glm::clamp(disc.centre, low, low + tile_m(key.level)) - disc.centre) <= disc.radius;
}

Expected<void> start(DisturbanceTiles& tiles, const Disc* disc, double seconds) {
  if (!(seconds >= 0 && seconds <= 1e6)) return fail("disturbance: regrowth takes 0 to 1e6 s; nothing was changed");
  const uint32_t now = tiles.now();
  const uint32_t end = now + uint32_t(std::lround(seconds * k_ticks_a_second));
  for (auto& [packed, tile] : tiles.map) {
    const TileKey key = TileKey::unpack(packed);
    if ((!tile.lasting && !tile.paint) || (disc != nullptr && !meets(key, *disc))) continue;
    const size_t before = tile.bytes();
    if (start_cells(key, tile, disc, now, end)) tiles.changed(key, tile, before);
  }
  tiles.let_go();
  return {};
}

}  // namespace

Expected<void> Disturbance::regrow(glm::dvec2 centre, double radius_m, double seconds) {
  if (!std::isfinite(centre.x) || !std::isfinite(centre.y) || !(radius_m > 0) || !std::isfinite(radius_m))
    return fail("disturbance: regrowth needs a finite place and a finite radius above 0; nothing was changed");
  const Disc disc{centre, radius_m};
  return start(*tiles_, &disc, seconds);
}

Expected<void> Disturbance::regrow_all(double seconds) {
  return start(*tiles_, nullptr, seconds);
}

}  // namespace sward
