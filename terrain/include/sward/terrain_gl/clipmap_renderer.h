// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/clipmap.h>
#include <sward/gl/frame.h>
#include <sward/gl/ground.h>
#include <sward/gl/shader_library.h>
#include <vector>

namespace sward {

/// Draws clipmap rings with the shading of TerrainRenderer. GL thread.
class SWARD_API ClipmapRenderer {
 public:
  /// Fails on a shader's error and on a GL below 4.5. Leaves all state as it was.
  static Expected<ClipmapRenderer> create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});

  /// Draws the blocks of the rings that may be seen into the bound framebuffer with one indexed, instanced draw, after
  /// a follow() for this view. Binds: program, vertex array, uniform buffers bindings.frame, bindings.clipmap,
  /// bindings.materials, bindings.disturbance, textures bindings.base_map, bindings.slope_map, bindings.detail,
  /// bindings.detail_slope, bindings.disturbance_map, bindings.clipmap_heights, bindings.clipmap_relief. Sets nothing
  /// else; the host chooses as with TerrainRenderer::draw(). Leaves: program 0, vertex array 0, those texture units,
  /// their samplers and those uniform buffer bindings 0. The view must be valid (asserted). Cost: 16 bytes a block are
  /// written, some hundred blocks.
  void draw(const View& view, const gl::Clipmap& clipmap, const gl::Frame& frame, const gl::GroundTextures& ground);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  uint32_t triangles() const;  ///< Of the last draw, those included that the finer ring covers.
  uint32_t blocks() const { return uint32_t(blocks_.size()); }

 private:
  gl::HomeContext home_;
  gl::Bindings bindings_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer indices_, instances_;
  size_t capacity_ = 0;
  std::vector<ClipmapRings::Block> blocks_;
  std::vector<glm::ivec4> instance_data_;
};

}  // namespace sward
