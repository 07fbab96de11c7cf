// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Arrows that show the wind (demo/host/wind_overlay.h).
#include "common_frame.glsl"

layout(location = 0) in vec4 arrow;  // place relative to the eye; m/s

out float speed;

void main() {
  speed = arrow.w;
  gl_Position = frame.clip_from_relative * vec4(arrow.xyz, 1.0);
}
