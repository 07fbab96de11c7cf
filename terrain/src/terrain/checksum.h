// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

namespace sward {

// FNV-1a over 64-bit words, high bits fed back; the number of bytes is part of it. `start` chains several pieces.
inline uint64_t checksum(const void* data, size_t bytes, uint64_t start = 0xcbf29ce484222325u) {
  uint64_t hash = start ^ bytes;
  const auto* from = static_cast<const unsigned char*>(data);
  for (; bytes > 0;) {
    const size_t taken = bytes < 8 ? bytes : 8;
    uint64_t word = 0;
    std::memcpy(&word, from, taken);
    hash = (hash ^ word ^ (hash >> 32)) * 0x100000001b3u;
    from += taken;
    bytes -= taken;
  }
  return hash;
}

}  // namespace sward
