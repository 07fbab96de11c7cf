// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain_gl/terrain_renderer.h>

#include <cstddef>

namespace sward {

namespace {

/// Uniform locations of terrain.vert.glsl and terrain.frag.glsl.
enum Location : GLint {
  k_origin_from_eye = 0,
  k_base_map_transform,
  k_slope_windows,
  k_data_rectangle,
  k_morph_time,
  k_slope_map_transform
};

/// Takes positions relative to the eye to texture coordinates of a map whose v counts from the north: uv = xy * p + zw.
glm::vec4 map_transform(const glm::dvec3& eye, const glm::dvec2& map_min, const glm::dvec2& map_size) {
  return {1.0 / map_size.x, -1.0 / map_size.y, (eye.x - map_min.x) / map_size.x,
          (map_min.y + map_size.y - eye.y) / map_size.y};
}

void set_vec4(const gl::Program& program, Location location, const glm::vec4& value) {
  glProgramUniform4f(program.id(), location, value.x, value.y, value.z, value.w);
}

void set_slopes(const gl::Program& program, const glm::dvec3& eye, const gl::SlopeMap& slopes) {
  for (int layer = 0; layer < slopes.layers(); ++layer) {
    const glm::dvec2 size = slopes.layer_size(layer), from_min = glm::dvec2(eye) - slopes.layer_min(layer);
    glm::dvec2 place(from_min.x / size.x, 1.0 - from_min.y / size.y);
    // Windows repeat: whole periods are left out before precision is.
    if (slopes.repeats()) place = glm::fract(place);
    glProgramUniform4f(program.id(), k_slope_map_transform + layer, float(1.0 / size.x), float(-1.0 / size.y),
                       float(place.x), float(place.y));
  }
  const glm::dvec2 spacing = slopes.spacing();
  glProgramUniform4f(program.id(), k_slope_windows, float(1.0 / spacing.x), float(1.0 / spacing.y),
                     float(slopes.reach()), float(slopes.layers()));
}

/// Binds a uniform buffer to its index alone: glBindBufferBase would change the general binding as well.
void bind_uniforms(GLuint index, GLuint buffer) {
  glBindBuffersBase(GL_UNIFORM_BUFFER, index, 1, &buffer);
}

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
  if (mesh.revision() == revision_) return 0;
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
  if (index_count_ == 0) return;
  const glm::vec3 origin_from_eye(origin_ - view.eye);
  const glm::dvec2 eye(view.eye);
  glProgramUniform3f(program_.id(), k_origin_from_eye, origin_from_eye.x, origin_from_eye.y, origin_from_eye.z);
  set_vec4(program_, k_base_map_transform, map_transform(view.eye, ground.map_min(), ground.map_size()));
  set_slopes(program_, view.eye, ground.slopes());
  set_vec4(program_, k_data_rectangle,
           glm::vec4(glm::vec2(ground.data_min() - eye), glm::vec2(ground.data_max() - eye)));

  glProgramUniform1f(program_.id(), k_morph_time, morph_time_);
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  glBindTextureUnit(bindings_.base_map, ground.base_map());
  glBindTextureUnit(bindings_.slope_map, ground.slopes().texture());
  glBindTextureUnit(bindings_.detail, ground.detail());
  glBindTextureUnit(bindings_.detail_slope, ground.detail_slope());
  bind_uniforms(bindings_.materials, ground.materials());
  glDrawElements(GL_TRIANGLES, GLsizei(index_count_), GL_UNSIGNED_INT, nullptr);
  bind_uniforms(bindings_.materials, 0);
  glBindTextureUnit(bindings_.detail_slope, 0);
  glBindTextureUnit(bindings_.detail, 0);
  glBindTextureUnit(bindings_.slope_map, 0);
  glBindTextureUnit(bindings_.base_map, 0);
  bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward
