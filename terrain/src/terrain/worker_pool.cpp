// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "worker_pool.h"

namespace sward {

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  begin_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::start(int parts, Call call, void* context) {
  while (int(threads_.size()) < parts - 1) threads_.emplace_back(&WorkerPool::serve, this, int(threads_.size()) + 1);
  {
    const std::lock_guard lock(mutex_);
    call_ = call;
    context_ = context;
    parts_ = parts;
    running_ = parts - 1;
    ++round_;
  }
  begin_.notify_all();
}

void WorkerPool::wait() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return running_ == 0; });
}

// A thread that starts after rounds have been served sees the last of them, which had no part for it.
void WorkerPool::serve(int part) {
  uint64_t served = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    begin_.wait(lock, [&] { return stop_ || round_ != served; });
    if (stop_) return;
    served = round_;
    if (part >= parts_) continue;
    const Call call = call_;
    void* const context = context_;
    lock.unlock();
    call(context, part);
    lock.lock();
    if (--running_ == 0) done_.notify_one();
  }
}

}  // namespace sward
