// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace sward::tool {

/// Frames of a flight side by side in one picture, in rows of about the shape of a screen: what moves can be looked at
/// without a player.
class ContactSheet {
 public:
  /// `shown` of `frames` frames of `size` pixels, evenly spread, the first among them; all where there are fewer.
  ContactSheet(glm::ivec2 size, size_t frames, size_t shown);

  /// The next frame, 8-bit RGB rows, top first; frames that are not shown cost nothing.
  bool wants_next() const;
  void add(const std::vector<uint8_t>& rgb);
  void skip() { ++next_; }

  Expected<void> save(const std::string& path) const;

 private:
  glm::ivec2 size_, grid_, pixels_;
  size_t frames_, shown_;
  size_t next_ = 0, placed_ = 0;
  std::vector<uint8_t> rgb_;
};

}  // namespace sward::tool
