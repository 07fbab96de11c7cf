// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Functions compiled for wider registers, too; which is used is chosen when the program starts. The same operations in
// the same order, so the same results. What they call must be inlined (SWARD_INLINE) to be compiled so. Sanitizers run
// before that choice can be made.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SWARD_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SWARD_WIDE
#endif

#if defined(__GNUC__)
#define SWARD_INLINE inline __attribute__((always_inline))
#else
#define SWARD_INLINE inline
#endif
