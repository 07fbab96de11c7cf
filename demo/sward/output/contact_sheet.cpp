// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "sward/output/files.h"

namespace sward::tool {

namespace {

constexpr int k_gap_px = 3;
constexpr uint8_t k_gap_grey = 24;

}  // namespace

ContactSheet::ContactSheet(glm::ivec2 size, size_t frames, size_t shown)
    : size_(size), frames_(std::max<size_t>(frames, 1)), shown_(std::clamp<size_t>(shown, 1, frames_)) {
  const int columns = int(std::ceil(std::sqrt(double(shown_))));
  grid_ = {columns, (int(shown_) + columns - 1) / columns};
  pixels_ = grid_ * (size_ + k_gap_px) - k_gap_px;
  rgb_.assign(3 * size_t(pixels_.x) * size_t(pixels_.y), k_gap_grey);
}

bool ContactSheet::wants_next() const {
  return placed_ < shown_ && next_ == placed_ * frames_ / shown_;
}

void ContactSheet::add(const std::vector<uint8_t>& rgb) {
  const glm::ivec2 cell(int(placed_) % grid_.x, int(placed_) / grid_.x);
  const glm::ivec2 corner = cell * (size_ + k_gap_px);
  for (int row = 0; row < size_.y; ++row) {
    const auto from = rgb.begin() + 3 * std::ptrdiff_t(row) * size_.x;
    std::copy_n(from, 3 * size_.x, rgb_.begin() + 3 * (std::ptrdiff_t(corner.y + row) * pixels_.x + corner.x));
  }
  ++placed_;
  ++next_;
}

Expected<void> ContactSheet::save(const std::string& path) const {
  return save_picture(path, pixels_.x, pixels_.y, rgb_);
}

}  // namespace sward::tool
