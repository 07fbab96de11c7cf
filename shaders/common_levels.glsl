// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a patch of lines asks of the tessellator. GLSL only, tessellation control stage.
void set_levels(uint lines, float segments) {
  gl_TessLevelOuter[0] = float(lines);
  gl_TessLevelOuter[1] = segments;
  gl_TessLevelOuter[2] = 1.0;
  gl_TessLevelOuter[3] = 1.0;
  gl_TessLevelInner[0] = 1.0;
  gl_TessLevelInner[1] = 1.0;
}
