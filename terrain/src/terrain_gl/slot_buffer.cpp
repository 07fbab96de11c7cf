// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain_gl/slot_buffer.h>

#include <algorithm>

namespace sward {

namespace {

// Slots that are written together although so many between them have not changed, bytes.
constexpr size_t k_joined_bytes = 512;
constexpr size_t k_least_capacity = 4096;

}  // namespace

bool SlotBuffer::fit(size_t slots) {
  if (capacity_ >= slots && capacity_ > 0) return false;
  capacity_ = std::max({slots, capacity_ + capacity_ / 2, k_least_capacity});
  buffer_ = gl::create_buffer();
  glNamedBufferStorage(buffer_.id(), GLsizeiptr(capacity_ * slot_bytes_), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return true;
}

size_t SlotBuffer::write(const void* data, size_t first, size_t count) {
  glNamedBufferSubData(buffer_.id(), GLintptr(first * slot_bytes_), GLsizeiptr(count * slot_bytes_),
                       static_cast<const std::byte*>(data) + first * slot_bytes_);
  return count * slot_bytes_;
}

size_t SlotBuffer::write_all(const void* data, size_t slots) {
  return slots == 0 ? 0 : write(data, 0, slots);
}

size_t SlotBuffer::write_slots(const void* data, size_t slots, std::span<const uint32_t> changed) {
  sorted_.assign(changed.begin(), changed.end());
  std::ranges::sort(sorted_);
  const auto end = std::ranges::lower_bound(sorted_, slots);
  const size_t count = size_t(end - sorted_.begin()), joined = k_joined_bytes / slot_bytes_;
  size_t written = 0;
  for (size_t first = 0; first < count;) {
    size_t last = first;
    while (last + 1 < count && sorted_[last + 1] - sorted_[last] <= joined) ++last;
    written += write(data, sorted_[first], sorted_[last] - sorted_[first] + 1);
    first = last + 1;
  }
  return written;
}

size_t SlotBuffer::gpu_bytes() const {
  return gl::storage_bytes(buffer_);
}

}  // namespace sward
