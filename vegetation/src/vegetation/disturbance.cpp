// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Ground that remembers. After E. Lee, "Realistic Real-Time Grass Rendering" (2010), the player's interaction with the
// grass, and 3DWorld, "Infinite Fields of Grass" (2015), grass that is cut, crushed, burnt, wet and sprayed. Departure:
// both act on what is drawn near by; here the ground keeps it, sparsely, wherever it was.

#include <sward/vegetation/disturbance.h>

#include <algorithm>
#include <cmath>

#include "vegetation/disturbance_brush.h"
#include "vegetation/disturbance_tiles.h"
#include "vegetation/shared_glsl.h"

namespace sward {

namespace {

constexpr size_t k_most_tiles = 4096;  // that a brush may reach on a level
constexpr double k_most_seconds = 1e6;
constexpr size_t k_least_memory = 1u << 20;

bool half_life_fits(float seconds) {
  return seconds >= 1.0f && seconds <= 1e6f;
}

shared::Disturbed to_shared(const Disturbed& d) {
  return {d.press, d.cut, d.burn, d.wet, d.paint};
}

Disturbed from_shared(const shared::Disturbed& d) {
  return {d.press, d.cut, d.burn, d.wet, d.paint};
}

/// False for what is no number.
bool within_reach(glm::dvec2 place) {
  return std::abs(place.x) <= Disturbance::k_most_place && std::abs(place.y) <= Disturbance::k_most_place;
}

/// The tiles of the finest level on which a brush is small enough; none where there is no such level.
std::vector<TileKey> tiles_for(const DisturbanceBrush& brush) {
  for (int level = 0; level < k_tile_levels; ++level)
    if (auto tiles = brushed_tiles(brush, level, k_most_tiles); !tiles.empty()) return tiles;
  return {};
}

/// Tiles below these: where they are they show their own cells.
std::vector<TileKey> finer_tiles(const DisturbanceTiles& tiles, const std::vector<TileKey>& keys) {
  std::vector<TileKey> finer;
  if (keys.front().level == 0) return finer;
  std::vector<uint64_t> reached;
  for (const TileKey& key : keys) reached.push_back(key.packed());
  std::ranges::sort(reached);
  for (const auto& [packed, tile] : tiles.map) {
    const TileKey key = TileKey::unpack(packed);
    TileKey above = key;
    while (above.level < keys.front().level) above = above.parent();
    if (above != key && std::ranges::binary_search(reached, above.packed())) finer.push_back(key);
  }
  return finer;
}

/// Bytes that new planes of these tiles, and of those above and below them, may take.
size_t bytes_needed(const DisturbanceTiles& tiles, const std::vector<TileKey>& keys, const PlaneSet& planes) {
  const auto missing = [&](TileKey key) {
    const DisturbanceTile* tile = tiles.find(key);
    TileKey found;
    if (tile == nullptr) {
      // A new tile also takes over what a coarser one has.
      const DisturbanceTile* from = tiles.holder(key, found);
      return planes.bytes() + (from != nullptr ? from->bytes() : 0);
    }
    return PlaneSet{planes.press && !tile->press, planes.wet && !tile->wet, planes.lasting && !tile->lasting,
                    planes.paint && !tile->paint}
               .bytes() -
           PlaneSet{}.bytes();
  };
  size_t bytes = 0;
  for (const TileKey& key : finer_tiles(tiles, keys)) bytes += missing(key);
  std::vector<TileKey> level = keys;
  while (!level.empty()) {
    std::vector<TileKey> above;
    for (const TileKey& key : level) {
      bytes += missing(key);
      if (key.level + 1 < k_tile_levels) above.push_back(key.parent());
    }
    std::ranges::sort(above, {}, &TileKey::packed);
    above.erase(std::ranges::unique(above).begin(), above.end());
    level = std::move(above);
  }
  return bytes;
}

/// True where something changed; a tile that would be new for nothing is not made.
bool brush_one(DisturbanceTiles& tiles, const DisturbanceBrush& brush, const DisturbanceTouch& touch, TileKey key) {
  const bool is_new = tiles.find(key) == nullptr;
  DisturbanceTile& tile = tiles.ensure(key);
  const size_t before = tile.bytes();
  if (brush_tile(brush, touch, key, tile, tiles.clock())) {
    tiles.changed(key, tile, before);
    return true;
  }
  if (is_new) {
    tiles.bytes -= before;
    tiles.map.erase(key.packed());
  }
  return false;
}

void brush_finer(DisturbanceTiles& tiles, const DisturbanceBrush& brush, const DisturbanceTouch& touch,
                 const std::vector<TileKey>& keys) {
  for (const TileKey& key : finer_tiles(tiles, keys)) {
    DisturbanceTile& tile = tiles.map.at(key.packed());
    const size_t before = tile.bytes();
    if (brush_tile(brush, touch, key, tile, tiles.clock())) tiles.changed(key, tile, before);
  }
}

DisturbanceBrush disc(glm::dvec2 centre, double radius_m, float soft) {
  return {centre, centre, radius_m, soft};
}

}  // namespace

Disturbance::Disturbance(std::unique_ptr<DisturbanceTiles> tiles) : tiles_(std::move(tiles)) {}
Disturbance::Disturbance(Disturbance&&) noexcept = default;
Disturbance& Disturbance::operator=(Disturbance&&) noexcept = default;
Disturbance::~Disturbance() = default;

Expected<Disturbance> Disturbance::create(const DisturbanceOptions& options) {
  if (!half_life_fits(options.press_half_life_s) || !half_life_fits(options.wet_half_life_s))
    return fail("disturbance: half-lives must lie within 1 and 1e6 s");
  if (options.memory_limit < k_least_memory) return fail("disturbance: the memory limit must be 1 MiB or more");
  auto tiles = std::make_unique<DisturbanceTiles>();
  tiles->options = options;
  return Disturbance(std::move(tiles));
}

const DisturbanceOptions& Disturbance::options() const {
  return tiles_->options;
}

Expected<void> Disturbance::advance(double seconds) {
  if (!(seconds >= 0 && seconds <= k_most_seconds))
    return fail("disturbance: time advances by 0 to 1e6 s at once; it was left as it is");
  tiles_->time += seconds;
  tiles_->move_epoch();
  tiles_->let_go();
  return {};
}

double Disturbance::time() const {
  return tiles_->time;
}

Expected<void> Disturbance::touch(const DisturbanceBrush& brush, const DisturbanceTouch& touch) {
  if (auto valid = validate(brush, touch); !valid) return valid;
  DisturbanceTiles& tiles = *tiles_;
  const std::vector<TileKey> keys = tiles_for(brush);
  if (keys.empty())
    return fail("disturbance: a brush reaches more than 4096 squares of 32 m; make it smaller or use several");
  const PlaneSet planes = planes_of(touch);
  if (!planes.press && !planes.wet && !planes.lasting && !planes.paint) return {};
  if (!tiles.make_room(bytes_needed(tiles, keys, planes), keys)) {
    ++tiles.refused;
    return fail("disturbance: cut, burnt and painted ground fills the memory limit of " +
                std::to_string(tiles.options.memory_limit >> 20) + " MiB; let some regrow or raise the limit");
  }
  std::vector<TileKey> changed;
  for (const TileKey& key : keys)
    if (brush_one(tiles, brush, touch, key)) changed.push_back(key);
  if (keys.front().level > 0) brush_finer(tiles, brush, touch, keys);
  tiles.update_parents(std::move(changed));
  return {};
}

Expected<void> Disturbance::press_capsule(glm::dvec2 from, glm::dvec2 to, double radius_m, float depth) {
  DisturbanceTouch what;
  what.press = depth;
  return touch({from, to, radius_m, 0.3f}, what);
}

Expected<void> Disturbance::press_disc(glm::dvec2 centre, double radius_m, float depth) {
  DisturbanceTouch what;
  what.press = depth;
  return touch(disc(centre, radius_m, 0.3f), what);
}

Expected<void> Disturbance::cut_capsule(glm::dvec2 from, glm::dvec2 to, double radius_m, float height_left_m) {
  DisturbanceTouch what;
  what.cut_m = height_left_m;
  return touch({from, to, radius_m, 0.0f}, what);
}

Expected<void> Disturbance::burn_disc(glm::dvec2 centre, double radius_m, float amount) {
  DisturbanceTouch what;
  what.burn = amount;
  return touch(disc(centre, radius_m, 0.4f), what);
}

Expected<void> Disturbance::wet_disc(glm::dvec2 centre, double radius_m, float amount) {
  DisturbanceTouch what;
  what.wet = amount;
  return touch(disc(centre, radius_m, 0.4f), what);
}

Expected<void> Disturbance::paint_disc(glm::dvec2 centre, double radius_m, glm::vec3 srgb, float amount) {
  DisturbanceTouch what;
  what.paint = glm::vec4(srgb, amount);
  return touch(disc(centre, radius_m, 0.2f), what);
}

Expected<void> Disturbance::explode(glm::dvec2 centre, double radius_m) {
  DisturbanceTouch blast, fire;
  blast.press = 1;
  fire.burn = 1;
  if (auto laid = touch(disc(centre, radius_m, 0.7f), blast); !laid) return laid;
  return touch(disc(centre, 0.45 * radius_m, 0.6f), fire);
}

Expected<void> Disturbance::rotor_wash(glm::dvec2 centre, double radius_m, float strength) {
  DisturbanceTouch wash;
  wash.press = strength;
  return touch(disc(centre, radius_m, 0.8f), wash);
}

Disturbed Disturbance::at(glm::dvec2 place) const {
  return at(place, place);
}

// Twin of disturbed_here() in shaders/common_disturbance.glsl.
Disturbed Disturbance::at(glm::dvec2 place, glm::dvec2 eye) const {
  if (tiles_->map.empty() || !within_reach(place) || !within_reach(eye)) return {};
  const glm::dvec2 distance = glm::abs(place - eye);
  const double far = std::max(distance.x, distance.y);
  int level = 0;
  while (level < k_tile_levels && far >= level_reach(level)) ++level;
  if (level == k_tile_levels) return {};
  const CellClock clock = tiles_->clock();
  shared::Disturbed d = to_shared(tiles_->sample(level, place, clock));
  const float next = shared::next_disturbance_level(float(far / level_reach(level)));
  if (next > 0) {
    const Disturbed beyond = level + 1 < k_tile_levels ? tiles_->sample(level + 1, place, clock) : Disturbed{};
    d = shared::mix_disturbed(d, to_shared(beyond), next);
  }
  return from_shared(shared::settle_disturbed(d));
}

uint64_t Disturbance::revision() const {
  return tiles_->revision;
}

DisturbanceStats Disturbance::stats() const {
  const DisturbanceTiles& t = *tiles_;
  return {t.map.size(), t.bytes, t.decayed, t.dropped, t.refused};
}

void Disturbance::clear() {
  if (tiles_->map.empty()) return;
  tiles_->map.clear();
  tiles_->bytes = 0;
  ++tiles_->revision;
  tiles_->requeue_all();
}

}  // namespace sward
