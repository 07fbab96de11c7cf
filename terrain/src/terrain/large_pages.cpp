// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include "large_pages.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sward {

void prefer_large_pages([[maybe_unused]] void* block, [[maybe_unused]] size_t bytes) {
#ifdef __linux__
  constexpr uintptr_t k_page = uintptr_t(2) << 20;
  const uintptr_t first = (reinterpret_cast<uintptr_t>(block) + k_page - 1) / k_page * k_page;
  const uintptr_t last = (reinterpret_cast<uintptr_t>(block) + bytes) / k_page * k_page;
  // A hint: without it everything is as it was.
  if (last > first) (void)madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace sward
