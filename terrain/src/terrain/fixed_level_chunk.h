// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fixed_level_walk.h"

namespace sward::roam {

/// Chunks stand this many levels above the seeding level, or are roots.
inline constexpr int k_chunk_depth = 6;
inline constexpr size_t k_chunk_size = size_t(1) << k_chunk_depth;

/// A split of the drawn surface below a triangle of a chunk; children count from the triangle's first node, 0: none.
struct ChunkNode {
  double z = 0;
  uint32_t child[2] = {0, 0};
};

/// A split of the mesh's tree below a chunk as it was when the chunk was built.
struct SplitMark {
  double z;                 ///< Of the split vertex.
  float bound;              ///< Of a node of the seeding level, else 0.
  uint32_t children_split;  ///< Bit i: child i is split, too.
  bool operator==(const SplitMark&) const = default;
};

/// A sub-tree of up to 64 triangles of the seeding level, in the order of their turns: triangle j is reached by the
/// bits of j, the highest first. Kept from frame to frame. What every frame reads stands first.
struct alignas(64) Chunk {
  bool has_static = false, has_drawn = false;
  bool flat = true;        ///< Lies within one leaf.
  float steepness = 0;     ///< Largest rise along a triangle's edges against its legs.
  glm::dvec3 corner_z{0};  ///< Drawn z of the chunk's apex, left, right.
  float reach = 0;         ///< How far its ground leaves corner_z, where a host answers heights: metres, up or down.
  uint64_t solid = 0;      ///< Bit j: the triangle is neither padding nor a hole. Static.
  LatticeBox box;          ///< Static.
  std::vector<SplitMark> marks;
  std::vector<ChunkNode> nodes;

  std::array<float, k_chunk_size> area{};               ///< Static.
  /// Static: z of the finest data at the corners, world; empty where the options do not ask for it.
  std::vector<glm::vec3> altitude;
  std::array<float, k_chunk_size> apex_z{};             ///< Against the chunk's apex.
  std::array<float, k_chunk_size> left_z{}, right_z{};  ///< z of the edges once more, side by side.
  std::array<glm::vec3, k_chunk_size> to_left{}, to_right{};
  std::array<glm::dvec3, k_chunk_size> apex{};
  // Of chunks that are not flat.
  std::array<float, k_chunk_size> bound{};  ///< Of the surface below the triangle, metres.
  std::array<uint32_t, k_chunk_size> first_node{}, node_count{};
};

/// What one view makes of a chunk's triangles.
struct ChunkResult {
  uint64_t visible = 0;
  std::array<float, k_chunk_size> distance{}, screen_area{};
};

/// Static part of a chunk.
void build_static(const FixedLevelWalk& walk, const ChunkVisit& visit, int depth, Chunk& chunk);
/// Rebuilds the drawn part if the mesh differs from what it was built from; true if it did.
bool refresh_drawn(const RoamTree& tree, const ChunkVisit& visit, int depth, Chunk& chunk);

}  // namespace sward::roam
