// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/progress.h"

#include <unistd.h>

#include <cstdio>

namespace sward::tool {

ProgressLine::ProgressLine(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(float done) {
  const int percent = int(done * 100);
  if (!terminal_ || percent == shown_percent_) return;
  shown_percent_ = percent;
  std::fprintf(stderr, "\r\033[K%s: %d %%", what_.c_str(), percent);
}

Progress ProgressLine::callback() {
  if (!terminal_) return {};
  return [this](float done) { show(done); };
}

}  // namespace sward::tool
