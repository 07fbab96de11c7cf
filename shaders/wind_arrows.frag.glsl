// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// False colours of the wind: blue in calm, green at 5 m/s, yellow at 10, red at 20 and more.
#include "common_frame.glsl"

in float speed;

layout(location = 0) out vec4 color;

void main() {
  vec3 calm = mix(vec3(0.1, 0.3, 1.0), vec3(0.1, 0.9, 0.3), clamp(speed / 5.0, 0.0, 1.0));
  vec3 fresh = mix(calm, vec3(1.0, 0.9, 0.1), clamp(speed / 5.0 - 1.0, 0.0, 1.0));
  vec3 storm = mix(fresh, vec3(1.0, 0.1, 0.05), clamp(speed / 10.0 - 1.0, 0.0, 1.0));
  color = vec4(frame.sky_radiance.w > 0.0 ? storm : storm * storm, 1.0);
}
