// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::roam {

/// What one tick of a motion clock allows: so many metres of travel together with so many radians of turning, or so
/// large a change of a guard's logarithm.
struct TickUnits {
  float metres = 1.0f;
  float radians = 0.002f;
  float log_guard = 0.0004f;
};

/// Nodes by the tick up to which what was found out about them holds (Duchaineau et al. 1997, section 7.3). A ring of
/// lists of the coming ticks; a node that is entered again leaves its older entry behind, which the reader tells by the
/// node's own record of its tick. Lists are chains of blocks from one pool: nothing is allocated once the pool is large
/// enough.
class Calendar {
 public:
  static constexpr uint32_t k_span = 4096;  ///< Ticks ahead that can be entered.
  /// Least tick: smaller numbers are free for marks in the nodes' records.
  static constexpr uint32_t k_first_tick = 16;

  /// The clock: `ticks` go by. Time does not run backwards.
  void advance(double ticks) { now_ += std::min(ticks, 2.0 * k_span); }
  /// The tick at which something that holds for `ticks` more is to be looked at again; 0 when that is now.
  uint32_t tick_after(float ticks) const {
    const uint32_t tick = uint32_t(now_ + double(ticks > 0 ? std::min(ticks, float(k_span - 1)) : 0.0f));
    return tick <= uint32_t(now_) || tick < read_ ? 0 : tick;
  }
  /// Whether what held up to a tick has to be looked at again.
  bool past(uint32_t tick) const { return tick <= uint32_t(now_); }
  void enter(uint32_t node, uint32_t tick) {
    Head& head = heads_[tick % k_span];
    if (head.block == k_nil || head.count == k_in_block) {
      const uint32_t block = take_block();
      pool_[block].next = head.block;
      head = {block, 0};
    }
    pool_[head.block].node[head.count++] = node;
    ++entries_;
  }
  /// Moves all entries that have come due into `due`, with their ticks.
  struct Entry {
    uint32_t node, tick;
  };
  void take_due(std::vector<Entry>& due) {
    const uint32_t now = uint32_t(now_);
    const uint32_t last = std::min(now, read_ + k_span - 1);
    for (uint32_t tick = read_; tick <= last; ++tick) take_list(tick, due);
    read_ = std::max(read_, now + 1);
  }
  bool empty() const { return entries_ == 0; }
  /// Ticks are about to run out of numbers: clear() begins anew.
  bool old() const { return now_ > 2e9; }
  void clear() {
    heads_.fill({});
    pool_.clear();
    free_ = k_nil;
    entries_ = 0;
    now_ = k_first_tick;
    read_ = k_first_tick;
  }

 private:
  static constexpr uint32_t k_nil = 0xffffffffu;
  static constexpr uint32_t k_in_block = 31;
  // All blocks of a list but its first are full.
  struct Block {
    uint32_t next = k_nil;
    std::array<uint32_t, k_in_block> node;
  };
  struct Head {
    uint32_t block = k_nil, count = 0;
  };

  uint32_t take_block() {
    if (free_ == k_nil) {
      pool_.emplace_back();
      return uint32_t(pool_.size() - 1);
    }
    const uint32_t block = free_;
    free_ = pool_[block].next;
    return block;
  }
  void take_list(uint32_t tick, std::vector<Entry>& due) {
    Head& head = heads_[tick % k_span];
    while (head.block != k_nil) {
      Block& block = pool_[head.block];
      for (uint32_t i = 0; i < head.count; ++i) due.push_back({block.node[i], tick});
      entries_ -= head.count;
      const uint32_t next = block.next;
      block.next = free_;
      free_ = head.block;
      head = {next, k_in_block};
    }
  }

  std::array<Head, k_span> heads_{};
  std::vector<Block> pool_;
  uint32_t free_ = k_nil;
  size_t entries_ = 0;
  double now_ = k_first_tick;
  uint32_t read_ = k_first_tick;  // the next tick to be taken
};

}  // namespace sward::roam
