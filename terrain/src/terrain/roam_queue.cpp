// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include "roam_queue.h"

#include <sward/terrain/roam_mesh.h>

namespace sward::roam {

uint32_t BucketQueue::bucket_below(uint32_t bucket) const {
  uint32_t w = bucket >> 6;
  uint64_t word = words_[w] & ((uint64_t(1) << (bucket & 63)) - 1);
  if (word == 0) {
    uint32_t s = w >> 6;
    uint64_t summary = summary_[s] & ((uint64_t(1) << (w & 63)) - 1);
    while (summary == 0) {
      if (s == 0) return 0;
      summary = summary_[--s];
    }
    w = s * 64 + 63 - uint32_t(std::countl_zero(summary));
    word = words_[w];
  }
  return w * 64 + 63 - uint32_t(std::countl_zero(word));
}

uint32_t BucketQueue::highest_below(const NodeStates& nodes, uint32_t bucket) const {
  const uint32_t found = bucket_below(bucket);
  if (found == 0) return k_none;
  uint32_t best = heads_[found];
  for (uint32_t node = best; node != k_none; node = nodes[node].next) {
    if (nodes[node].key > nodes[best].key) best = node;
    if (nodes[best].key >= RoamMesh::k_artificial_max) break;
  }
  return best;
}

size_t BucketQueue::some_highest(const NodeStates& nodes, std::span<uint32_t> nodes_out) const {
  size_t count = 0;
  for (uint32_t bucket = bucket_below(k_no_bucket); bucket != 0; bucket = bucket_below(bucket)) {
    for (uint32_t node = heads_[bucket]; node != k_none; node = nodes[node].next) {
      if (count == nodes_out.size()) return count;
      nodes_out[count++] = node;
    }
  }
  return count;
}

uint32_t BucketQueue::lowest(const NodeStates& nodes) const {
  for (size_t s = 0; s < summary_.size(); ++s) {
    uint64_t summary = summary_[s];
    while (summary != 0) {
      const int w = int(s) * 64 + std::countr_zero(summary);
      summary &= summary - 1;
      const uint64_t word = w == 0 ? words_[0] & ~uint64_t(1) : words_[w];
      if (word == 0) continue;
      uint32_t best = heads_[w * 64 + std::countr_zero(word)];
      for (uint32_t node = best; node != k_none && nodes[best].key > 0; node = nodes[node].next)
        if (nodes[node].key < nodes[best].key) best = node;
      return best;
    }
  }
  return k_none;
}

}  // namespace sward::roam
