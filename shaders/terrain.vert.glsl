// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A vertex of the mesh, from its slot.
#include "common_frame.glsl"

layout(location = 0) in vec3 position;         // metres, relative to the mesh's origin
layout(location = 1) in vec2 relief_gradient;  // dz/dx, dz/dy of the relief below the data

layout(location = 2) in vec3 motion;           // height from which the vertex moves, metres; since when; 1 / seconds

layout(location = 0) uniform vec3 origin_from_eye;
layout(location = 4) uniform float morph_time;  // seconds

layout(location = 0) out vec3 relative_position;
layout(location = 1) out vec2 relief;

void main() {
  float moved = clamp((morph_time - motion.y) * motion.z, 0.0, 1.0);
  float z = motion.z > 0.0 ? mix(motion.x, position.z, moved) : position.z;
  relative_position = vec3(position.xy, z) + origin_from_eye;
  relief = relief_gradient;
  gl_Position = frame.clip_from_relative * vec4(relative_position, 1.0);
}
