// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/mesh_renderer.h>

#include <cstddef>

#include "gl/bind.h"
#include "terrain/usable_view.h"
#include "vegetation/vegetation_renderer_buffers.h"

namespace sward {

namespace {

enum Location : GLint { k_origin_from_eye = 0, k_body_cover };

/// Share of the light that comes to the body between the plants.
constexpr float k_light_between = 0.5f;

struct BodyVertex {
  glm::vec3 position, normal;
  glm::u8vec4 color;
};

/// Faces are flat: each has its own corners. Those left out are skipped.
std::vector<BodyVertex> body_vertices(const MeshSurface& surface, const glm::dvec3& origin) {
  const std::span<const glm::dvec3> corners = surface.corners();
  std::vector<BodyVertex> vertices;
  vertices.reserve(corners.size());
  for (size_t i = 0; i < corners.size(); i += 3) {
    const glm::dvec3 normal = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
    if (normal == glm::dvec3(0)) continue;
    for (size_t corner = i; corner < i + 3; ++corner) {
      vertices.push_back({glm::vec3(corners[corner] - origin), glm::vec3(glm::normalize(normal)),
                          glm::u8vec4(surface.colors()[corner], 255)});
    }
  }
  return vertices;
}

gl::VertexArray make_body_array(GLuint buffer) {
  gl::VertexArray array = gl::create_vertex_array();
  const GLuint id = array.id();
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    glEnableVertexArrayAttrib(id, attribute);
    glVertexArrayAttribBinding(id, attribute, 0);
  }
  glVertexArrayAttribFormat(id, 0, 3, GL_FLOAT, GL_FALSE, offsetof(BodyVertex, position));
  glVertexArrayAttribFormat(id, 1, 3, GL_FLOAT, GL_FALSE, offsetof(BodyVertex, normal));
  glVertexArrayAttribFormat(id, 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(BodyVertex, color));
  glVertexArrayVertexBuffer(id, 0, buffer, 0, sizeof(BodyVertex));
  return array;
}

}  // namespace

Expected<MeshRenderer> MeshRenderer::create(const MeshSurface& surface, const Layer& layer,
                                            const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  auto program = shaders.build({.name = "mesh_body",
                                .vertex = "mesh_body.vert.glsl",
                                .tess_control = {},
                                .tess_evaluation = {},
                                .geometry = {},
                                .fragment = "mesh_body.frag.glsl",
                                .defines = gl::binding_defines(bindings),
                                .feedback_varyings = {}});
  if (!program) return tl::unexpected(program.error());
  MeshRenderer renderer;
  renderer.home_ = gl::HomeContext::of_current();
  renderer.program_ = std::move(*program);
  renderer.origin_ = surface.corners().front();
  const std::vector<BodyVertex> vertices = body_vertices(surface, renderer.origin_);
  renderer.vertices_ = make_buffer(vertices.size() * sizeof(BodyVertex), vertices.data(), 0);
  renderer.vertex_array_ = make_body_array(renderer.vertices_.id());
  renderer.bindings_ = bindings;
  renderer.horizon_m_ = layer.horizon_m;
  renderer.count_ = GLsizei(vertices.size());
  return renderer;
}

void MeshRenderer::draw(const View& view, const gl::Frame& frame) {
  if (!home_.here("MeshRenderer::draw") || !usable(view, "MeshRenderer::draw")) return;
  const glm::vec3 origin_from_eye(origin_ - view.eye);
  const GLuint program = program_.id();
  glProgramUniform3f(program, k_origin_from_eye, origin_from_eye.x, origin_from_eye.y, origin_from_eye.z);
  glProgramUniform2f(program, k_body_cover, horizon_m_ * float(view.zoom()), k_light_between);
  glUseProgram(program);
  glBindVertexArray(vertex_array_.id());
  gl::bind_uniforms(bindings_.frame, frame.buffer());
  glDrawArrays(GL_TRIANGLES, 0, count_);
  gl::bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

size_t MeshRenderer::gpu_bytes() const {
  return gl::storage_bytes(vertices_);
}

}  // namespace sward
