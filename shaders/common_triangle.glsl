// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Triangle records and the drawn surface below them, out of buffer textures. GLSL only.
#include "common_shared.glsl"
#include "common_philox.glsl"
#include "common_seed.glsl"

layout(binding = SWARD_BINDING_TRIANGLES) uniform usamplerBuffer sward_triangles;
layout(binding = SWARD_BINDING_SURFACE) uniform usamplerBuffer sward_surface;

// TriangleRecord of seeding.h: six texels.
struct Triangle {
  vec3 apex, to_left, to_right;
  uvec2 id;
  uint surface;
  ivec2 texel;
  vec2 texel_fraction;
  float limit;
  float slope;
  float surface_z;
  uint submitted;
  vec3 altitude;
  uint exclusions;
};

uvec4 triangle_texel(uint index, int texel) { return texelFetch(sward_triangles, int(index) * 6 + texel); }

uint fetch_submitted(uint index) { return triangle_texel(index, 4).w; }

Triangle fetch_triangle(uint index) {
  uvec4 apex = triangle_texel(index, 0);
  uvec4 left = triangle_texel(index, 1);
  uvec4 right = triangle_texel(index, 2);
  uvec4 map = triangle_texel(index, 3);
  uvec4 rest = triangle_texel(index, 4);
  uvec4 place = triangle_texel(index, 5);
  Triangle t;
  t.apex = uintBitsToFloat(apex.xyz);
  t.to_left = uintBitsToFloat(left.xyz);
  t.to_right = uintBitsToFloat(right.xyz);
  t.id = uvec2(apex.w, left.w);
  t.surface = right.w;
  t.texel = ivec2(map.xy);
  t.texel_fraction = uintBitsToFloat(map.zw);
  t.limit = uintBitsToFloat(rest.x);
  t.slope = uintBitsToFloat(rest.y);
  t.surface_z = uintBitsToFloat(rest.z);
  t.submitted = rest.w;
  t.altitude = uintBitsToFloat(place.xyz);
  t.exclusions = place.w;
  return t;
}

// The drawn surface at a point: its height relative to the eye, and the upward unit normal of the flat piece there.
struct SurfacePoint {
  float z;
  vec3 normal;
};

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
