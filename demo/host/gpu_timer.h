// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/handles.h>
#include <array>
#include <optional>

namespace sward::host {

/// Time that the GPU spends on one part of each frame, by a ring of queries, so that reading never stalls unless asked
/// to. GL thread; parts must not overlap.
class GpuTimer {
 public:
  /// `enabled` false measures nothing.
  explicit GpuTimer(bool enabled);

  void begin();
  void end();
  /// Milliseconds of the newest part that has arrived; with `wait`, of the last one.
  std::optional<double> milliseconds(bool wait);

 private:
  bool enabled_;
  std::array<gl::Query, 4> queries_;
  size_t begun_ = 0;  // parts begun so far
  size_t read_ = 0;   // parts whose results were taken
  std::optional<double> newest_;
};

}  // namespace sward::host
