// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Which way is up for a patch's plants, tessellation control. On meshes plants are grown in a frame of their surface:
// the eye in its origin, its third axis along the normal, its first downhill. The geometry stage turns what it emits
// back (common_stance_shape.glsl). On terrain the world's axes are the frame. GLSL only.
#include "common_grow.glsl"
#include "common_ground.glsl"
#include "common_mesh_color.glsl"
#include "common_stance.glsl"

#if SWARD_ON_MESH
layout(location = 12) patch out vec3 stance_normal;  // of the patch's triangle, in the world
#endif

// Turns a grown seed to its frame. Not before its colour has been taken.
Seedling take_stance(Seedling s) {
#if SWARD_ON_MESH
  stance_normal = s.ground_normal;
  s.root = s.root * stance_axes(s.ground_normal);
  s.ground_normal = vec3(0.0, 0.0, 1.0);
#endif
  return s;
}

// Linear colour of the ground at a seed's root.
vec3 root_color(sampler2D base_map, Seedling s) {
#if SWARD_ON_MESH
  return mesh_albedo(s.own_color, s.root);
#else
  vec3 color = ground_albedo(base_map, s.map_uv, s.root, s.ground_normal);
  return ground_is_disturbed() ? disturbed_ground(color, s.disturbed, s.root) : color;
#endif
}
