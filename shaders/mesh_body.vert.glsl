// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The body of a mesh that plants stand on.
#include "common_frame.glsl"

layout(location = 0) in vec3 position;  // metres, relative to the mesh's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;     // sRGB

layout(location = 0) uniform vec3 origin_from_eye;

layout(location = 0) out vec3 body_point;  // relative to the eye
layout(location = 1) out vec3 body_normal;
layout(location = 2) out vec3 body_color;

void main() {
  body_point = position + origin_from_eye;
  body_normal = normal;
  body_color = color.rgb;
  gl_Position = frame.clip_from_relative * vec4(body_point, 1.0);
}
