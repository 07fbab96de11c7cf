// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The drawn surface below a triangle, where the triangles come with its splits: nodes of a bintree. Programs that grow
// plants on clipmap rings are built with drawn_surface_clipmap.glsl in place of this file.
layout(binding = SWARD_BINDING_SURFACE) uniform usamplerBuffer sward_surface;

SurfacePoint surface_at(Triangle t, vec2 point) {
  precise float z_left = t.apex.z + t.to_left.z;
  precise float z_right = t.apex.z + t.to_right.z;
  SurfaceWalk walk = begin_walk(t.apex.z, z_left, z_right, point);
  // Corners of the piece, in weights of the triangle: its plane follows from them.
  vec2 apex = vec2(0.0), left = vec2(1.0, 0.0), right = vec2(0.0, 1.0);
  for (uint node = t.surface; node != 0u;) {
    uvec4 split = texelFetch(sward_surface, int(node));
    uint turn = walk_turn(walk);
    vec2 middle = 0.5 * (left + right);
    vec2 old_apex = apex;
    apex = middle;
    if (turn == 0u) {
      right = left;
      left = old_apex;
    } else {
      left = right;
      right = old_apex;
    }
    walk = walk_down(walk, uintBitsToFloat(split.x) + t.surface_z);
    node = turn == 0u ? split.y : split.z;
  }
  vec2 edge_left = offset_from_apex(t.to_left, t.to_right, left - apex);
  vec2 edge_right = offset_from_apex(t.to_left, t.to_right, right - apex);
  vec3 normal = cross(vec3(edge_left, walk.z_left - walk.z_apex), vec3(edge_right, walk.z_right - walk.z_apex));
  SurfacePoint s;
  s.z = walk_height(walk);
  s.normal = normalize(normal);
  return s;
}
