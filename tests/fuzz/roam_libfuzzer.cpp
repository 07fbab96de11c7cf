// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Entry point for libFuzzer, outside of the ordinary build:
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -Iterrain/include tests/fuzz/roam_libfuzzer.cpp
//     terrain/src/terrain/*.cpp -o roam_fuzzer
#include <cstdio>
#include <cstdlib>

#include "roam_driver.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  uint64_t steps = 0;
  const std::string fault = roam_driver::run({data, size}, steps);
  if (!fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
