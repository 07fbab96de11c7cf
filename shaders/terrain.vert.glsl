// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A vertex of the mesh, from its slot.
#include "common_frame.glsl"

layout(location = 0) in vec3 position;         // metres, relative to the mesh's origin
layout(location = 1) in vec2 relief_gradient;  // dz/dx, dz/dy of the relief below the data

layout(location = 0) uniform vec3 origin_from_eye;

layout(location = 0) out vec3 relative_position;
layout(location = 1) out vec2 relief;

void main() {
  relative_position = position + origin_from_eye;
  relief = relief_gradient;
  gl_Position = frame.clip_from_relative * vec4(relative_position, 1.0);
}
