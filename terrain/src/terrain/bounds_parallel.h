// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace sward {

struct RowWork {
  int rows = 0;
  int64_t cost_per_row = 1;  // Items in a row.
  int threads = 0;           // 0: all cores.
};

// Calls work(row) once for each row. Threads take runs of rows as they come free: one that starts late, or whose core
// is busy with something else, does less. Small work stays on the calling thread, which alone calls `progress`, at most
// 32 times.
template <class Work>
void parallel_rows(const RowWork& rows, const Progress& progress, Work&& work) {
  constexpr int64_t k_worth_a_thread = 1 << 14;
  constexpr int k_runs_a_thread = 16, k_reports = 32;
  const int64_t cores = rows.threads > 0 ? rows.threads : std::max(1u, std::thread::hardware_concurrency());
  const auto threads = int(std::clamp<int64_t>(rows.rows * rows.cost_per_row / k_worth_a_thread, 1, cores));
  const int run = std::max(1, rows.rows / (k_runs_a_thread * threads));
  std::atomic<int> next{0};
  const auto take_runs = [&](auto&& after_run) {
    for (int first = next.fetch_add(run); first < rows.rows; first = next.fetch_add(run)) {
      const int last = std::min(first + run, rows.rows);
      for (int row = first; row < last; ++row) work(row);
      after_run(last);
    }
  };
  std::vector<std::thread> helpers;
  for (int helper = 1; helper < threads; ++helper) helpers.emplace_back([&] { take_runs([](int) {}); });
  int reported = 0;
  take_runs([&](int last) {
    const int part = int(int64_t(last) * k_reports / rows.rows);
    if (!progress || part == reported) return;
    reported = part;
    progress(float(last) / float(rows.rows));
  });
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace sward
