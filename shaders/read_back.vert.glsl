// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Grows the seeds of fertile clusters as the growth programs do and captures their numbers; an instance is a line.
#include "common_grow.glsl"

layout(location = 0) in uvec4 cluster;

layout(xfb_buffer = 0, xfb_stride = 48) out;
layout(xfb_offset = 0) out uvec2 captured_name;      // record, rank
layout(xfb_offset = 8) out vec3 captured_root;      // relative to the eye
layout(xfb_offset = 20) out vec4 captured_traits;   // height, width, stiffness, azimuth
layout(xfb_offset = 36) out vec2 captured_presence;  // score, fade

void main() {
  FertileCluster fertile = unpack_cluster(cluster);
  Triangle triangle = fetch_triangle(fertile.record);
  Seedling s = place_seed(fertile, triangle, uint(gl_InstanceID));
  if (s.presence.fade > 0.0) s = grow_seed(fertile, triangle, s);
  captured_name = uvec2(fertile.record, s.rank);
  captured_presence = vec2(fertile.score, s.presence.fade);
  captured_root = vec3(0.0);
  captured_traits = vec4(0.0);
  if (s.presence.fade <= 0.0) return;
  captured_root = s.root;
  captured_traits = vec4(s.traits.height, s.traits.width, s.traits.stiffness, s.traits.azimuth);
}
