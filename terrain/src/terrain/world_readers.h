// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace sward::world {

/// Tells when nobody reads any more what was unlinked, without making readers wait: sleepable read-copy-update with two
/// counts (McKenney, "Sleepable RCU", 2006), striped over threads. A reader counts itself in, then looks for data; who
/// unlinks data flips the counts and frees it once those counted in before have all counted out. All operations are
/// sequentially consistent: a reader who is not seen counting in comes after the check, and does not find the data.
class Readers {
 public:
  class Guard {
   public:
    explicit Guard(const Readers& readers)
        : count_(readers.stripes_[stripe()].count[readers.current_.load(std::memory_order_seq_cst)]) {
      count_.fetch_add(1, std::memory_order_seq_cst);
    }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;
    ~Guard() { count_.fetch_sub(1, std::memory_order_seq_cst); }

   private:
    std::atomic<uint32_t>& count_;
  };

  /// One thread at a time, after the other side has drained.
  void flip() { current_.store(1 - current_.load(std::memory_order_seq_cst), std::memory_order_seq_cst); }
  /// Whether all readers that counted in before the last flip have counted out.
  bool drained() const {
    const uint32_t before = 1 - current_.load(std::memory_order_seq_cst);
    for (const Stripe& stripe : stripes_)
      if (stripe.count[before].load(std::memory_order_seq_cst) != 0) return false;
    return true;
  }

 private:
  static constexpr uint32_t k_stripes = 16;
  struct alignas(64) Stripe {
    mutable std::array<std::atomic<uint32_t>, 2> count{};
  };

  static uint32_t stripe() {
    static std::atomic<uint32_t> threads{0};
    static thread_local const uint32_t own = threads.fetch_add(1) % k_stripes;
    return own;
  }

  std::array<Stripe, k_stripes> stripes_;
  std::atomic<uint32_t> current_{0};
};

}  // namespace sward::world
