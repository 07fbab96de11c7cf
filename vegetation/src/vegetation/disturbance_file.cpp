// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A disturbance on disk: a header of six 64-bit words (magic and version, tiles, time and epoch as doubles, the cells'
// checksum, the header's own), then the tiles in the order of their keys: key, planes, times, the planes as they are in
// memory. In the machine's byte order, which the magic number tells.

#include <sward/vegetation/disturbance.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "terrain/checksum.h"
#include "terrain/file_io.h"
#include "vegetation/disturbance_tiles.h"

namespace sward {

namespace {

// "SWDST" and the version; raised whenever a value's meaning changes.
constexpr uint64_t k_magic = 0x5453445753000001u, k_family = 0xffffffffff000000u;
constexpr uint32_t k_planes = 31;

using Header = std::array<uint64_t, 6>;

struct TileHead {
  uint64_t key;
  uint32_t planes, pressed, wetted, grown;
};
static_assert(sizeof(TileHead) == 24);

/// Visits the planes with their bits: 1 press, 2 wet, 4 lasting, 8 paint, 16 regrow.
template <class Tile, class Visit>
void each_plane(Tile& tile, Visit visit) {
  visit(1u, tile.press);
  visit(2u, tile.wet);
  visit(4u, tile.lasting);
  visit(8u, tile.paint);
  visit(16u, tile.regrow);
}

void append(std::vector<std::byte>& to, const void* data, size_t bytes) {
  const auto* from = static_cast<const std::byte*>(data);
  to.insert(to.end(), from, from + bytes);
}

void write_tile(uint64_t key, const DisturbanceTile& tile, std::vector<std::byte>& out) {
  TileHead head{key, 0, tile.pressed, tile.wetted, tile.grown};
  each_plane(tile, [&](uint32_t bit, const auto& plane) { head.planes |= plane ? bit : 0; });
  append(out, &head, sizeof head);
  each_plane(tile, [&](uint32_t, const auto& plane) {
    if (plane) append(out, plane.get(), sizeof *plane);
  });
}

/// Takes bytes from the front; false where there are too few.
bool take(std::span<const std::byte>& from, void* to, size_t bytes) {
  if (from.size() < bytes) return false;
  std::memcpy(to, from.data(), bytes);
  from = from.subspan(bytes);
  return true;
}

/// False where a tile's planes do not fit what a Disturbance makes.
bool read_tile(std::span<const std::byte>& from, uint64_t& key, DisturbanceTile& tile) {
  TileHead head{};
  if (!take(from, &head, sizeof head) || head.planes == 0 || head.planes > k_planes) return false;
  key = head.key;
  const TileKey place = TileKey::unpack(key);
  if (place.level >= k_tile_levels || place.packed() != key) return false;
  bool whole = true;
  each_plane(tile, [&](uint32_t bit, auto& plane) {
    if ((head.planes & bit) == 0 || !whole) return;
    plane = std::make_unique<typename std::remove_cvref_t<decltype(plane)>::element_type>();
    whole = take(from, plane.get(), sizeof *plane);
  });
  tile.pressed = head.pressed;
  tile.wetted = head.wetted;
  tile.grown = head.grown;
  return whole && !tile.empty();
}

tl::unexpected<Error> damaged(const std::string& name, const std::string& what) {
  return fail(name + " " + what + "; use an earlier save or start without it. Nothing was changed");
}

Expected<void> check_header(const std::string& name, const Header& header) {
  if ((header[0] & k_family) != (k_magic & k_family)) return damaged(name, "is no disturbance file of this machine");
  if (header[0] != k_magic)
    return damaged(name, "is of version " + std::to_string(header[0] & ~k_family) + ", this program reads version " +
                             std::to_string(k_magic & ~k_family));
  if (header[5] != checksum(header.data(), 5 * sizeof(uint64_t))) return damaged(name, "is damaged");
  const double time = std::bit_cast<double>(header[2]), epoch = std::bit_cast<double>(header[3]);
  if (!(epoch >= 0 && time >= epoch && time - epoch < 1.6e7)) return damaged(name, "has an impossible time");
  return {};
}

}  // namespace

Expected<void> Disturbance::save(const std::string& path) const {
  std::vector<uint64_t> keys;
  keys.reserve(tiles_->map.size());
  for (const auto& [key, tile] : tiles_->map) keys.push_back(key);
  std::ranges::sort(keys);
  std::vector<std::byte> cells;
  for (const uint64_t key : keys) write_tile(key, tiles_->map.at(key), cells);
  Header header{k_magic,
                keys.size(),
                std::bit_cast<uint64_t>(tiles_->time),
                std::bit_cast<uint64_t>(tiles_->epoch),
                checksum(cells.data(), cells.size()),
                0};
  header[5] = checksum(header.data(), 5 * sizeof(uint64_t));
  const std::span<const std::byte> pieces[] = {std::as_bytes(std::span(header)), cells};
  return write_atomically(path, "disturbance", pieces);
}

Expected<void> Disturbance::load(const std::string& path) {
  auto file = InputFile::open(path, "disturbance");
  if (!file) return tl::unexpected(file.error());
  Header header{};
  if (auto read = file->read(0, std::as_writable_bytes(std::span(header))); !read)
    return damaged(file->name(), "is truncated");
  if (auto checked = check_header(file->name(), header); !checked) return checked;
  // A tile in a file is a little smaller than in memory.
  if (file->size() > tiles_->options.memory_limit + sizeof header)
    return damaged(file->name(), "holds more than the memory limit, which can be raised");
  std::vector<std::byte> cells(file->size() - sizeof header);
  if (auto read = file->read(sizeof header, cells); !read) return read;
  if (header[4] != checksum(cells.data(), cells.size())) return damaged(file->name(), "is truncated or damaged");

  auto loaded = std::make_unique<DisturbanceTiles>();
  loaded->options = tiles_->options;
  loaded->time = std::bit_cast<double>(header[2]);
  loaded->epoch = std::bit_cast<double>(header[3]);
  loaded->revision = tiles_->revision;
  std::span<const std::byte> rest(cells);
  for (uint64_t i = 0; i < header[1]; ++i) {
    uint64_t key = 0;
    DisturbanceTile tile;
    if (!read_tile(rest, key, tile)) return damaged(file->name(), "is damaged");
    tile.revision = tile.shown = ++loaded->revision;
    loaded->bytes += tile.bytes();
    if (!loaded->map.try_emplace(key, std::move(tile)).second) return damaged(file->name(), "has a tile twice");
  }
  if (!rest.empty()) return damaged(file->name(), "has more than it says");
  if (loaded->bytes > loaded->options.memory_limit)
    return damaged(file->name(), "holds more than the memory limit, which can be raised");
  loaded->requeue_all();
  ++loaded->revision;
  tiles_ = std::move(loaded);
  tiles_->let_go();
  return {};
}

}  // namespace sward
