// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Triangle records out of a buffer texture, and the drawn surface below them. GLSL only.
#include "common_shared.glsl"
#include "common_philox.glsl"
#include "common_seed.glsl"

layout(binding = SWARD_BINDING_TRIANGLES) uniform usamplerBuffer sward_triangles;

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

// surface_at(triangle, point in its weights)
#include "drawn_surface.glsl"
