// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/frame.h>
#include <sward/gl/ground.h>
#include <sward/gl/shader_library.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain_gl/slot_buffer.h>

namespace sward {

/// Draws a RoamMesh: base map, sun, ambient light, haze. GL thread.
class SWARD_API TerrainRenderer {
 public:
  /// Fails on a shader's error and on a GL below 4.5. Leaves all state as it was.
  static Expected<TerrainRenderer> create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});

  /// Copies what changed in the mesh since its last update into the GPU's buffers. Call once after each update: after
  /// a skipped one, or for another mesh, everything is uploaded; a second call writes nothing. Binds nothing. Returns
  /// bytes written: those of the changed slots.
  size_t upload(const RoamMesh& mesh);

  /// Draws the visible leaves into the bound framebuffer with one indexed draw.
  /// Binds: program, vertex array, uniform buffers bindings.frame, bindings.materials,
  /// bindings.disturbance, textures bindings.base_map, bindings.slope_map, bindings.detail, bindings.detail_slope,
  /// bindings.disturbance_map.
  /// Sets: nothing else; the host chooses depth test (GL_LESS, GL_LEQUAL or reversed), culling, blending, masks, and
  /// has GL_PRIMITIVE_RESTART off.
  /// Leaves: program 0, vertex array 0, those texture units, their samplers and uniform buffer bindings 0.
  /// Padding around the data is discarded. `view` must be the one that the frame was filled with, and valid (asserted).
  /// Draws nothing before the first upload.
  void draw(const View& view, const gl::Frame& frame, const gl::GroundTextures& ground);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  /// Triangles of the last upload.
  uint32_t triangles() const { return index_count_ / 3; }

 private:
  gl::HomeContext home_;
  gl::Bindings bindings_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  SlotBuffer vertices_, triangles_;
  uint32_t index_count_ = 0;
  uint64_t revision_ = 0;  ///< Of the mesh's state that the buffers hold; 0: none.
  float morph_time_ = 0;
  glm::dvec3 origin_{0};
};

}  // namespace sward
