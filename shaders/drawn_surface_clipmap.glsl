// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The drawn surface below a triangle, where it is that of clipmap rings: asked of the rings themselves, so that plants
// stand on what is drawn whether the rings are finer or coarser than the triangle.
#include "common_clipmap.glsl"

SurfacePoint surface_at(Triangle t, vec2 point) {
  precise vec2 xy = t.apex.xy + offset_from_apex(t.to_left, t.to_right, point);
  ClipmapPoint surface = clipmap_surface(xy);
  return SurfacePoint(surface.z, normalize(vec3(-surface.gradient, 1.0)));
}
