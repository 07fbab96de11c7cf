// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <string>

namespace sward::tool {

/// One line of progress on stderr, redrawn in place and wiped at the end; silent unless stderr is a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(float done);
  /// For the library's long calls; valid while the line lives.
  Progress callback();

 private:
  std::string what_;
  bool terminal_;
  int shown_percent_ = -1;
};

}  // namespace sward::tool
