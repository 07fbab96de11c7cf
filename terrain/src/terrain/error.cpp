// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/error.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace sward {

namespace {

void print_and_abort(const char* expression, const char* message, const char* file, int line) {
  std::fprintf(stderr, "sward: misuse: %s (%s, %s:%d)\n", message, expression, file, line);
  std::abort();
}

std::atomic<AssertHandler> g_handler{print_and_abort};

}  // namespace

void set_assert_handler(AssertHandler handler) { g_handler = handler != nullptr ? handler : print_and_abort; }

void assert_failed(const char* expression, const char* message, const char* file, int line) {
  g_handler.load()(expression, message, file, line);
}

}  // namespace sward
