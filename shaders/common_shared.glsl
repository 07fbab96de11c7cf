// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What GLSL needs to read the files that the C++ twin compiles as well. Shared files use only what both languages have:
// glm's types and functions, structs returned by value, `f` on literals, SWARD_FN before functions and SWARD_PRECISE
// before every float whose bits must not depend on the compiler. C++'s counterpart is src/vegetation/shared_glsl.h.
#define SWARD_FN
#define SWARD_PRECISE precise

// Low and high word of the 64-bit product.
uvec2 mul_wide(uint a, uint b) {
  uint high, low;
  umulExtended(a, b, high, low);
  return uvec2(low, high);
}
