// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What a VegetationRenderer keeps on the GPU.
#include <sward/gl/bindings.h>
#include <sward/gl/disturbed_ground.h>
#include <sward/gl/handles.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/vegetation/seeding.h>
#include <array>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "vegetation/layer_params.h"

namespace sward {

/// Mirror of `SwardSpecies` in shaders/common_layer.glsl, std140.
struct SpeciesBlock {
  shared::LayerParams layer{};
  std::array<shared::SpeciesParams, k_max_species> species{};
};
static_assert(sizeof(shared::LayerParams) == 5 * 16);
static_assert(sizeof(shared::SpeciesParams) == 15 * 16);
static_assert(sizeof(SpeciesBlock) == sizeof(shared::LayerParams) + k_max_species * sizeof(shared::SpeciesParams));
static_assert(sizeof(SpeciesBlock) <= 16384, "the smallest GL_MAX_UNIFORM_BLOCK_SIZE");

/// A frame's triangle records, surface nodes and excluded shapes: one buffer of three regions written in turn, so that
/// a write never meets a frame that the GPU still reads; three buffer textures look at the region written last.
/// ```
///  region 0                  region 1                  region 2
///  | records | pad | nodes | pad | shapes | | records | ...       pad: to GL_TEXTURE_BUFFER_OFFSET_ALIGNMENT
/// ```
class TriangleBuffers {
 public:
  static TriangleBuffers create();
  /// Fails when the device's buffer textures cannot hold either.
  Expected<void> write(std::span<const TriangleRecord> records, std::span<const SurfaceNode> nodes,
                       std::span<const glm::vec4> exclusions);
  GLuint records() const { return records_.id(); }
  GLuint surface() const { return surface_.id(); }
  GLuint exclusions() const { return exclusions_.id(); }
  size_t gpu_bytes() const { return gl::storage_bytes(buffer_); }

 private:
  void reserve(size_t region_bytes);

  gl::Buffer buffer_;
  gl::Texture records_, surface_, exclusions_;
  size_t region_bytes_ = 0;
  size_t region_ = 0;
  size_t alignment_ = 256;
  size_t max_texels_ = 65536;
};

/// What the stages read triangles and the drawn surface from: a frame's uploaded buffers, or what was seeded on the GPU
/// over a clipmap. Names of objects that others own.
class TriangleTextures {
 public:
  struct Clipmap {
    GLuint block = 0, heights = 0;  ///< 0: the surface comes as nodes.
  };
  TriangleTextures() = default;
  explicit TriangleTextures(const TriangleBuffers& buffers)
      : records_(buffers.records()), surface_(buffers.surface()), exclusions_(buffers.exclusions()) {}
  TriangleTextures(GLuint records, GLuint exclusions, Clipmap clipmap)
      : records_(records), exclusions_(exclusions), clipmap_(clipmap) {}
  GLuint records() const { return records_; }
  GLuint surface() const { return surface_; }
  GLuint exclusions() const { return exclusions_; }
  Clipmap clipmap() const { return clipmap_; }

 private:
  GLuint records_ = 0, surface_ = 0, exclusions_ = 0;
  Clipmap clipmap_;
};

inline constexpr int k_streams = 4;
/// Bytes of a fed-back cluster: record, cluster, s', z.
inline constexpr size_t k_cluster_bytes = 16;

/// The feedback buffers of one pass of classification: a stream each for up to four species.
class FeedbackPass {
 public:
  /// `used`: streams that a species feeds, 1..4; the rest get the least that GL allows.
  static FeedbackPass create(int used);
  /// Every used stream holds this many clusters from now on, or more.
  void reserve(size_t clusters);
  GLuint id() const { return feedback_.id(); }
  GLuint stream(int index) const { return streams_[size_t(index)].id(); }
  size_t gpu_bytes() const;

 private:
  void allocate(int stream, size_t clusters);

  gl::Feedback feedback_;
  std::array<gl::Buffer, k_streams> streams_;
  size_t capacity_ = 0;
  int used_ = 0;
};

/// Binds the uniform buffers and textures of a stage and leaves zeros behind.
class StageBindings {
 public:
  struct Unit {
    GLuint unit, texture;
  };
  StageBindings(const gl::Bindings& bindings, GLuint frame, GLuint species, std::initializer_list<Unit> units,
                TriangleTextures::Clipmap clipmap = {});
  ~StageBindings();
  StageBindings(const StageBindings&) = delete;
  StageBindings& operator=(const StageBindings&) = delete;

 private:
  const gl::Bindings& bindings_;
  std::array<GLuint, 16> units_{};
  size_t count_ = 0;
  bool clipmap_ = false;
};

/// Binds what has touched the ground and leaves zeros behind.
class DisturbedBindings {
 public:
  DisturbedBindings(const gl::Bindings& bindings, const gl::DisturbedGround& disturbed);
  ~DisturbedBindings();
  DisturbedBindings(const DisturbedBindings&) = delete;
  DisturbedBindings& operator=(const DisturbedBindings&) = delete;

 private:
  const gl::Bindings& bindings_;
};

/// A buffer of fixed size without a mapping; `flags` as for glNamedBufferStorage.
gl::Buffer make_buffer(size_t bytes, const void* data, GLbitfield flags);

}  // namespace sward
