// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What a Disturbance is made of: sparse tiles of cells in three levels, and when each tile ends.
//
//  a tile's cells, row by row       each coarser cell is the mean of 4 x 4 finer ones,
//  from the south-west              each coarser tile covers 4 x 4 finer ones
//   240 .. 255  north
//   ...
//   0 1 .. 15   south
//
// Values are bytes; press and water keep the time of their last touch instead of being run down, so that a cell changes
// only when it is touched. Times are ticks of 1/256 s since `epoch`, the first being 1.
#include <sward/vegetation/disturbance.h>
#include <array>
#include <glm/ext/vector_int2_sized.hpp>
#include <queue>
#include <unordered_map>
#include <vector>

namespace sward {

inline constexpr int k_tile_side = 16;
inline constexpr int k_tile_cells = k_tile_side * k_tile_side;
inline constexpr int k_tile_levels = 3;
inline constexpr int k_level_factor = 4;
inline constexpr double k_cell_m[k_tile_levels] = {0.125, 0.5, 2.0};
inline constexpr double k_ticks_a_second = 256;

inline double tile_m(int level) {
  return k_cell_m[level] * k_tile_side;
}

/// Tiles along a side of the window that a level shows around the eye; the eye is in the middle two.
inline constexpr int k_window_tiles = 16;
/// Metres from the eye, east and north, within which a level's window holds every place and its neighbouring cells.
inline double level_reach(int level) {
  return (k_window_tiles / 2 - 0.5) * tile_m(level) - k_cell_m[level];
}

/// A tile's name: `place` counts tiles east and north of the origin.
struct TileKey {
  int level = 0;
  glm::ivec2 place{0};

  uint64_t packed() const;
  static TileKey unpack(uint64_t packed);
  TileKey parent() const;
  bool operator==(const TileKey&) const = default;
};

struct PressPlane {
  std::array<std::array<int8_t, 2>, k_tile_cells> way{};  ///< 127: flat.
  std::array<uint32_t, k_tile_cells> time{};
};
struct WetPlane {
  std::array<uint8_t, k_tile_cells> wet{};
  std::array<uint32_t, k_tile_cells> time{};
};
struct LastingPlane {
  std::array<uint8_t, k_tile_cells> cut{}, burn{};
};
struct PaintPlane {
  std::array<std::array<uint8_t, 4>, k_tile_cells> paint{};  ///< sRGB times amount; amount.
};
/// From `start` to `end` lasting values fade; end 0: they stay.
struct RegrowPlane {
  std::array<uint32_t, k_tile_cells> start{}, end{};
};

/// Planes that hold nothing are null.
struct DisturbanceTile {
  std::unique_ptr<PressPlane> press;
  std::unique_ptr<WetPlane> wet;
  std::unique_ptr<LastingPlane> lasting;
  std::unique_ptr<PaintPlane> paint;
  std::unique_ptr<RegrowPlane> regrow;
  uint64_t revision = 0;
  uint64_t shown = 0;                ///< The same without the means of finer tiles, which are there to be looked at.
  uint32_t pressed = 0, wetted = 0;  ///< Last touch of any cell.
  uint32_t grown = 0;                ///< When the first of the cells that regrow has.
  uint32_t queued = 0;               ///< Its valid entry in the queue of ends; 0: none.

  bool empty() const { return !press && !wet && !lasting && !paint; }
  size_t bytes() const;
};

/// What cells hold at a moment: decayed, not yet settled (common_disturbed.glsl).
struct CellClock {
  uint32_t now = 0;
  double press_ticks = 1, wet_ticks = 1;  ///< Half-lives.
};
Disturbed read_cell(const DisturbanceTile& tile, int cell, const CellClock& clock);
/// Share of lasting values that regrowth has left.
float share_standing(const DisturbanceTile& tile, int cell, uint32_t now);

/// The stronger of what is there and what comes stays. True where something changed.
bool touch_press(DisturbanceTile& tile, int cell, glm::vec2 press, const CellClock& clock);
bool touch_wet(DisturbanceTile& tile, int cell, float wet, const CellClock& clock);
bool touch_lasting(DisturbanceTile& tile, int cell, float cut, float burn, const CellClock& clock);
bool touch_paint(DisturbanceTile& tile, int cell, glm::vec4 paint, const CellClock& clock);

/// Which planes a brush may make.
struct PlaneSet {
  bool press = false, wet = false, lasting = false, paint = false;
  size_t bytes() const;
};

struct DisturbanceTiles {
  DisturbanceOptions options;
  std::unordered_map<uint64_t, DisturbanceTile> map;
  double time = 0, epoch = 0;  ///< Seconds; ticks count from the epoch.
  uint64_t revision = 0;
  size_t bytes = 0;
  uint64_t decayed = 0, dropped = 0, refused = 0;

  CellClock clock() const;
  uint32_t now() const { return clock().now; }
  const DisturbanceTile* find(TileKey key) const;
  /// The finest tile that holds a tile's ground: itself, else the nearest coarser; null: none does.
  const DisturbanceTile* holder(TileKey key, TileKey& found) const;
  /// What a cell (counted over the whole level) holds, from the finest tile that does.
  Disturbed cell(int level, glm::i64vec2 place, const CellClock& clock) const;
  /// Between cells, linearly.
  Disturbed sample(int level, glm::dvec2 place, const CellClock& clock) const;

  /// The tile, made as its holder has it where it is missing.
  DisturbanceTile& ensure(TileKey key);
  /// To be called after a tile has changed; `by_means`: by those of finer tiles.
  void changed(TileKey key, DisturbanceTile& tile, size_t bytes_before, bool by_means = false);
  /// Makes the cells of the coarser tiles above the means of these tiles', which are of one level.
  void update_parents(std::vector<TileKey> children);
  /// Lets the oldest pressed and wet tiles go until `more` bytes fit below the limit; false where they never will.
  /// Those in `kept` stay.
  bool make_room(size_t more, const std::vector<TileKey>& kept);
  /// Lets go what has ended.
  void let_go();
  /// Puts a tile into the queue of ends where it is not, or ends sooner.
  void queue_end(uint64_t packed, DisturbanceTile& tile);
  void requeue_all();
  /// Moves the epoch on before ticks run out.
  void move_epoch();

 private:
  uint32_t end_of(const DisturbanceTile& tile) const;
  void tidy(DisturbanceTile& tile) const;
  void average_into(DisturbanceTile& parent, TileKey child_key, const DisturbanceTile& child);

  using End = std::pair<uint32_t, uint64_t>;
  std::priority_queue<End, std::vector<End>, std::greater<>> ends_;
};

}  // namespace sward
