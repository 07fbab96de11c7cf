// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/world_data.h>
#include <cstdint>
#include <string>

namespace sward {

struct BakeDesc {
  WorldDesc world;
  /// Names the samples' source: whatever changes when they do (files, their sizes and dates). A bake that was cut off
  /// goes on only where it is the same.
  std::string source;
  int threads = 0;  ///< For the bounds; 0: all cores.
};

struct BakeStats {
  uint32_t baked = 0;    ///< Squares computed and written.
  uint32_t skipped = 0;  ///< Squares that an earlier run had finished.
  uint64_t holes = 0;    ///< Samples without data, those on shared borders counted in each square.
  uint64_t bytes = 0;    ///< Of all files.
};

/// Bakes samples into a folder that World::open() reads; layout in world_files.h. Square by square, row by row from the
/// north-west: memory is that of one square with its margin and of the coarse data, whatever the world's size. `read`
/// is called on this thread. Squares are written to temporaries, synced and renamed; the index comes last, so a set
/// that is not complete is none. Called again after it was cut off, it verifies the squares that are there (same
/// description, same source, right checksum) and computes only the others. One bake a folder at a time.
///
/// Fails when the folder cannot be written or holds another world's index, when `read` fails, when the disk is full:
/// then what is finished stays, and no index is there.
SWARD_API Expected<BakeStats> bake_world(const std::string& folder, const BakeDesc& desc, const ReadHeights& read,
                                         const Progress& progress = {});

}  // namespace sward
