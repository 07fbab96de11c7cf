// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/handles.h>
#include <sward/vegetation/wind.h>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sward {

/// A Wind on the GPU, for shaders/common_wind.glsl. GL thread. Whoever draws with it binds block() to
/// Bindings::wind, maps(), grid() and painted() to the units of these names.
class SWARD_API WindTextures {
 public:
  /// Still air, until the first upload. Fails on a GL below 4.5. About 0.8 MB of textures. Leaves all state as it was.
  static Expected<WindTextures> create();

  /// What an upload sent.
  struct Upload {
    int rows = 0;          ///< Of the movers' grids.
    size_t bytes = 0;      ///< With the uniforms.
    bool painted = false;  ///< A new painted map went along.
  };
  /// The wind as it is, for a view from `eye`: the uniforms, and the rows of the grids that have changed since. Binds
  /// nothing; leaves all state as it was and asks GL for pixel-store state only when it has texels to send.
  Upload upload(const Wind& wind, glm::dvec3 eye);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  GLuint block() const { return block_.id(); }      ///< Uniform buffer of SwardWind.
  GLuint maps() const { return maps_.id(); }        ///< RGBA8 2D array: gusts, noise.
  GLuint grid() const { return grid_.id(); }        ///< RG16F 2D array: fine, coarse; m/s.
  GLuint painted() const { return painted_.id(); }  ///< RG16F 2D; (1, 0) without a map.

 private:
  WindTextures() = default;

  gl::HomeContext home_;
  gl::Buffer block_;
  gl::Texture maps_, grid_, painted_;
  // Of what was uploaded last.
  uint64_t wind_ = 0;                 // whose it was
  std::array<uint64_t, 2> stamps_{};  // of its grids
  uint64_t painting_ = 0;             // of its painted map
};

}  // namespace sward
