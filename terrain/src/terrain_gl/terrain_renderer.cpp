// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain_gl/terrain_renderer.h>

#include <algorithm>
#include <cstddef>

namespace sward {

namespace {

/// Uniform locations of terrain.vert.glsl and terrain.frag.glsl.
enum Location : GLint { k_origin_from_eye = 0, k_base_map_transform, k_slope_map_transform, k_data_rectangle };

/// Changed slots that lie at most this far apart are uploaded in one run: a call costs more than some vertices.
constexpr uint32_t k_joined_gap = 24;
/// Least capacity of the buffers, elements.
constexpr size_t k_least_capacity = 4096;

size_t grown(size_t capacity, size_t needed) {
  return capacity >= needed ? capacity : std::max({needed, capacity + capacity / 2, k_least_capacity});
}

/// Takes positions relative to the eye to texture coordinates of a map whose v counts from the north: uv = xy * p + zw.
glm::vec4 map_transform(const glm::dvec3& eye, const glm::dvec2& map_min, const glm::dvec2& map_size) {
  return {1.0 / map_size.x, -1.0 / map_size.y, (eye.x - map_min.x) / map_size.x,
          (map_min.y + map_size.y - eye.y) / map_size.y};
}

void set_vec4(const gl::Program& program, Location location, const glm::vec4& value) {
  glProgramUniform4f(program.id(), location, value.x, value.y, value.z, value.w);
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
  return renderer;
}

size_t TerrainRenderer::upload(const RoamMesh& mesh) {
  if (mesh.revision() == revision_) return 0;
  const size_t written = upload_vertices(mesh) + upload_indices(mesh.visible_indices());
  origin_ = mesh.origin();
  revision_ = mesh.revision();
  return written;
}

size_t TerrainRenderer::upload_vertices(const RoamMesh& mesh) {
  const std::span<const RoamVertex> vertices = mesh.vertices();
  const auto write = [&](size_t first, size_t count) {
    glNamedBufferSubData(vertices_.id(), GLintptr(first * sizeof(RoamVertex)), GLsizeiptr(count * sizeof(RoamVertex)),
                         vertices.data() + first);
    return count * sizeof(RoamVertex);
  };
  const size_t capacity = grown(vertex_capacity_, vertices.size());
  if (capacity != vertex_capacity_) {
    vertices_ = gl::create_buffer();
    vertex_capacity_ = capacity;
    glNamedBufferStorage(vertices_.id(), GLsizeiptr(capacity * sizeof(RoamVertex)), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glVertexArrayVertexBuffer(vertex_array_.id(), 0, vertices_.id(), 0, sizeof(RoamVertex));
    return vertices.empty() ? 0 : write(0, vertices.size());
  }
  if (vertices.empty()) return 0;
  if (mesh.all_vertices_changed() || mesh.revision() != revision_ + 1) return write(0, vertices.size());

  // Neighbouring slots go in one run.
  const std::span<const uint32_t> changed = mesh.changed_vertices();
  slots_.assign(changed.begin(), changed.end());
  std::ranges::sort(slots_);
  size_t written = 0;
  for (size_t first = 0; first < slots_.size();) {
    size_t last = first;
    while (last + 1 < slots_.size() && slots_[last + 1] - slots_[last] <= k_joined_gap) ++last;
    written += write(slots_[first], slots_[last] - slots_[first] + 1);
    first = last + 1;
  }
  return written;
}

size_t TerrainRenderer::upload_indices(std::span<const uint32_t> indices) {
  index_count_ = uint32_t(indices.size());
  if (indices.empty()) return 0;
  const size_t capacity = grown(index_capacity_, indices.size());
  if (!indices_) {
    indices_ = gl::create_buffer();
    glVertexArrayElementBuffer(vertex_array_.id(), indices_.id());
  }
  // Fresh storage each time, so that the driver need not wait for the frames that still read the old one.
  index_capacity_ = capacity;
  glNamedBufferData(indices_.id(), GLsizeiptr(capacity * sizeof(uint32_t)), nullptr, GL_STREAM_DRAW);
  glNamedBufferSubData(indices_.id(), 0, GLsizeiptr(indices.size_bytes()), indices.data());
  return indices.size_bytes();
}

void TerrainRenderer::draw(const View& view, const gl::Frame& frame, const gl::GroundTextures& ground) {
  if (index_count_ == 0) return;
  const glm::vec3 origin_from_eye(origin_ - view.eye);
  const glm::dvec2 eye(view.eye);
  glProgramUniform3f(program_.id(), k_origin_from_eye, origin_from_eye.x, origin_from_eye.y, origin_from_eye.z);
  set_vec4(program_, k_base_map_transform, map_transform(view.eye, ground.map_min(), ground.map_size()));
  set_vec4(program_, k_slope_map_transform, map_transform(view.eye, ground.field_min(), ground.field_size()));
  set_vec4(program_, k_data_rectangle,
           glm::vec4(glm::vec2(ground.data_min() - eye), glm::vec2(ground.data_max() - eye)));

  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  glBindTextureUnit(bindings_.base_map, ground.base_map());
  glBindTextureUnit(bindings_.slope_map, ground.slope_map());
  glDrawElements(GL_TRIANGLES, GLsizei(index_count_), GL_UNSIGNED_INT, nullptr);
  glBindTextureUnit(bindings_.slope_map, 0);
  glBindTextureUnit(bindings_.base_map, 0);
  bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward
