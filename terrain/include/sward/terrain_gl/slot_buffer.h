// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/handles.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward {

/// A GPU buffer of slots of one size, of which a frame writes few. GL thread; binds nothing.
class SWARD_API SlotBuffer {
 public:
  SlotBuffer() = default;
  explicit SlotBuffer(size_t slot_bytes) : slot_bytes_(slot_bytes) {}

  GLuint id() const { return buffer_.id(); }
  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  /// Makes room for `slots`; true when that took a new buffer, whose contents are undefined.
  bool fit(size_t slots);
  /// Writes the first `slots` slots; the bytes written.
  size_t write_all(const void* data, size_t slots);
  /// Writes the slots named, those beyond `slots` left out; the bytes written. Slots that lie close together go in one
  /// run: a call costs more than some bytes.
  size_t write_slots(const void* data, size_t slots, std::span<const uint32_t> changed);

 private:
  size_t write(const void* data, size_t first, size_t count);

  gl::Buffer buffer_;
  size_t slot_bytes_ = 0, capacity_ = 0;
  std::vector<uint32_t> sorted_;
};

}  // namespace sward
