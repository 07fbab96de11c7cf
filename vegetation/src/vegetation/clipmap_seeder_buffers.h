// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What a ClipmapSeeder keeps on the GPU, as shaders/common_seeding.glsl declares it.
#include <sward/gl/handles.h>
#include <sward/vegetation/seeding.h>
#include <array>
#include <cstddef>

#include "vegetation/clipmap_table.h"

namespace sward {

/// Mirror of `SwardSeeding`, std140.
struct SeedingUniforms {
  glm::dvec2 origin{0}, spacing{1}, middle{0}, eye_xy{0}, scale{1, 0};
  std::array<glm::vec4, 6> plane{};
  glm::mat4 clip{1};
  glm::ivec4 window{0}, cell{0}, level{0};
  glm::vec4 law{0}, reach{0}, view{0};
};
static_assert(offsetof(SeedingUniforms, plane) == 80);
static_assert(offsetof(SeedingUniforms, clip) == 176);
static_assert(offsetof(SeedingUniforms, window) == 240);
static_assert(offsetof(SeedingUniforms, law) == 288);
static_assert(sizeof(SeedingUniforms) == 336);

struct DrawCommand {
  uint32_t count = 0, instance_count = 0, first = 0, base_instance = 0;
};

/// Mirror of `SwardSeedFrame`, std430.
struct SeedFrame {
  uint32_t n_min = UINT32_MAX, n_max = 0, seeded = 0, visible = 0;
  uint32_t clusters = 0, unused[3] = {};
  std::array<float, k_density_bins> edges{};
  std::array<DrawCommand, k_density_bins> commands{};
};
static_assert(offsetof(SeedFrame, edges) == 32);
static_assert(offsetof(SeedFrame, commands) == 160);

inline constexpr int k_seed_group = 256;  ///< Candidates of a work group.

SeedingUniforms make_seeding_uniforms(const Layer& layer, const View& view, const Lattice& lattice,
                                      const ClipmapTable& table);

/// A buffer that grows, and a buffer texture that looks at all of it.
struct TexelBuffer {
  gl::Buffer buffer;
  gl::Texture texture;
  size_t bytes = 0;
  /// Makes room; true when that took a new buffer, whose contents are undefined.
  bool fit(size_t needed, GLenum format);
};

/// Numbers of a frame on their way back, three frames at a time, so that nothing waits for them.
class SeedFrameReadBack {
 public:
  static SeedFrameReadBack create();
  ~SeedFrameReadBack();
  SeedFrameReadBack() = default;
  SeedFrameReadBack(SeedFrameReadBack&& other) noexcept { swap(other); }
  SeedFrameReadBack& operator=(SeedFrameReadBack&& other) noexcept {
    swap(other);
    return *this;
  }
  /// Asks for the first `k_bytes` of a buffer.
  void request(GLuint buffer);
  size_t gpu_bytes() const { return gl::storage_bytes(buffer_); }
  using Head = std::array<uint32_t, 8>;  ///< SeedFrame up to its edges.
  /// The newest frame that has arrived; `wait` blocks for the last one requested.
  Head newest(bool wait);

 private:
  static constexpr size_t k_frames = 3, k_bytes = sizeof(Head);
  void swap(SeedFrameReadBack& other) noexcept;
  void collect(size_t slot, bool wait);

  gl::Buffer buffer_;
  const std::byte* mapped_ = nullptr;
  std::array<GLsync, k_frames> fences_{};
  size_t next_ = 0;
  Head newest_{};
};

}  // namespace sward
