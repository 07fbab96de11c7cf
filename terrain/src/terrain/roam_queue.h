// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "large_pages.h"

namespace sward::roam {

inline constexpr uint32_t k_none = 0xffffffffu;

/// Culling flags of a node: bits 0..5 say "wholly inside this halfspace", k_out says "wholly outside of one of them"
/// or in the padding. Children inherit every bit.
using CullFlags = uint8_t;
inline constexpr CullFlags k_out = 0x80;

/// The centre of this split node's diamond is on its way down: its halves count as leaves already.
inline constexpr CullFlags k_falling = 0x40;

/// What a view makes of a node, and its place in the split queue (a leaf, or half of a falling diamond) or the merge
/// queue (a split node, for its diamond). Two share a cache line, as siblings do.
struct alignas(32) NodeState {
  static constexpr uint32_t k_unqueued = 0xffffffffu;
  uint32_t previous = k_none, next = k_none;
  float key = 0;
  float priority = -1;  ///< Of the node's own triangle, pixels; -1 when it is out. Only with RoamOptions::plain.
  uint32_t bucket = k_unqueued;
  CullFlags cull = k_out;
  bool half_queued = false;  ///< Split node: its diamond is in the merge queue.
  bool held = false;         ///< Leaf: its parent is falling and stands for it.
  bool blocked = false;      ///< Leaf: it is in the queue of those that the surface does not allow to split.

  bool queued() const { return bucket != k_unqueued; }
};
using NodeStates = LargeVector<NodeState>;

/// Priority queue over keys >= 0 with 2048 buckets an octave, cut from the float's own bits, under a two-level bitmap:
/// insertion and removal take constant time, the extreme key is exact (its bucket is searched). Bucket 0 holds what
/// has no priority: nodes that are not visible (key < 0).
class BucketQueue {
 public:
  static uint32_t bucket_of(float key) {
    return key < 0 ? uint32_t(0) : uint32_t(1 + (std::bit_cast<uint32_t>(key + 0.0f) >> k_shift));
  }

  BucketQueue() : heads_(k_buckets, k_none) {}

  void insert(NodeStates& nodes, uint32_t node, float key) {
    const uint32_t bucket = bucket_of(key);
    const uint32_t head = heads_[bucket];
    if (top_ != k_none && key >= nodes[top_].key) top_ = node;
    nodes[node].key = key;
    nodes[node].bucket = bucket;
    nodes[node].previous = k_none;
    nodes[node].next = head;
    if (head != k_none) nodes[head].previous = node;
    heads_[bucket] = node;
    words_[bucket >> 6] |= uint64_t(1) << (bucket & 63);
    summary_[bucket >> 12] |= uint64_t(1) << (bucket >> 6 & 63);
    ++size_;
  }

  void remove(NodeStates& nodes, uint32_t node) {
    const uint32_t bucket = nodes[node].bucket;
    const uint32_t previous = nodes[node].previous, next = nodes[node].next;
    if (node == top_) top_ = k_none;
    if (next != k_none) nodes[next].previous = previous;
    if (previous != k_none) {
      nodes[previous].next = next;
    } else {
      heads_[bucket] = next;
      if (next == k_none) clear_bit(bucket);
    }
    nodes[node].bucket = NodeState::k_unqueued;
    --size_;
  }

  void change_key(NodeStates& nodes, uint32_t node, float key) {
    if (bucket_of(key) == nodes[node].bucket) {
      nodes[node].key = key;
      top_ = k_none;
    } else {
      remove(nodes, node);
      insert(nodes, node, key);
    }
  }

  /// The node of the largest key; k_none when none has a priority.
  uint32_t highest(const NodeStates& nodes) const { return highest_below(nodes, k_no_bucket); }
  /// The same, without a search while it stays: a bucket of a large mesh holds hundreds.
  uint32_t top(const NodeStates& nodes) {
    if (top_ == k_none) top_ = highest(nodes);
    return top_;
  }
  /// The same among the buckets before one.
  uint32_t highest_below(const NodeStates& nodes, uint32_t bucket) const;
  /// Nodes of the largest keys, not quite in their order, into `nodes_out`; their number.
  size_t some_highest(const NodeStates& nodes, std::span<uint32_t> nodes_out) const;
  /// The node of the smallest key >= 0; k_none when none has a priority.
  uint32_t lowest(const NodeStates& nodes) const;
  /// Calls visit(node) for all of a bucket.
  template <class Visit>
  void for_each(const NodeStates& nodes, uint32_t bucket, Visit&& visit) const {
    for (uint32_t node = heads_[bucket]; node != k_none; node = nodes[node].next) visit(node);
  }
  /// Some node without a priority, or k_none.
  uint32_t unprioritised() const { return heads_[0]; }
  size_t size() const { return size_; }
  void clear() {
    std::fill(heads_.begin(), heads_.end(), k_none);
    words_.fill(0);
    summary_.fill(0);
    size_ = 0;
    top_ = k_none;
  }

 private:
  static constexpr int k_shift = 12;
  static constexpr int k_buckets = 1 << 19;
  // Above that of every key, infinity included.
  static constexpr uint32_t k_no_bucket = k_buckets - 1;

  // The highest bucket below this one that is not empty; 0 when all that is left has no priority.
  uint32_t bucket_below(uint32_t bucket) const;

  void clear_bit(uint32_t bucket) {
    uint64_t& word = words_[bucket >> 6];
    word &= ~(uint64_t(1) << (bucket & 63));
    if (word == 0) summary_[bucket >> 12] &= ~(uint64_t(1) << (bucket >> 6 & 63));
  }

  std::vector<uint32_t> heads_;
  std::array<uint64_t, k_buckets / 64> words_{};
  std::array<uint64_t, k_buckets / 4096> summary_{};
  size_t size_ = 0;
  uint32_t top_ = k_none;  // the node of the largest key, if known
};

}  // namespace sward::roam
