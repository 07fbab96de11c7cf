// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain_gl/terrain_renderer.h>

#include <cstddef>

#include "terrain/usable_view.h"
#include "terrain_gl/ground_shading.h"

namespace sward {

namespace {

/// Uniform locations of terrain.vert.glsl.
enum Location : GLint { k_origin_from_eye = 0, k_morph_time = 4 };

}  // namespace

Expected<TerrainRenderer> TerrainRenderer::create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  gl::ProgramDesc desc;
  desc.name = "terrain";
  desc.vertex = "terrain.vert.glsl";
  desc.fragment = "terrain.frag.glsl";
  desc.defines = gl::binding_defines(bindings);
  Expected<gl::Program> program = shaders.build(desc);
  if (!program) return tl::unexpected(program.error());

  TerrainRenderer renderer;
  renderer.home_ = gl::HomeContext::of_current();
  renderer.vertices_ = SlotBuffer(sizeof(RoamVertex));
  renderer.triangles_ = SlotBuffer(3 * sizeof(uint32_t));
  renderer.bindings_ = bindings;
  renderer.program_ = std::move(*program);
  renderer.vertex_array_ = gl::create_vertex_array();
  const GLuint vertex_array = renderer.vertex_array_.id();
  glEnableVertexArrayAttrib(vertex_array, 0);
  glVertexArrayAttribFormat(vertex_array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(RoamVertex, position));
  glVertexArrayAttribBinding(vertex_array, 0, 0);
  glEnableVertexArrayAttrib(vertex_array, 1);
  glVertexArrayAttribFormat(vertex_array, 1, 2, GL_FLOAT, GL_FALSE, offsetof(RoamVertex, relief_gradient));
  glVertexArrayAttribBinding(vertex_array, 1, 0);
  glEnableVertexArrayAttrib(vertex_array, 2);
  glVertexArrayAttribFormat(vertex_array, 2, 3, GL_FLOAT, GL_FALSE, offsetof(RoamVertex, from_z));
  glVertexArrayAttribBinding(vertex_array, 2, 0);
  return renderer;
}

size_t TerrainRenderer::upload(const RoamMesh& mesh) {
  if (!home_.here("TerrainRenderer::upload") || mesh.revision() == revision_) return 0;
  const bool follows = mesh.revision() == revision_ + 1;
  size_t written = 0;
  if (vertices_.fit(mesh.vertices().size())) {
    glVertexArrayVertexBuffer(vertex_array_.id(), 0, vertices_.id(), 0, sizeof(RoamVertex));
    written += vertices_.write_all(mesh.vertices().data(), mesh.vertices().size());
  } else if (mesh.all_vertices_changed() || !follows) {
    written += vertices_.write_all(mesh.vertices().data(), mesh.vertices().size());
  } else {
    written += vertices_.write_slots(mesh.vertices().data(), mesh.vertices().size(), mesh.changed_vertices());
  }
  const std::span<const uint32_t> indices = mesh.visible_indices();
  const size_t triangles = indices.size() / 3;
  if (triangles_.fit(triangles)) {
    glVertexArrayElementBuffer(vertex_array_.id(), triangles_.id());
    written += triangles_.write_all(indices.data(), triangles);
  } else if (!follows) {
    written += triangles_.write_all(indices.data(), triangles);
  } else {
    written += triangles_.write_slots(indices.data(), triangles, mesh.changed_triangles());
  }
  index_count_ = uint32_t(indices.size());
  origin_ = mesh.origin();
  morph_time_ = mesh.morph_time();
  revision_ = mesh.revision();
  return written;
}

void TerrainRenderer::draw(const View& view, const gl::Frame& frame, const gl::GroundTextures& ground) {
  if (!home_.here("TerrainRenderer::draw") || !usable(view, "TerrainRenderer::draw") || index_count_ == 0) return;
  const glm::vec3 origin_from_eye(origin_ - view.eye);
  glProgramUniform3f(program_.id(), k_origin_from_eye, origin_from_eye.x, origin_from_eye.y, origin_from_eye.z);
  glProgramUniform1f(program_.id(), k_morph_time, morph_time_);
  const GroundShading shading(program_, bindings_, view, frame, ground);
  glBindVertexArray(vertex_array_.id());
  glDrawElements(GL_TRIANGLES, GLsizei(index_count_), GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

size_t TerrainRenderer::gpu_bytes() const {
  return vertices_.gpu_bytes() + triangles_.gpu_bytes();
}

}  // namespace sward
