// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <sward/api.h>
#include <sward/gl/bindings.h>
#include <sward/gl/handles.h>
#include <sward/terrain/view.h>

namespace sward::gl {

/// What lights the scene. Colours are linear, Rec. 709.
struct SWARD_API Lighting {
  float sun_azimuth = 2.4f;       ///< Radians: 0 east, counter-clockwise.
  float sun_elevation = 0.6f;     ///< Radians above the horizon; at and below 0 the sun gives no light.
  glm::vec3 sun_radiance{3.2f, 3.0f, 2.6f};   ///< On a surface facing the sun.
  glm::vec3 sky_radiance{0.42f, 0.55f, 0.80f};     ///< Ambient from straight above.
  glm::vec3 horizon_radiance{0.72f, 0.80f, 0.90f};  ///< Haze and sky at the horizon.
  glm::vec3 ground_radiance{0.16f, 0.15f, 0.10f};  ///< Ambient bounced from below.
  float haze_distance_m = 12000;  ///< Distance at which 63 % of the light is the haze's. > 0.
  float haze_height_m = 2500;     ///< Scale height of the haze, metres. > 0.
  float exposure = 0.55f;          ///< Multiplier before tone mapping. > 0.
  /// True: shaders write tone-mapped sRGB-encoded colour (for ordinary 8-bit targets). False: linear radiance.
  bool encode_srgb = true;
  /// Factor on the linear colour of green ground, and so of what grows there: the season's. Each >= 0.
  glm::vec3 ground_tint{1.0f};

  /// A clear day's colours for a sun at this place: warmer, dimmer and hazier near the horizon.
  static Lighting clear_day(float sun_azimuth, float sun_elevation);
};

/// Mirror of `SwardFrame` in shaders/common_frame.glsl (std140; offsets asserted in frame.cpp and tested).
struct FrameUniforms {
  glm::mat4 clip_from_relative;  ///< World axes, relative to the eye, to clip space.
  glm::mat4 eye_from_relative;   ///< Rotation.
  glm::mat4 relative_from_clip;  ///< For the sky.
  glm::vec4 viewport;            ///< width, height, 1/width, 1/height (pixels).
  glm::vec4 focal;               ///< focal x, focal y (pixels), zoom, time (s) modulo 4096.
  glm::vec4 sun_direction;       ///< To the sun, unit; w: 1 when it is above the horizon, falls to 0 as it sets.
  glm::vec4 sun_radiance;        ///< w: exposure.
  glm::vec4 sky_radiance;        ///< w: 1 when colours are to be encoded.
  glm::vec4 horizon_radiance;    ///< w: 1 / haze distance.
  glm::vec4 ground_radiance;     ///< w: 1 / haze height.
  glm::vec4 eye_noise;           ///< Eye's x, y modulo 1024 m, for world-stable noise; z: eye's height, w: samples of the target.
  glm::vec4 up;                  ///< xyz: world up; w: eye's height modulo 1024 m.
  glm::vec4 ground_tint;         ///< xyz: factor on green ground; w unused.
};

/// The per-view uniform buffer that every sward program reads. GL thread.
class SWARD_API Frame {
 public:
  static Expected<Frame> create(const Bindings& bindings = {});
  /// Fills the buffer for a view. `time_s` drives what moves; `samples` of the target (1: no multisampling) chooses
  /// between alpha-to-coverage and hashed alpha. Asserts that the view validates, that `time_s` is finite and `samples`
  /// at least 1. Binds nothing.
  void upload(const View& view, const Lighting& lighting, double time_s, int samples);
  GLuint buffer() const { return buffer_.id(); }
  const Bindings& bindings() const { return bindings_; }
  int samples() const { return samples_; }
  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;

 private:
  HomeContext home_;
  Buffer buffer_;
  Bindings bindings_;
  int samples_ = 1;
};

SWARD_API FrameUniforms make_frame_uniforms(const View& view, const Lighting& lighting, double time_s, int samples);

}  // namespace sward::gl
