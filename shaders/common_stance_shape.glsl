// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Which way is up, geometry: turns positions (relative to the eye) and directions from the frame that plants were grown
// in to the world's axes. GLSL only.
#include "common_stance.glsl"

#if SWARD_ON_MESH
layout(location = 7) flat in vec3 line_stance[];
#endif

vec3 to_world(vec3 v) {
#if SWARD_ON_MESH
  return stance_axes(line_stance[0]) * v;
#else
  return v;
#endif
}

vec3 from_world(vec3 v) {
#if SWARD_ON_MESH
  return v * stance_axes(line_stance[0]);
#else
  return v;
#endif
}
