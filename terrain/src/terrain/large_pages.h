// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace sward {

/// Asks the system to put large pages under a block that has not been touched yet: fewer faults while it is filled, and
/// fewer misses of the address translation when it is read here and there. Of the block, whole large pages alone. Does
/// nothing where the system has none to give.
void prefer_large_pages(void* block, size_t bytes);

/// std::allocator that prefers large pages for blocks of several of them.
template <typename T>
struct LargePages : std::allocator<T> {
  LargePages() = default;
  template <typename U>
  explicit(false) LargePages(const LargePages<U>&) {}
  template <typename U>
  struct rebind {
    using other = LargePages<U>;
  };

  T* allocate(size_t count) {
    T* block = std::allocator<T>::allocate(count);
    prefer_large_pages(block, count * sizeof(T));
    return block;
  }
};

template <typename T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace sward
