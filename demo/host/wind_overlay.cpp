// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/wind_overlay.h"

#include <cmath>
#include <cstddef>

#include "host/uniforms.h"

namespace sward::host {

namespace {

constexpr int k_side = 24;           // arrows a side of a ring's square
constexpr double k_spacing_m = 0.5;  // of the innermost
constexpr int k_rings = 7;           // each twice as wide: the outermost reaches 384 m
constexpr double k_above_m = 0.35;   // the ground
constexpr double k_length = 0.1;     // of an arrow for each m/s, in spacings
constexpr size_t k_most_vertices = size_t(k_rings) * k_side * k_side * 6;

}  // namespace

Expected<WindOverlay> WindOverlay::create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  gl::ProgramDesc desc;
  desc.name = "wind arrows";
  desc.vertex = "wind_arrows.vert.glsl";
  desc.fragment = "wind_arrows.frag.glsl";
  desc.defines = gl::binding_defines(bindings);
  auto program = shaders.build(desc);
  if (!program) return tl::unexpected(program.error());
  WindOverlay overlay;
  overlay.bindings_ = bindings;
  overlay.program_ = std::move(*program);
  overlay.buffer_ = gl::create_buffer();
  glNamedBufferStorage(overlay.buffer_.id(), GLsizeiptr(k_most_vertices * sizeof(Vertex)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  overlay.vertex_array_ = gl::create_vertex_array();
  const GLuint array = overlay.vertex_array_.id();
  glVertexArrayVertexBuffer(array, 0, overlay.buffer_.id(), 0, sizeof(Vertex));
  glEnableVertexArrayAttrib(array, 0);
  glVertexArrayAttribFormat(array, 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, 0, 0);
  return overlay;
}

void WindOverlay::add_arrow(const Wind& wind, const Surface& ground, glm::dvec2 at, double length) {
  const WindHere here = wind.at({at, 0.0});
  const glm::dvec2 blows(here.velocity + here.ambient), tip = at + blows * length;
  const double speed = glm::length(blows);
  if (!(speed > 0)) return;
  const double height = ground.height(at) + k_above_m;
  const auto vertex = [&](glm::dvec2 place) {
    lines_.push_back({glm::vec3(glm::dvec3(place, height) - eye_), float(speed)});
  };
  const glm::dvec2 back = -0.3 * length * blows, side = 0.5 * glm::dvec2(-back.y, back.x);
  for (const glm::dvec2 end : {at, tip + back + side, tip + back - side}) {
    vertex(end);
    vertex(tip);
  }
}

void WindOverlay::draw(const gl::Frame& frame, const View& view, const Wind& wind, const Surface& ground) {
  eye_ = view.eye;
  lines_.clear();
  for (int ring = 0; ring < k_rings; ++ring) {
    const double spacing = k_spacing_m * double(1 << ring);
    // Places stay where they are while the eye moves.
    const glm::dvec2 middle = glm::floor(glm::dvec2(eye_) / (2 * spacing)) * (2 * spacing);
    for (int i = 0; i < k_side * k_side; ++i) {
      const glm::ivec2 cell(i % k_side - k_side / 2, i / k_side - k_side / 2);
      const bool inner = ring > 0 && std::abs(cell.x + 0.5) < k_side / 4 && std::abs(cell.y + 0.5) < k_side / 4;
      if (!inner) add_arrow(wind, ground, middle + (glm::dvec2(cell) + 0.5) * spacing, k_length * spacing);
    }
  }
  if (lines_.empty()) return;
  glNamedBufferSubData(buffer_.id(), 0, GLsizeiptr(lines_.size() * sizeof(Vertex)), lines_.data());
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  glDrawArrays(GL_LINES, 0, GLsizei(lines_.size()));
  bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward::host
