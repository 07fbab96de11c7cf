// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A ball (demo/host/rolling_ball.h): quads between circles of latitude, made from their number.
#include "common_frame.glsl"

layout(location = 0) uniform vec4 place;  // centre relative to the eye, radius
layout(location = 1) uniform mat3 turn;   // from the ball's own axes to the world's

const int k_around = 32;
const int k_up = 16;

out vec3 normal;
out vec3 own;  // place on the ball, its own axes, unit
out vec3 relative_position;

void main() {
  int quad = gl_VertexID / 6;
  int corner = gl_VertexID - 6 * quad;
  int across = corner == 1 || corner == 2 || corner == 4 ? 1 : 0;
  int above = corner == 2 || corner == 4 || corner == 5 ? 1 : 0;
  float longitude = 6.2831853 * float(quad % k_around + across) / float(k_around);
  float latitude = 3.1415927 * (float(quad / k_around + above) / float(k_up) - 0.5);
  own = vec3(cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude));
  normal = turn * own;
  relative_position = place.xyz + place.w * normal;
  gl_Position = frame.clip_from_relative * vec4(relative_position, 1.0);
}
