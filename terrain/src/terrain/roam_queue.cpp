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

size_t BucketQueue::some_highest(const NodeStates& nodes, std::span<uint32_t> nodes_out) const {
  size_t count = 0;
  for (int s = int(summary_.size()) - 1; s >= 0; --s) {
    for (uint64_t summary = summary_[size_t(s)]; summary != 0;) {
      const int w = 63 - std::countl_zero(summary);
      summary &= ~(uint64_t(1) << w);
      for (uint64_t word = words_[size_t(s * 64 + w)]; word != 0;) {
        const int bit = 63 - std::countl_zero(word);
        word &= ~(uint64_t(1) << bit);
        const int bucket = (s * 64 + w) * 64 + bit;
        for (uint32_t node = bucket == 0 ? k_none : heads_[size_t(bucket)]; node != k_none; node = nodes[node].next) {
          if (count == nodes_out.size()) return count;
          nodes_out[count++] = node;
        }
      }
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
