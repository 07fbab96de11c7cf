// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Replaces the global operator new by one that counts in g_allocations. For one source of a test program.
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> g_allocations = 0;
}

[[gnu::noinline]] static void* count_and_take(std::size_t size, std::size_t alignment) {
  ++g_allocations;
  if (void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] static void give_back(void* memory) {
  std::free(memory);
}

void* operator new(std::size_t size) {
  return count_and_take(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return count_and_take(size, std::size_t(alignment));
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}
