// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "terrain_gl/ground_shading.h"

#include "gl/bind.h"

namespace sward {

using gl::bind_texture, gl::bind_uniforms;

namespace {

/// Uniform locations of terrain.frag.glsl.
enum Location : GLint { k_base_map_transform = 1, k_slope_windows, k_data_rectangle, k_slope_map_transform = 5 };

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

}  // namespace

GroundShading::GroundShading(const gl::Program& program, const gl::Bindings& bindings, const View& view,
                             const gl::Frame& frame, const gl::GroundTextures& ground)
    : bindings_(bindings) {
  const glm::dvec2 eye(view.eye);
  set_vec4(program, k_base_map_transform, map_transform(view.eye, ground.map_min(), ground.map_size()));
  set_slopes(program, view.eye, ground.slopes());
  set_vec4(program, k_data_rectangle,
           glm::vec4(glm::vec2(ground.data_min() - eye), glm::vec2(ground.data_max() - eye)));
  glUseProgram(program.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  bind_texture(bindings_.base_map, ground.base_map());
  bind_texture(bindings_.slope_map, ground.slopes().texture());
  bind_texture(bindings_.detail, ground.detail());
  bind_texture(bindings_.detail_slope, ground.detail_slope());
  bind_uniforms(bindings_.materials, ground.materials());
  bind_uniforms(bindings_.disturbance, ground.disturbed().block);
  bind_texture(bindings_.disturbance_map, ground.disturbed().map);
}

GroundShading::~GroundShading() {
  glBindTextureUnit(bindings_.disturbance_map, 0);
  bind_uniforms(bindings_.disturbance, 0);
  bind_uniforms(bindings_.materials, 0);
  glBindTextureUnit(bindings_.detail_slope, 0);
  glBindTextureUnit(bindings_.detail, 0);
  glBindTextureUnit(bindings_.slope_map, 0);
  glBindTextureUnit(bindings_.base_map, 0);
  bind_uniforms(bindings_.frame, 0);
  glUseProgram(0);
}

}  // namespace sward
