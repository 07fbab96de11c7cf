// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace sward::tool {

/// Pipes frames into ffmpeg, which is looked for in PATH. The video appears under its name only when it is complete.
class VideoPipe {
 public:
  /// Fails when there is no ffmpeg.
  static Expected<VideoPipe> open(const std::string& path, glm::ivec2 size, double fps);
  VideoPipe(VideoPipe&& other) noexcept;
  VideoPipe& operator=(VideoPipe&&) = delete;
  /// An unfinished video is deleted.
  ~VideoPipe();

  /// 8-bit RGB rows, top first.
  Expected<void> write(const std::vector<uint8_t>& rgb);
  /// Waits for ffmpeg and gives the file its name.
  Expected<void> finish();

 private:
  VideoPipe() = default;
  int wait_for_exit();
  std::string path_, temporary_;
  int pipe_ = -1;
  int process_ = -1;
};

/// Where `program` stands in PATH; empty when it does not.
std::string find_program(const std::string& program);

}  // namespace sward::tool
