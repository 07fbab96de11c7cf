// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include "roam_queue.h"

#include <sward/terrain/roam_mesh.h>

namespace sward::roam {

uint32_t BucketQueue::highest(const NodeStates& nodes) const {
  for (int s = int(summary_.size()) - 1; s >= 0; --s) {
    if (summary_[s] == 0) continue;
    const int w = s * 64 + 63 - std::countl_zero(summary_[s]);
    const int bucket = w * 64 + 63 - std::countl_zero(words_[w]);
    if (bucket == 0) return k_none;
    uint32_t best = heads_[bucket];
    for (uint32_t node = best; node != k_none; node = nodes[node].next) {
      if (nodes[node].key > nodes[best].key) best = node;
      if (nodes[best].key >= RoamMesh::k_artificial_max) break;
    }
    return best;
  }
  return k_none;
}

uint32_t BucketQueue::highest_below(const NodeStates& nodes, uint32_t bucket) const {
  uint64_t below = (uint64_t(1) << (bucket & 63)) - 1;
  for (int w = int(bucket >> 6); w >= 0; --w, below = ~uint64_t(0)) {
    const uint64_t word = words_[size_t(w)] & below & (w == 0 ? ~uint64_t(1) : ~uint64_t(0));
    if (word == 0) continue;
    uint32_t best = heads_[size_t(w * 64 + 63 - std::countl_zero(word))];
    for (uint32_t node = best; node != k_none; node = nodes[node].next)
      if (nodes[node].key > nodes[best].key) best = node;
    return best;
  }
  return k_none;
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
