// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/rolling_ball.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "host/uniforms.h"

namespace sward::host {

namespace {

constexpr double k_step_s = 1.0 / 120;
constexpr double k_gravity = 9.81;
constexpr double k_drag = 0.35;             // of grass, 1/s
constexpr double k_resistance_m_s2 = 0.45;  // of soft ground
constexpr double k_slope_m = 0.25;          // over which the ground's slope is taken
constexpr int k_vertices = 6 * 32 * 16;     // ball.vert.glsl

glm::dvec2 slope_at(const Surface& ground, glm::dvec2 at) {
  const auto rise = [&](glm::dvec2 way) { return ground.height(at + way) - ground.height(at - way); };
  return glm::dvec2(rise({k_slope_m, 0}), rise({0, k_slope_m})) / (2 * k_slope_m);
}

void step(RollingBall& ball, double seconds, const Surface& ground) {
  const glm::dvec2 slope = slope_at(ground, ball.centre);
  if (!std::isfinite(slope.x + slope.y)) {
    ball.velocity = glm::dvec2(0);
    return;
  }
  // Two sevenths of what gravity gives turn the ball.
  ball.velocity -= slope * (k_gravity * 5.0 / 7.0 / (1.0 + glm::dot(slope, slope)) * seconds);
  const double speed = glm::length(ball.velocity);
  const double kept = std::max(speed * std::exp(-k_drag * seconds) - k_resistance_m_s2 * seconds, 0.0);
  ball.velocity *= speed > 0 ? kept / speed : 0.0;
  const glm::dvec2 way = ball.velocity * seconds;
  ball.centre += glm::dvec3(way, 0);
  ball.centre.z = ground.height(glm::dvec2(ball.centre)) + ball.radius_m;
  const double angle = glm::length(way) / ball.radius_m;
  if (!(angle > 1e-9)) return;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(-way.y, way.x, 0));
  ball.turn = glm::dmat3(glm::rotate(glm::dmat4(1), angle, axis)) * ball.turn;
}

}  // namespace

void RollingBall::roll(double seconds, const Surface& ground) {
  for (double left = seconds; left > 0; left -= k_step_s) step(*this, std::min(left, k_step_s), ground);
}

Expected<BallRenderer> BallRenderer::create(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  gl::ProgramDesc desc;
  desc.name = "ball";
  desc.vertex = "ball.vert.glsl";
  desc.fragment = "ball.frag.glsl";
  desc.defines = gl::binding_defines(bindings);
  auto program = shaders.build(desc);
  if (!program) return tl::unexpected(program.error());
  BallRenderer renderer;
  renderer.bindings_ = bindings;
  renderer.program_ = std::move(*program);
  renderer.vertex_array_ = gl::create_vertex_array();
  return renderer;
}

void BallRenderer::draw(const gl::Frame& frame, const View& view, std::span<const RollingBall> balls) {
  if (balls.empty()) return;
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  bind_uniforms(bindings_.frame, frame.buffer());
  for (const RollingBall& ball : balls) {
    const glm::vec4 place(glm::vec3(ball.centre - view.eye), float(ball.radius_m));
    const glm::mat3 turn(ball.turn);
    glProgramUniform4fv(program_.id(), 0, 1, glm::value_ptr(place));
    glProgramUniformMatrix3fv(program_.id(), 1, 1, GL_FALSE, glm::value_ptr(turn));
    glDrawArrays(GL_TRIANGLES, 0, k_vertices);
  }
  bind_uniforms(bindings_.frame, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward::host
