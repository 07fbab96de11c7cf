// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sward {

/// Values behind ids of index and generation: places are used again, ids never mean another value.
template <class T, class Id>
class WindSlots {
 public:
  uint32_t size() const { return size_; }

  Id add(T value) {
    if (free_.empty()) {
      free_.push_back(uint32_t(slots_.size()));
      slots_.emplace_back();
    }
    const uint32_t index = free_.back();
    free_.pop_back();
    slots_[index].value = std::move(value);
    slots_[index].live = true;
    ++size_;
    return {index, slots_[index].generation};
  }

  T* find(Id id) {
    if (id.index >= slots_.size()) return nullptr;
    Slot& slot = slots_[id.index];
    return slot.live && slot.generation == id.generation ? &slot.value : nullptr;
  }

  bool remove(Id id) {
    if (find(id) == nullptr) return false;
    slots_[id.index].live = false;
    ++slots_[id.index].generation;
    free_.push_back(id.index);
    --size_;
    return true;
  }

  template <class Visit>
  void for_each(Visit&& visit) {
    for (uint32_t i = 0; i < slots_.size(); ++i)
      if (slots_[i].live) visit(slots_[i].value, Id{i, slots_[i].generation});
  }

 private:
  struct Slot {
    T value;
    uint32_t generation = 0;
    bool live = false;
  };
  std::vector<Slot> slots_;
  std::vector<uint32_t> free_;
  uint32_t size_ = 0;
};

}  // namespace sward
