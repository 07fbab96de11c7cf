// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace sward {

struct RowWork {
  int rows = 0;
  int64_t cost_per_row = 1;  // Items in a row.
  int threads = 0;           // 0: all cores.
};

// Calls work(row) once for each row, in contiguous blocks, one a thread; small work stays on the calling thread.
// `progress` hears of the calling thread's own block, at most 32 times.
template <class Work>
void parallel_rows(const RowWork& rows, const Progress& progress, Work&& work) {
  constexpr int64_t k_worth_a_thread = 1 << 14;
  const int64_t cores = rows.threads > 0 ? rows.threads : std::max(1u, std::thread::hardware_concurrency());
  const auto blocks = int(std::clamp<int64_t>(rows.rows * rows.cost_per_row / k_worth_a_thread, 1, cores));
  const auto begin_of = [&](int block) { return int(int64_t(rows.rows) * block / blocks); };
  std::vector<std::thread> helpers;
  for (int block = 1; block < blocks; ++block) {
    helpers.emplace_back([&work, first = begin_of(block), last = begin_of(block + 1)] {
      for (int row = first; row < last; ++row) work(row);
    });
  }
  const int own = begin_of(1);
  const int stride = std::max(1, (own + 31) / 32);
  for (int row = 0; row < own; ++row) {
    work(row);
    if (progress && (row + 1) % stride == 0) progress(float(row + 1) / float(own));
  }
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace sward
