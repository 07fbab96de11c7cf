// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "large_pages.h"
#include "roam_queue.h"

namespace sward::roam {

/// The drawn leaves, each in a slot that it keeps while it is drawn; only when their number falls do the last ones move
/// into the gaps. Remembers which slots were written.
class DrawList {
 public:
  void grow(size_t nodes) {
    if (slot_.size() < nodes) slot_.resize(nodes, k_none);
  }
  bool contains(uint32_t node) const { return slot_[node] != k_none; }
  uint32_t slot(uint32_t node) const { return slot_[node]; }
  uint32_t count() const { return uint32_t(nodes_.size() - free_.size()); }
  /// By slot; without gaps after close().
  std::span<const uint32_t> nodes() const { return nodes_; }
  std::span<const uint32_t> indices() const { return indices_; }
  /// Slots written since begin_changes(); some may lie beyond the end by now.
  std::span<const uint32_t> changed() const { return changed_; }

  void begin_changes() {
    changed_.clear();
    ++period_;
  }
  void add(uint32_t node, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t slot = uint32_t(nodes_.size());
    if (free_.empty()) {
      nodes_.push_back(node);
      indices_.resize(indices_.size() + 3);
      change_.resize(std::max(change_.size(), nodes_.size()));
      changed_.reserve(change_.capacity());
      free_.reserve(change_.capacity());
    } else {
      slot = free_.back();
      free_.pop_back();
      nodes_[slot] = node;
    }
    slot_[node] = slot;
    indices_[3 * slot] = a;
    indices_[3 * slot + 1] = b;
    indices_[3 * slot + 2] = c;
    mark(slot);
  }
  void remove(uint32_t node) {
    nodes_[slot_[node]] = k_none;
    free_.push_back(slot_[node]);
    slot_[node] = k_none;
  }
  /// Closes the gaps.
  void close() {
    std::sort(free_.begin(), free_.end());
    size_t lowest = 0;
    while (lowest < free_.size()) {
      if (nodes_.back() == k_none) {
        free_.pop_back();  // the highest gap is the last slot
      } else {
        const uint32_t gap = free_[lowest++], last = uint32_t(nodes_.size() - 1);
        nodes_[gap] = nodes_[last];
        slot_[nodes_[gap]] = gap;
        std::copy_n(indices_.begin() + 3 * std::ptrdiff_t(last), 3, indices_.begin() + 3 * std::ptrdiff_t(gap));
        mark(gap);
      }
      nodes_.pop_back();
      indices_.resize(indices_.size() - 3);
    }
    free_.clear();
  }
  void clear() {
    for (const uint32_t node : nodes_)
      if (node != k_none) slot_[node] = k_none;
    nodes_.clear();
    indices_.clear();
    free_.clear();
  }

 private:
  void mark(uint32_t slot) {
    if (change_[slot] == period_) return;
    change_[slot] = period_;
    changed_.push_back(slot);
  }

  LargeVector<uint32_t> slot_;     // by node; k_none: not drawn
  std::vector<uint32_t> nodes_;    // by slot; k_none: a gap
  std::vector<uint32_t> indices_;  // three a slot
  std::vector<uint32_t> free_, changed_;
  std::vector<uint32_t> change_;  // by slot: the period in which it was written last
  uint32_t period_ = 1;
};

}  // namespace sward::roam
