// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Which way is up, tessellation evaluation: hands the patch's frame on. GLSL only.
#if SWARD_ON_MESH
layout(location = 12) patch in vec3 stance_normal;
layout(location = 7) flat out vec3 line_stance;
#endif

void hand_on_stance() {
#if SWARD_ON_MESH
  line_stance = stance_normal;
#endif
}
