// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain_gl/clipmap_renderer.h>

#include <algorithm>
#include <cstdint>

#include "gl/bind.h"
#include "terrain/usable_view.h"
#include "terrain_gl/ground_shading.h"

namespace sward {

namespace {

constexpr int k_cells = ClipmapRings::k_block_cells;
constexpr int k_indices = 6 * k_cells * k_cells;

/// Two triangles a cell, counter-clockwise from above (rows run south), cut as the bintree cuts them; a block begins at
/// a cell with even indices.
std::vector<uint16_t> block_indices() {
  std::vector<uint16_t> out;
  out.reserve(k_indices);
  const auto point = [](int column, int row) { return uint16_t(row * (k_cells + 1) + column); };
  for (int row = 0; row < k_cells; ++row)
    for (int column = 0; column < k_cells; ++column) {
      const uint16_t nw = point(column, row), ne = point(column + 1, row);
      const uint16_t sw = point(column, row + 1), se = point(column + 1, row + 1);
      if ((column + row) % 2 == 0) {
        out.insert(out.end(), {nw, se, ne, nw, sw, se});
      } else {
        out.insert(out.end(), {nw, sw, ne, se, ne, sw});
      }
    }
  return out;
}

}  // namespace

Expected<ClipmapRenderer> ClipmapRenderer::create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  gl::ProgramDesc desc;
  desc.name = "terrain clipmap";
  desc.vertex = "terrain_clipmap.vert.glsl";
  desc.fragment = "terrain.frag.glsl";
  desc.defines = gl::binding_defines(bindings);
  Expected<gl::Program> program = shaders.build(desc);
  if (!program) return tl::unexpected(program.error());

  ClipmapRenderer renderer;
  renderer.home_ = gl::HomeContext::of_current();
  renderer.bindings_ = bindings;
  renderer.program_ = std::move(*program);
  const std::vector<uint16_t> indices = block_indices();
  renderer.indices_ = gl::create_buffer();
  glNamedBufferStorage(renderer.indices_.id(), GLsizeiptr(indices.size() * sizeof(uint16_t)), indices.data(), 0);
  renderer.vertex_array_ = gl::create_vertex_array();
  const GLuint array = renderer.vertex_array_.id();
  glEnableVertexArrayAttrib(array, 0);
  glVertexArrayAttribIFormat(array, 0, 4, GL_INT, 0);
  glVertexArrayAttribBinding(array, 0, 0);
  glVertexArrayBindingDivisor(array, 0, 1);
  glVertexArrayElementBuffer(array, renderer.indices_.id());
  return renderer;
}

uint32_t ClipmapRenderer::triangles() const {
  return uint32_t(blocks_.size()) * uint32_t(k_indices / 3);
}

void ClipmapRenderer::draw(const View& view, const gl::Clipmap& clipmap, const gl::Frame& frame,
                           const gl::GroundTextures& ground) {
  if (!home_.here("ClipmapRenderer::draw") || !usable(view, "ClipmapRenderer::draw")) return;
  clipmap.rings().visible_blocks(view, blocks_);
  if (blocks_.empty()) return;
  instance_data_.clear();
  for (const ClipmapRings::Block& block : blocks_)
    instance_data_.emplace_back(block.ring, block.place * k_cells, k_cells);
  if (instance_data_.size() > capacity_) {
    capacity_ = instance_data_.size() + instance_data_.size() / 2;
    instances_ = gl::create_buffer();
    glNamedBufferStorage(instances_.id(), GLsizeiptr(capacity_ * sizeof(glm::ivec4)), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glVertexArrayVertexBuffer(vertex_array_.id(), 0, instances_.id(), 0, sizeof(glm::ivec4));
  }
  glNamedBufferSubData(instances_.id(), 0, GLsizeiptr(instance_data_.size() * sizeof(glm::ivec4)),
                       instance_data_.data());

  const GroundShading shading(program_, bindings_, view, frame, ground);
  gl::bind_uniforms(bindings_.clipmap, clipmap.block());
  const GLuint units[] = {bindings_.clipmap_heights, bindings_.clipmap_relief};
  const GLuint textures[] = {clipmap.heights(), clipmap.relief()};
  for (int i = 0; i < 2; ++i) gl::bind_texture(units[i], textures[i]);
  glBindVertexArray(vertex_array_.id());
  glDrawElementsInstanced(GL_TRIANGLES, k_indices, GL_UNSIGNED_SHORT, nullptr, GLsizei(blocks_.size()));
  glBindVertexArray(0);
  for (const GLuint unit : units) glBindTextureUnit(unit, 0);
  gl::bind_uniforms(bindings_.clipmap, 0);
}

size_t ClipmapRenderer::gpu_bytes() const {
  return gl::storage_bytes(indices_) + gl::storage_bytes(instances_);
}

}  // namespace sward
