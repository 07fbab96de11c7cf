// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// One triangle over the whole screen, at the far plane of an ordinary (not reversed) depth range.
#include "common_frame.glsl"

layout(location = 0) out vec3 direction;

void main() {
  vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  // Between the planes every point is finite and ahead of the eye, with infinite projections too.
  direction = (frame.relative_from_clip * vec4(ndc, 0.0, 1.0)).xyz;
  gl_Position = vec4(ndc, 1.0, 1.0);
}
