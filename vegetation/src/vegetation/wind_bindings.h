// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/bindings.h>
#include <sward/vegetation/wind_textures.h>

namespace sward {

/// Binds a wind for growth and leaves zeros behind. Without one it touches nothing.
class WindBindings {
 public:
  /// Both must outlive it.
  WindBindings(const gl::Bindings& bindings, const WindTextures* wind);
  ~WindBindings();
  WindBindings(const WindBindings&) = delete;
  WindBindings& operator=(const WindBindings&) = delete;

 private:
  const gl::Bindings& bindings_;
  bool bound_;
};

}  // namespace sward
