// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::roam {

inline constexpr uint32_t k_none = 0xffffffffu;

/// Links, keys and buckets by node. Shared by the split and the merge queue: a node is a leaf or it is not.
struct QueueLinks {
  static constexpr uint16_t k_unqueued = 0xffff;
  std::vector<uint32_t> previous, next;
  std::vector<float> key;
  std::vector<uint16_t> bucket;

  void resize(size_t nodes) {
    previous.resize(nodes, k_none);
    next.resize(nodes, k_none);
    key.resize(nodes, 0);
    bucket.resize(nodes, k_unqueued);
  }
  bool queued(uint32_t node) const { return bucket[node] != k_unqueued; }
};

/// Priority queue over keys >= 0 with 64 buckets an octave, cut from the float's own bits, under a two-level bitmap:
/// insertion and removal take constant time, the extreme key is exact (its bucket is searched). Bucket 0 holds what
/// has no priority: nodes that are not visible (key < 0).
class BucketQueue {
 public:
  static uint16_t bucket_of(float key) {
    return key < 0 ? uint16_t(0) : uint16_t(1 + (std::bit_cast<uint32_t>(key + 0.0f) >> k_shift));
  }

  BucketQueue() : heads_(k_buckets, k_none) {}

  void insert(QueueLinks& links, uint32_t node, float key) {
    const uint16_t bucket = bucket_of(key);
    const uint32_t head = heads_[bucket];
    links.key[node] = key;
    links.bucket[node] = bucket;
    links.previous[node] = k_none;
    links.next[node] = head;
    if (head != k_none) links.previous[head] = node;
    heads_[bucket] = node;
    words_[bucket >> 6] |= uint64_t(1) << (bucket & 63);
    summary_[bucket >> 12] |= uint64_t(1) << (bucket >> 6 & 63);
    ++size_;
  }

  void remove(QueueLinks& links, uint32_t node) {
    const uint16_t bucket = links.bucket[node];
    const uint32_t previous = links.previous[node], next = links.next[node];
    if (next != k_none) links.previous[next] = previous;
    if (previous != k_none) {
      links.next[previous] = next;
    } else {
      heads_[bucket] = next;
      if (next == k_none) clear_bit(bucket);
    }
    links.bucket[node] = QueueLinks::k_unqueued;
    --size_;
  }

  void change_key(QueueLinks& links, uint32_t node, float key) {
    if (bucket_of(key) == links.bucket[node]) {
      links.key[node] = key;
    } else {
      remove(links, node);
      insert(links, node, key);
    }
  }

  /// The node of the largest key; k_none when none has a priority.
  uint32_t highest(const QueueLinks& links) const;
  /// The node of the smallest key >= 0; k_none when none has a priority.
  uint32_t lowest(const QueueLinks& links) const;
  /// Some node without a priority, or k_none.
  uint32_t unprioritised() const { return heads_[0]; }
  size_t size() const { return size_; }

 private:
  static constexpr int k_shift = 17;
  static constexpr int k_buckets = 1 << 14;

  void clear_bit(uint16_t bucket) {
    uint64_t& word = words_[bucket >> 6];
    word &= ~(uint64_t(1) << (bucket & 63));
    if (word == 0) summary_[bucket >> 12] &= ~(uint64_t(1) << (bucket >> 6 & 63));
  }

  std::vector<uint32_t> heads_;
  std::array<uint64_t, k_buckets / 64> words_{};
  std::array<uint64_t, k_buckets / 4096> summary_{};
  size_t size_ = 0;
};

}  // namespace sward::roam
