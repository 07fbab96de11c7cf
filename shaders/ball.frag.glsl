// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A ball of eight panels of two colours, so that its turning shows.
#include "common_light.glsl"

in vec3 normal;
in vec3 own;
in vec3 relative_position;

layout(location = 0) out vec4 color;

void main() {
  bool dark = (own.x > 0.0) != (own.y > 0.0) != (own.z > 0.0);
  vec3 albedo = dark ? vec3(0.42, 0.05, 0.03) : vec3(0.62, 0.58, 0.50);
  color = vec4(encode_output(shade_ground(albedo, normalize(normal), relative_position, 1.0)), 1.0);
}
