// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of single objects, tessellation evaluation: hands an object's numbers on with the place along its line; the
// geometry stage makes the shape. The kind's file declares the spacing. GLSL only.
#include "common_layer.glsl"
#include "common_stance_line.glsl"

layout(location = 0) in vec4 object_root[];
layout(location = 1) in vec4 object_form[];
layout(location = 2) in vec4 object_ground[];
layout(location = 3) in vec4 object_color[];
layout(location = 4) in vec4 object_self[];
layout(location = 5) patch in uvec2 object_patch;
layout(location = 6) patch in uint object_slots[(SWARD_CLUSTER_SIZE + 3) / 4];

#if SWARD_WIND
layout(location = 14) in vec4 object_blown[];
layout(location = 15) in float object_slow[];
layout(location = 8) flat out vec4 line_blown;  // wind, sway, cycle
layout(location = 9) flat out float line_slow;  // slow cycle
#endif

layout(location = 0) out vec4 line_root;   // relative to the eye; height (m)
layout(location = 1) out vec4 line_form;   // width (m), stiffness, azimuth, lean
layout(location = 2) out vec4 line_plane;  // of the ground: unit normal; place along the line, 0..1
layout(location = 3) out vec4 line_color;  // ground at the root; age
layout(location = 4) out vec4 line_self;   // distance, phase, own parts, parts drawn
layout(location = 5) out vec4 line_map;    // base map coordinates below the eye; melting; bend (shadow_bend)
layout(location = 6) flat out uint line_record;

void hand_on() {
  uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
  uint i = object_slots[line / 4u] >> (8u * (line % 4u)) & 255u;
  vec4 ground = object_ground[i];
  vec3 root = object_root[i].xyz;
  vec3 normal = vec3(ground.xy, sqrt(max(1.0 - dot(ground.xy, ground.xy), 1.0e-4)));
  vec2 uv_per_m = sward_layer.layer.map.xy / sward_layer.layer.map.zw;
  float distance = object_self[i].x;
  hand_on_stance();
  line_root = object_root[i];
  line_form = object_form[i];
  line_plane = vec4(normal, gl_TessCoord.x);
  line_color = object_color[i];
  line_self = vec4(object_self[i].xyz, gl_TessLevelOuter[1]);
  line_map = vec4(ground.zw - root.xy * uv_per_m, smoothstep(0.02, 0.6, distance / sward_layer.layer.reach.x),
                  object_self[i].w);
  line_record = object_patch.x;
#if SWARD_WIND
  line_blown = object_blown[i];
  line_slow = object_slow[i];
#endif
}
