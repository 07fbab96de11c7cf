// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace sward {

/// Threads that wait between rounds of work. Started by the first round that asks for them, joined at destruction.
class WorkerPool {
 public:
  WorkerPool() = default;
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// Calls work(part) once for each part in [0, parts), each on a thread of its own, part 0 on the calling one; returns
  /// when all are done. What they wrote is then visible to the caller. `work` must not throw. One round at a time.
  template <class Work>
  void run(int parts, Work&& work) {
    if (parts <= 1) return work(0);
    start(
        parts, [](void* context, int part) { (*static_cast<std::remove_reference_t<Work>*>(context))(part); }, &work);
    work(0);
    wait();
  }

 private:
  using Call = void (*)(void* context, int part);
  void start(int parts, Call call, void* context);
  void wait();
  void serve(int part);

  std::vector<std::thread> threads_;  // thread i serves part i + 1
  std::mutex mutex_;
  std::condition_variable begin_, done_;
  Call call_ = nullptr;
  void* context_ = nullptr;
  int parts_ = 0, running_ = 0;
  uint64_t round_ = 0;
  bool stop_ = false;
};

}  // namespace sward
