// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/world_data.h>
#include <cstdint>
#include <string>

#include "world_layout.h"

namespace sward::world {

/// A baked world on disk: a folder with `world.index` and one file a square, `r0012/c0034.square`. All numbers are
/// little-endian; 64-bit words unless said otherwise.
///
///   world.index  magic and version | fingerprint | columns | rows | spacing x, y | origin x, y, z | scale | offset |
///                root bits | coarse bits | floats (0 or 1) | payload bytes | payload checksum | header checksum
///                payload: a checksum a square, coarse heights (float), coarse bounds, cell bounds (16 bits), padded
///   a square     magic and version | fingerprint | column | row | bytes of samples, bounds, holes | payload checksum |
///                header checksum
///                payload: samples, bounds, holes, each padded with zeros to 8 bytes
///
/// The fingerprint ties squares to the description and to the source that they were baked from.
struct WorldIndex {
  WorldDesc desc;
  uint64_t fingerprint = 0;
  std::vector<uint64_t> checksums;  // of squares' payloads, row by row
  WorldCoarse coarse;
};

/// Of a description and of whatever names the source.
uint64_t fingerprint_of(const WorldDesc& desc, const std::string& source);

std::string index_path(const std::string& folder);
std::string square_path(const std::string& folder, glm::ivec2 square);

/// Writes to a temporary beside the file, syncs it and renames it; nothing is left of it when that fails. Returns the
/// payload's checksum.
Expected<uint64_t> write_square(const std::string& folder, const WorldLayout& layout, uint64_t fingerprint,
                                glm::ivec2 square, const SquareData& data);
Expected<void> write_index(const std::string& folder, const WorldIndex& index);

Expected<WorldIndex> read_index(const std::string& folder);

/// A square that was read, with its payload's checksum.
struct ReadSquare {
  SquareData data;
  uint64_t checksum = 0;
};
/// Reads and verifies a square. `mapped`: the data lies in the mapped file. Fails, naming the file, when it is missing,
/// no ordinary file, truncated, longer, damaged, unreadable, of another version or of another world.
Expected<ReadSquare> read_square(const std::string& folder, const WorldLayout& layout, uint64_t fingerprint,
                                 glm::ivec2 square, bool mapped);

}  // namespace sward::world
