// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The sparse tiles of a Disturbance: lookup through the levels, means, ends, the memory's limit.

#include "vegetation/disturbance_tiles.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sward {

namespace {

constexpr int32_t k_place_bias = 1 << 30;
constexpr uint64_t k_place_mask = (uint64_t(1) << 31) - 1;
/// A node of the map beside the tile itself, and its entry in the queue.
constexpr size_t k_node_bytes = 48;
/// Ticks at which the epoch moves on: 180 days.
constexpr double k_most_ticks = 4.0e9;

template <class T>
T floor_div(T a, T b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

template <class T>
glm::vec<2, T> floor_div(glm::vec<2, T> a, int b) {
  return {floor_div(a.x, T(b)), floor_div(a.y, T(b))};
}

template <class Plane>
size_t bytes_of(const std::unique_ptr<Plane>& plane) {
  return plane ? sizeof(Plane) : 0;
}

/// Half-lives until all of a value is below what is seen.
double ticks_to_end(double half_life_ticks) {
  return half_life_ticks * std::log2(1.0 / Disturbance::k_visible);
}

uint32_t later(uint32_t tick, double ticks) {
  return uint32_t(std::min(double(tick) + std::ceil(ticks), 4294967295.0));
}

/// Copies a cell as it is, clocks and all.
void copy_cell(const DisturbanceTile& from, size_t f, DisturbanceTile& to, size_t t) {
  if (to.press) to.press->way[t] = from.press->way[f], to.press->time[t] = from.press->time[f];
  if (to.wet) to.wet->wet[t] = from.wet->wet[f], to.wet->time[t] = from.wet->time[f];
  if (to.lasting) to.lasting->cut[t] = from.lasting->cut[f], to.lasting->burn[t] = from.lasting->burn[f];
  if (to.paint) to.paint->paint[t] = from.paint->paint[f];
  if (to.regrow) to.regrow->start[t] = from.regrow->start[f], to.regrow->end[t] = from.regrow->end[f];
}

/// A tile as a coarser one has its ground.
DisturbanceTile finer_tile(const DisturbanceTile& from, TileKey from_key, TileKey key) {
  DisturbanceTile to;
  if (from.press) to.press = std::make_unique<PressPlane>();
  if (from.wet) to.wet = std::make_unique<WetPlane>();
  if (from.lasting) to.lasting = std::make_unique<LastingPlane>();
  if (from.paint) to.paint = std::make_unique<PaintPlane>();
  if (from.regrow) to.regrow = std::make_unique<RegrowPlane>();
  int factor = 1;
  for (int level = key.level; level < from_key.level; ++level) factor *= k_level_factor;
  for (int i = 0; i < k_tile_cells; ++i) {
    // Cells counted over the world would not fit into 32 bits.
    const glm::ivec2 first = (key.place - from_key.place * factor) * k_tile_side;
    const glm::ivec2 at = (first + glm::ivec2(i % k_tile_side, i / k_tile_side)) / factor;
    copy_cell(from, size_t(at.y * k_tile_side + at.x), to, size_t(i));
  }
  to.pressed = from.pressed;
  to.wetted = from.wetted;
  to.grown = from.grown;
  return to;
}

}  // namespace

uint64_t TileKey::packed() const {
  return uint64_t(level) << 62 | uint64_t(uint32_t(place.x + k_place_bias)) << 31 |
         uint64_t(uint32_t(place.y + k_place_bias));
}

TileKey TileKey::unpack(uint64_t packed) {
  return {int(packed >> 62),
          {int32_t((packed >> 31) & k_place_mask) - k_place_bias, int32_t(packed & k_place_mask) - k_place_bias}};
}

TileKey TileKey::parent() const {
  return {level + 1, floor_div(place, k_level_factor)};
}

size_t DisturbanceTile::bytes() const {
  return sizeof(DisturbanceTile) + k_node_bytes + bytes_of(press) + bytes_of(wet) + bytes_of(lasting) +
         bytes_of(paint) + bytes_of(regrow);
}

size_t PlaneSet::bytes() const {
  return sizeof(DisturbanceTile) + k_node_bytes + (press ? sizeof(PressPlane) : 0) + (wet ? sizeof(WetPlane) : 0) +
         (lasting ? sizeof(LastingPlane) : 0) + (paint ? sizeof(PaintPlane) : 0);
}

CellClock DisturbanceTiles::clock() const {
  return {1 + uint32_t((time - epoch) * k_ticks_a_second), double(options.press_half_life_s) * k_ticks_a_second,
          double(options.wet_half_life_s) * k_ticks_a_second};
}

const DisturbanceTile* DisturbanceTiles::find(TileKey key) const {
  const auto found = map.find(key.packed());
  return found == map.end() ? nullptr : &found->second;
}

const DisturbanceTile* DisturbanceTiles::holder(TileKey key, TileKey& found) const {
  for (found = key;; found = found.parent()) {
    if (const DisturbanceTile* tile = find(found)) return tile;
    if (found.level + 1 == k_tile_levels) return nullptr;
  }
}

Disturbed DisturbanceTiles::cell(int level, glm::i64vec2 place, const CellClock& clock) const {
  for (; level < k_tile_levels; ++level, place = floor_div(place, k_level_factor)) {
    const TileKey key{level, glm::ivec2(floor_div(place, k_tile_side))};
    const DisturbanceTile* tile = find(key);
    if (tile == nullptr) continue;
    const glm::ivec2 at(place - glm::i64vec2(key.place) * int64_t(k_tile_side));
    return read_cell(*tile, at.y * k_tile_side + at.x, clock);
  }
  return {};
}

Disturbed DisturbanceTiles::sample(int level, glm::dvec2 place, const CellClock& clock) const {
  const glm::dvec2 cells = place / k_cell_m[level] - 0.5, whole = glm::floor(cells);
  const glm::vec2 t(cells - whole);
  const glm::i64vec2 corner(whole);
  Disturbed sum;
  for (int i = 0; i < 4; ++i) {
    const glm::i64vec2 step(i & 1, i >> 1);
    const Disturbed d = cell(level, corner + step, clock);
    const float w = (step.x != 0 ? t.x : 1 - t.x) * (step.y != 0 ? t.y : 1 - t.y);
    sum.press += w * d.press;
    sum.cut += w * d.cut;
    sum.burn += w * d.burn;
    sum.wet += w * d.wet;
    sum.paint += w * d.paint;
  }
  return sum;
}

DisturbanceTile& DisturbanceTiles::ensure(TileKey key) {
  const auto [at, is_new] = map.try_emplace(key.packed());
  if (!is_new) return at->second;
  TileKey found;
  if (key.level + 1 < k_tile_levels)
    if (const DisturbanceTile* from = holder(key.parent(), found)) at->second = finer_tile(*from, found, key);
  bytes += at->second.bytes();
  return at->second;
}

void DisturbanceTiles::changed(TileKey key, DisturbanceTile& tile, size_t bytes_before, bool by_means) {
  bytes += tile.bytes() - bytes_before;
  tile.revision = ++revision;
  if (!by_means) tile.shown = revision;
  queue_end(key.packed(), tile);
}

void DisturbanceTiles::average_into(DisturbanceTile& parent, TileKey child_key, const DisturbanceTile& child) {
  const CellClock clock = this->clock();
  constexpr int k_cells = k_tile_side / k_level_factor;
  const glm::ivec2 first = child_key.place * k_cells - child_key.parent().place * k_tile_side;
  for (int y = 0; y < k_cells; ++y) {
    for (int x = 0; x < k_cells; ++x) {
      Disturbed sum;
      uint32_t grown = 0;
      for (int i = 0; i < k_level_factor * k_level_factor; ++i) {
        const int cell =
            (y * k_level_factor + i / k_level_factor) * k_tile_side + x * k_level_factor + i % k_level_factor;
        const Disturbed d = read_cell(child, cell, clock);
        sum.press += d.press, sum.cut += d.cut, sum.burn += d.burn, sum.wet += d.wet, sum.paint += d.paint;
        if (child.regrow) grown = std::max(grown, child.regrow->end[size_t(cell)]);
      }
      constexpr float k_share = 1.0f / float(k_level_factor * k_level_factor);
      const int at = (first.y + y) * k_tile_side + first.x + x;
      // What is there is replaced: it stood for the same ground.
      const auto i = size_t(at);
      if (parent.press) parent.press->way[i] = {0, 0};
      if (parent.wet) parent.wet->wet[i] = 0;
      if (parent.lasting) parent.lasting->cut[i] = parent.lasting->burn[i] = 0;
      if (parent.paint) parent.paint->paint[i] = {};
      if (parent.regrow) parent.regrow->start[i] = parent.regrow->end[i] = 0;
      touch_press(parent, at, sum.press * k_share, clock);
      touch_wet(parent, at, sum.wet * k_share, clock);
      touch_lasting(parent, at, sum.cut * k_share, sum.burn * k_share, clock);
      touch_paint(parent, at,
                  sum.paint.a > 0 ? glm::vec4(glm::vec3(sum.paint) / sum.paint.a, sum.paint.a * k_share) : glm::vec4(0),
                  clock);
      if (grown <= clock.now) continue;
      if (!parent.regrow) parent.regrow = std::make_unique<RegrowPlane>();
      parent.regrow->start[i] = clock.now;
      parent.regrow->end[i] = grown;
      parent.grown = parent.grown == 0 ? grown : std::min(parent.grown, grown);
    }
  }
}

void DisturbanceTiles::update_parents(std::vector<TileKey> children) {
  while (!children.empty() && children.front().level + 1 < k_tile_levels) {
    std::vector<TileKey> parents;
    for (const TileKey& key : children) {
      const TileKey above = key.parent();
      DisturbanceTile& parent = ensure(above);
      const size_t before = parent.bytes();
      // Nodes of the map stay where they are.
      average_into(parent, key, *find(key));
      changed(above, parent, before, true);
      parents.push_back(above);
    }
    std::ranges::sort(parents, {}, &TileKey::packed);
    parents.erase(std::ranges::unique(parents).begin(), parents.end());
    children = std::move(parents);
  }
}

uint32_t DisturbanceTiles::end_of(const DisturbanceTile& tile) const {
  const CellClock clock = this->clock();
  uint32_t end = 0;
  const auto sooner = [&end](uint32_t tick) { end = end == 0 ? tick : std::min(end, tick); };
  if (tile.press) sooner(later(tile.pressed, ticks_to_end(clock.press_ticks)));
  if (tile.wet) sooner(later(tile.wetted, ticks_to_end(clock.wet_ticks)));
  if (tile.regrow && tile.grown != 0) sooner(tile.grown);
  // A tile of nothing ends at once.
  return tile.empty() ? clock.now : end;
}

void DisturbanceTiles::queue_end(uint64_t packed, DisturbanceTile& tile) {
  const uint32_t end = end_of(tile);
  if (end == 0 || (tile.queued != 0 && tile.queued <= end)) return;
  tile.queued = end;
  ends_.emplace(end, packed);
}

void DisturbanceTiles::requeue_all() {
  ends_ = {};
  for (auto& [packed, tile] : map) {
    tile.queued = 0;
    queue_end(packed, tile);
  }
}

void DisturbanceTiles::tidy(DisturbanceTile& tile) const {
  const CellClock clock = this->clock();
  if (tile.press && later(tile.pressed, ticks_to_end(clock.press_ticks)) <= clock.now) tile.press.reset();
  if (tile.wet && later(tile.wetted, ticks_to_end(clock.wet_ticks)) <= clock.now) tile.wet.reset();
  if (!tile.regrow || tile.grown > clock.now) return;
  uint32_t next = 0;
  bool standing = false;
  for (size_t i = 0; i < size_t(k_tile_cells); ++i) {
    const uint32_t end = tile.regrow->end[i];
    if (end != 0 && end <= clock.now) {
      if (tile.lasting) tile.lasting->cut[i] = tile.lasting->burn[i] = 0;
      if (tile.paint) tile.paint->paint[i] = {};
      tile.regrow->start[i] = tile.regrow->end[i] = 0;
    } else if (end != 0) {
      next = next == 0 ? end : std::min(next, end);
    }
    if (tile.lasting) standing = standing || tile.lasting->cut[i] != 0 || tile.lasting->burn[i] != 0;
    if (tile.paint) standing = standing || tile.paint->paint[i][3] != 0;
  }
  tile.grown = next;
  if (next == 0) tile.regrow.reset();
  if (!standing) tile.lasting.reset(), tile.paint.reset();
}

void DisturbanceTiles::let_go() {
  const uint32_t now = this->now();
  while (!ends_.empty() && ends_.top().first <= now) {
    const auto [end, packed] = ends_.top();
    ends_.pop();
    const auto found = map.find(packed);
    if (found == map.end() || found->second.queued != end) continue;
    DisturbanceTile& tile = found->second;
    tile.queued = 0;
    // Touched since: its end is later.
    if (!tile.empty() && end_of(tile) > now) {
      queue_end(packed, tile);
      continue;
    }
    const size_t before = tile.bytes();
    tidy(tile);
    tile.revision = tile.shown = ++revision;
    bytes -= before;
    if (tile.empty()) {
      ++decayed;
      map.erase(found);
      continue;
    }
    bytes += tile.bytes();
    queue_end(packed, tile);
  }
}

bool DisturbanceTiles::make_room(size_t more, const std::vector<TileKey>& kept) {
  if (bytes + more <= options.memory_limit) return true;
  struct Candidate {
    int level;
    uint32_t touched;
    uint64_t packed;
  };
  std::vector<uint64_t> stay;
  for (const TileKey& key : kept)
    for (TileKey k = key;; k = k.parent()) {
      stay.push_back(k.packed());
      if (k.level + 1 == k_tile_levels) break;
    }
  std::ranges::sort(stay);
  std::vector<Candidate> all;
  size_t freed = 0;
  for (const auto& [packed, tile] : map) {
    if ((!tile.press && !tile.wet) || std::ranges::binary_search(stay, packed)) continue;
    all.push_back({int(packed >> 62), std::max(tile.pressed, tile.wetted), packed});
    freed += tile.lasting || tile.paint ? bytes_of(tile.press) + bytes_of(tile.wet) : tile.bytes();
  }
  if (bytes + more > options.memory_limit + freed) return false;
  std::ranges::sort(all, {}, [](const Candidate& c) { return std::tuple(c.level, c.touched, c.packed); });
  // A little more than is asked for, so that it is not asked for every time.
  const size_t slack = std::min(options.memory_limit / 16, freed - (bytes + more - options.memory_limit));
  for (const Candidate& each : all) {
    if (bytes + more + slack <= options.memory_limit) break;
    const auto found = map.find(each.packed);
    DisturbanceTile& tile = found->second;
    bytes -= tile.bytes();
    tile.press.reset();
    tile.wet.reset();
    tile.revision = tile.shown = ++revision;
    ++dropped;
    if (tile.empty()) {
      map.erase(found);
    } else {
      bytes += tile.bytes();
    }
  }
  return true;
}

void DisturbanceTiles::move_epoch() {
  if ((time - epoch) * k_ticks_a_second < k_most_ticks) return;
  constexpr uint32_t k_shift = uint32_t(k_most_ticks / 2);
  const auto shift = [](uint32_t& tick) { tick = tick > k_shift ? tick - k_shift : 0; };
  for (auto& [packed, tile] : map) {
    if (tile.press) std::ranges::for_each(tile.press->time, shift);
    if (tile.wet) std::ranges::for_each(tile.wet->time, shift);
    if (tile.regrow) {
      // 0 means that nothing regrows: what has ended must stay ended.
      for (uint32_t& end : tile.regrow->end)
        if (end != 0) end = std::max(end > k_shift ? end - k_shift : 0, 1u);
      std::ranges::for_each(tile.regrow->start, shift);
    }
    shift(tile.pressed);
    shift(tile.wetted);
    if (tile.grown != 0) tile.grown = std::max(tile.grown > k_shift ? tile.grown - k_shift : 0, 1u);
  }
  epoch += double(k_shift) / k_ticks_a_second;
  requeue_all();
}

}  // namespace sward
