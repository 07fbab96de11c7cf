// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/frame.h>
#include <sward/gl/handles.h>
#include <sward/gl/shader_library.h>
#include <sward/vegetation/mesh_surface.h>
#include <sward/vegetation/species.h>

namespace sward {

/// Draws the body of a MeshSurface, so that what is seen between its plants is dark and not the sky: near by half of
/// the light of the mesh's own colour, with distance all of it, as the plants melt into that. Owns its program and
/// vertices. GL thread.
class SWARD_API MeshRenderer {
 public:
  /// Uploads a copy. `layer` is the one that covers the surface. Fails on a shader's error and on a GL below 4.5.
  static Expected<MeshRenderer> create(const MeshSurface& surface, const Layer& layer, const gl::ShaderLibrary& shaders,
                                       const gl::Bindings& bindings = {});

  /// Draws into the bound framebuffer; the host chooses depth test and mask, and culls no faces, or back faces of closed
  /// bodies. Binds: program, vertex array, uniform buffer frame. Leaves all three 0.
  void draw(const View& view, const gl::Frame& frame);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;

 private:
  MeshRenderer() = default;

  gl::HomeContext home_;
  gl::Program program_;
  gl::Buffer vertices_;
  gl::VertexArray vertex_array_;
  gl::Bindings bindings_;
  glm::dvec3 origin_{0};
  float horizon_m_ = 1;
  GLsizei count_ = 0;
};

}  // namespace sward
