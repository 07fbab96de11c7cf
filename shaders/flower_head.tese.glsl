// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of flowers' heads: hands a head to each of its petals.
#include "common_stance_line.glsl"

layout(isolines, equal_spacing) in;

layout(location = 0) in vec4 head_place[];
layout(location = 1) in vec4 head_axis[];
layout(location = 2) in vec4 head_plane[];
layout(location = 3) in vec4 head_color[];
layout(location = 4) in vec4 head_map[];
layout(location = 5) patch in uint head_slots[(SWARD_CLUSTER_SIZE + 3) / 4];
layout(location = 13) in vec3 head_root[];
#if SWARD_WIND
layout(location = 14) in vec4 head_air[];
layout(location = 8) flat out vec4 petal_air;
#endif

layout(location = 0) out vec4 petal_place;
layout(location = 1) out vec4 petal_axis;
layout(location = 2) out vec4 petal_plane;
layout(location = 3) out vec4 petal_color;
layout(location = 4) out vec4 petal_map;
layout(location = 5) out vec2 petal_number;  // of the segment's end; segments of the head
layout(location = 6) out vec3 petal_root;

void main() {
  uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
  uint i = head_slots[line / 4u] >> (8u * (line % 4u)) & 255u;
  hand_on_stance();
  petal_place = head_place[i];
  petal_axis = head_axis[i];
  petal_plane = head_plane[i];
  petal_root = head_root[i];
#if SWARD_WIND
  petal_air = head_air[i];
#endif
  petal_color = head_color[i];
  petal_map = head_map[i];
  petal_number = vec2(gl_TessCoord.x * gl_TessLevelOuter[1], gl_TessLevelOuter[1]);
}
