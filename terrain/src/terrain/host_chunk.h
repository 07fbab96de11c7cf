// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/host_terrain.h>
#include <cstdint>
#include <vector>

#include "fixed_level_chunk.h"

namespace sward::roam {

/// A host's heights at lattice points, each asked for once a chunk. One call of the host, one object.
class HostHeights {
 public:
  HostHeights(const HostHeight& height, const Lattice& lattice) : height_(height), lattice_(lattice) {}
  /// World, metres; NaN where there is no ground.
  double at(LatticePoint p);
  /// Forgets all heights, keeps the memory.
  void forget() { ++round_, count_ = 0; }
  const Lattice& lattice() const { return lattice_; }

 private:
  struct Slot {
    LatticePoint point;
    uint32_t round;  // another one: free
    double z;
  };
  Slot& find(LatticePoint p);
  void grow();

  const HostHeight& height_;
  const Lattice& lattice_;
  std::vector<Slot> slots_;  // a power of two, at most half of them in use
  size_t count_ = 0;
  uint32_t round_ = 1;
};

/// What a chunk is built with.
struct HostChunkOptions {
  float foot_error_m;
  int foot_splits;
  bool altitudes;
};

/// Builds a chunk `depth` levels above the seeding level from a host's heights. Heights of its triangles count from
/// the middle of the chunk's range of heights, which becomes all three of Chunk::corner_z.
void build_host_chunk(HostHeights& heights, const HostChunkOptions& options, const ChunkVisit& visit, int depth,
                      Chunk& chunk);

}  // namespace sward::roam
