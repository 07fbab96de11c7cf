// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What every program of a view reads. Mirror of sward::gl::FrameUniforms. Positions that shaders see are metres along
// the world's axes, relative to the eye.
layout(std140, binding = SWARD_BINDING_FRAME) uniform SwardFrame {
  mat4 clip_from_relative;
  mat4 eye_from_relative;  // rotation
  mat4 relative_from_clip;
  vec4 viewport;           // width, height, 1/width, 1/height (pixels)
  vec4 focal;              // focal x, focal y (pixels), zoom, time (s) modulo 4096
  vec4 sun_direction;      // to the sun; w: 1 when it has risen, 0 when it has set
  vec4 sun_radiance;       // w: exposure
  vec4 sky_radiance;       // w: 1 when colours are to be encoded
  vec4 horizon_radiance;   // w: 1 / haze distance
  vec4 ground_radiance;    // w: 1 / haze height
  vec4 eye_noise;          // eye's x, y modulo 1024 m; eye's height; samples of the target
  vec4 up;                 // w: eye's height modulo 1024 m
  vec4 ground_tint;        // factor on green ground
} frame;
