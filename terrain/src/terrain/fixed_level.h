// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/fixed_triangles.h>
#include <span>
#include <vector>

#include "roam_tree.h"

namespace sward::roam {

/// What the surface's static data (areas, holes: all that Surface answers beside heights and bounds) are known to be.
///
/// Heights, splits, merges and bounds need no notice: the collection compares what it kept with the tree.
struct SurfaceState {
  /// Names the data; never the same for two surfaces or meshes of a process, one more after every change. 0: not known,
  /// so everything counts as changed.
  uint64_t epoch = 0;
  /// Where the data of the last epochs differ from those before them, the newest last. Whoever has seen only an older
  /// epoch than these take everything as changed. Valid during the call.
  std::span<const LatticeBox> changed;
};

/// The epochs of one surface or mesh.
class SurfaceHistory {
 public:
  /// Takes a range of epochs that no other of the process has.
  SurfaceHistory();
  void changed(const LatticeBox& box);
  SurfaceState state() const { return {epoch_, changes_}; }

 private:
  uint64_t epoch_ = 0;
  std::vector<LatticeBox> changes_;
};

class ChunkSource;

/// Writes the triangles of a source's level that its view sees, as the next function does. Keys of visits must name
/// the same triangles in all calls for one surface.
void collect_fixed_level(const ChunkSource& source, const SurfaceState& surface, FixedTriangles& out);

/// Writes the triangles of options.level that a view sees, on the surface of the tree's leaves, to `out`, whatever it
/// held. Keeps what the next call needs in out.memory(): calls may be missed, trees, views and options may change in
/// between. Leaves `out` alone when it still holds the answer. The result is a function of the arguments alone, not of
/// the calls before or the number of threads.
void collect_fixed_level(const RoamTree& tree, const View& view, const FixedLevelOptions& options,
                         const SurfaceState& surface, FixedTriangles& out);

/// The same, with static data that count as changed.
inline void collect_fixed_level(const RoamTree& tree, const View& view, const FixedLevelOptions& options,
                                FixedTriangles& out) {
  collect_fixed_level(tree, view, options, SurfaceState{}, out);
}

}  // namespace sward::roam
