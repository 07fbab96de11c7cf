// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The frame that plants on meshes are grown in. GLSL only.

// Columns in the world: downhill (east on level surfaces), to its left, along the normal.
mat3 stance_axes(vec3 normal) {
  vec3 level = dot(normal.xy, normal.xy) > 1.0e-4 ? vec3(0.0, 0.0, -1.0) : vec3(1.0, 0.0, 0.0);
  vec3 first = normalize(level - normal * dot(level, normal));
  return mat3(first, cross(normal, first), normal);
}
