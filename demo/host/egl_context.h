// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <memory>
#include <string>
#include <vector>

namespace sward::host {

/// A GL 4.5 core context without a window or display: EGL device platform, else surfaceless. Move-only.
class EglContext {
 public:
  /// Makes the context current on the calling thread. `debug` asks for a debug context and records every message.
  /// Errors say what EGL or the driver lacks.
  static Expected<EglContext> create(bool debug);
  /// A further one that shares objects with `other`, for a thread that prepares what another draws. Current nowhere.
  static Expected<EglContext> create_shared(const EglContext& other);
  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;
  ~EglContext();

  /// On the calling thread; false where EGL refuses. Current on one thread at a time.
  bool make_current();
  /// Nothing is current on the calling thread afterwards.
  void release_current();

  /// Debug messages above notification severity since the last call ("severity type id: text").
  std::vector<std::string> take_messages();

 private:
  struct Impl;
  explicit EglContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward::host
