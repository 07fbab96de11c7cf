// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/frame.h>

#include <cmath>
#include <cstddef>

#include "terrain/usable_view.h"

namespace sward::gl {

// std140: every member starts at a multiple of 16 bytes, matrices are four columns.
static_assert(offsetof(FrameUniforms, clip_from_relative) == 0);
static_assert(offsetof(FrameUniforms, eye_from_relative) == 64);
static_assert(offsetof(FrameUniforms, relative_from_clip) == 128);
static_assert(offsetof(FrameUniforms, viewport) == 192);
static_assert(offsetof(FrameUniforms, focal) == 208);
static_assert(offsetof(FrameUniforms, sun_direction) == 224);
static_assert(offsetof(FrameUniforms, sun_radiance) == 240);
static_assert(offsetof(FrameUniforms, sky_radiance) == 256);
static_assert(offsetof(FrameUniforms, horizon_radiance) == 272);
static_assert(offsetof(FrameUniforms, ground_radiance) == 288);
static_assert(offsetof(FrameUniforms, eye_noise) == 304);
static_assert(offsetof(FrameUniforms, up) == 320);
static_assert(offsetof(FrameUniforms, ground_tint) == 336);
static_assert(sizeof(FrameUniforms) == 352);

namespace {

/// Elevation at which the sun's disc has risen fully through the thickest air; below, its light fades to nothing at 0.
constexpr float k_risen_elevation = 0.05f;
/// Period of the noise that shaders draw on the ground, metres; eye_noise counts modulo it.
constexpr double k_noise_period = 1024.0;
/// Plants sway at whole multiples of its inverse, so that time may start again.
constexpr double k_time_period_s = 4096.0;

double wrapped(double value, double period) {
  return value - std::floor(value / period) * period;
}

}  // namespace

FrameUniforms make_frame_uniforms(const View& view, const Lighting& lighting, double time_s, int samples) {
  const glm::dmat4 clip_from_relative = view.clip_from_relative();
  const glm::dvec2 size(glm::max(view.viewport, glm::ivec2(1)));
  const glm::dvec2 focal = view.focal_px();
  const float elevation = lighting.sun_elevation;
  const glm::vec3 to_sun(std::cos(elevation) * std::cos(lighting.sun_azimuth),
                         std::cos(elevation) * std::sin(lighting.sun_azimuth), std::sin(elevation));

  FrameUniforms u{};
  u.clip_from_relative = glm::mat4(clip_from_relative);
  u.eye_from_relative = glm::mat4(glm::dmat4(view.eye_from_world));
  u.relative_from_clip = glm::mat4(glm::inverse(clip_from_relative));
  u.viewport = glm::vec4(size, 1.0 / size);
  u.focal = glm::vec4(glm::vec2(focal), float(view.zoom()), float(wrapped(time_s, k_time_period_s)));
  u.sun_direction = glm::vec4(to_sun, glm::smoothstep(0.0f, k_risen_elevation, elevation));
  u.sun_radiance = glm::vec4(lighting.sun_radiance, lighting.exposure);
  u.sky_radiance = glm::vec4(lighting.sky_radiance, lighting.encode_srgb ? 1.0f : 0.0f);
  u.horizon_radiance = glm::vec4(lighting.horizon_radiance, 1.0f / lighting.haze_distance_m);
  u.ground_radiance = glm::vec4(lighting.ground_radiance, 1.0f / lighting.haze_height_m);
  u.eye_noise = glm::vec4(glm::vec2(wrapped(view.eye.x, k_noise_period), wrapped(view.eye.y, k_noise_period)),
                          float(view.eye.z), float(samples));
  u.up = glm::vec4(0.0f, 0.0f, 1.0f, float(wrapped(view.eye.z, k_noise_period)));
  u.ground_tint = glm::vec4(lighting.ground_tint, 0.0f);
  return u;
}

Expected<Frame> Frame::create(const Bindings& bindings) {
  if (Expected<void> context = require_context(); !context) return tl::unexpected(context.error());
  Frame frame;
  frame.home_ = HomeContext::of_current();
  frame.bindings_ = bindings;
  frame.buffer_ = create_buffer();
  glNamedBufferStorage(frame.buffer_.id(), sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return frame;
}

void Frame::upload(const View& view, const Lighting& lighting, double time_s, int samples) {
  if (!home_.shared_here("Frame::upload") || !usable(view, "Frame::upload")) return;
  SWARD_ASSERT(std::isfinite(time_s), "Frame::upload: the time is no finite number of seconds");
  SWARD_ASSERT(samples >= 1, "Frame::upload: a target has at least one sample; give 1 where it is not multisampled");
  if (!std::isfinite(time_s) || samples < 1) return;
  const FrameUniforms uniforms = make_frame_uniforms(view, lighting, time_s, samples);
  samples_ = samples;
  glNamedBufferSubData(buffer_.id(), 0, sizeof uniforms, &uniforms);
}

size_t Frame::gpu_bytes() const {
  return storage_bytes(buffer_);
}

}  // namespace sward::gl
