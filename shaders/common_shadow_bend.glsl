// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How the drawn ground bends below a plant's shadow, found once a plant. GLSL only.
#include "common_grow.glsl"
#include "common_shadow_projection.glsl"

// Rise over the root's plane, per metre along it, of the drawn surface below `way` from the root, metres; beyond the
// triangle's border that at the border goes on.
float rise_along(Triangle t, Seedling s, vec3 way) {
  float area = t.to_left.x * t.to_right.y - t.to_left.y * t.to_right.x;
  vec2 stride = vec2(way.x * t.to_right.y - way.y * t.to_right.x, t.to_left.x * way.y - t.to_left.y * way.x) / area;
  // Weights of apex, left, right must stay above 0.
  vec3 from = vec3(1.0 - s.point.x - s.point.y, s.point), by = vec3(-stride.x - stride.y, stride);
  float share = 1.0;
  for (int i = 0; i < 3; ++i)
    if (by[i] < 0.0) share = min(share, 0.999 * max(from[i], 0.0) / -by[i]);
  float along = share * length(way);
  if (along < 1.0e-3) return 0.0;
  vec2 point = s.point + share * stride;
  SurfacePoint ground = surface_at(t, point);
  vec3 there = vec3(t.apex.xy + offset_from_apex(t.to_left, t.to_right, point), ground.z);
  return dot(there - s.root, s.ground_normal) / along;
}

// Shadows shorter than this, pixels, lie on their plane.
const float k_least_bend_px = 4.0;

// Two slopes in one float, 12 bits each (unpack_bend); `reach`: height of what casts the shadow, metres.
float shadow_bend(Triangle t, Seedling s, float reach) {
  const float none = 2048.0 * 4096.0 + 2048.0;
  if (SWARD_GROWTH_INVOCATIONS < 2 || t.surface == 0u) return none;
  if (ground_shadow_strength(sward_layer.layer, s.distance, s.ground_normal) <= 0.01) return none;
  float slide;
  vec3 way = shadow_way(s.ground_normal, slide) * (slide * reach);
  if (slide * reach * frame.focal.y < k_least_bend_px * s.distance) return none;
  vec2 bend = vec2(rise_along(t, s, 0.5 * way), rise_along(t, s, way));
  bend = clamp(floor(bend * 1024.0 + 2048.5), 0.0, 4095.0);
  return bend.x * 4096.0 + bend.y;
}
