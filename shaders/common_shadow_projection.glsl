// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Planar shadows: the light's way onto the ground around a root. The plane is the drawn surface's at the root; where
// that bends, shadow_bend() has found how far, so that shadows follow it. GLSL only.
#include "common_frame.glsl"
#include "common_visible.glsl"

// Shadows are drawn before the ground by this share of their distance at least, and by so much of its height above the
// plane as k_shadow_lift_m is of the eye's: towards the eye, so that nothing moves in the picture.
const float k_shadow_lift = 0.0012;
const float k_shadow_lift_m = 0.004;
// Half the sun's disc, as a slope: shadows blur with the light's way.
const float k_sun_radius = 0.00465;

struct ShadowPlane {
  vec3 root, normal;
  vec3 slide;  // along the plane, away from the sun: of a point one metre above it (m)
  vec2 bend;   // rise of the ground over the plane along the slide, per metre: to half of the reach, to all of it
  float half_reach;  // metres
  float lift;  // share of the distance to the eye
};

// Metres that light through a point one metre above the plane goes along it. Low suns are cut, softly, to the longest
// shadow.
float shadow_slide(float facing, float level) {
  float wanted = level / max(facing, 1.0e-3);
  float ratio = min(wanted / k_longest_shadow, 100.0);
  ratio *= ratio;
  return wanted * inversesqrt(sqrt(1.0 + ratio * ratio));
}

// 0..1: how dark shadows on such ground are. They end where the ground turns away from the sun, and pale as the sun
// goes lower than their greatest length tells.
float ground_shadow_strength(LayerParams layer, float distance, vec3 plane) {
  float facing = dot(plane, frame.sun_direction.xyz);
  if (facing <= 0.0) return 0.0;
  float level = sqrt(max(1.0 - facing * facing, 0.0));
  float kept = shadow_slide(facing, level) * facing / max(level, 1.0e-4);
  return shadow_strength(layer, distance) * smoothstep(0.0, 0.07, facing) * mix(0.5, 1.0, min(kept, 1.0));
}

// Unit, along the plane and away from the sun; and the slide.
vec3 shadow_way(vec3 plane, out float slide) {
  vec3 sun = frame.sun_direction.xyz;
  float facing = dot(plane, sun);
  vec3 away = plane * facing - sun;
  float level = length(away);
  slide = shadow_slide(facing, level);
  return away / max(level, 1.0e-4);
}

vec2 unpack_bend(float packed_bend) {
  float first = floor(packed_bend / 4096.0);
  return (vec2(first, packed_bend - first * 4096.0) - 2048.0) / 1024.0;
}

// `packed_bend`: shadow_bend() of the plant, `reach`: the same as given there.
ShadowPlane shadow_plane(vec3 root, vec3 normal, float packed_bend, float reach) {
  ShadowPlane p;
  float slide;
  vec3 way = shadow_way(normal, slide);
  p.root = root;
  p.normal = normal;
  p.slide = way * slide;
  p.bend = unpack_bend(packed_bend);
  p.half_reach = 0.5 * max(reach * slide, 1.0e-4);
  p.lift = clamp(k_shadow_lift_m / max(-dot(normal, root), 1.0e-3), k_shadow_lift, 0.01);
  return p;
}

// Where the light through a point meets the ground.
vec3 cast_shadow(ShadowPlane p, vec3 point) {
  vec3 from_root = point - p.root;
  float above = dot(from_root, p.normal);
  vec3 level = from_root - p.normal * above + p.slide * max(above, 0.0);
  float far = dot(level, p.slide) * inversesqrt(max(dot(p.slide, p.slide), 1.0e-8));
  float rise = far * mix(p.bend.x, p.bend.y, clamp(far / p.half_reach - 1.0, 0.0, 1.0));
  return p.root + level + p.normal * (far > 0.0 ? rise : 0.0);
}

// Before the ground, for depth to tell them apart.
vec3 lifted(ShadowPlane p, vec3 point) { return point * (1.0 - p.lift); }

// Half the width by which the sun's disc blurs the shadow of `point` that falls on `hit`.
float shadow_blur(vec3 point, vec3 hit) { return k_sun_radius * distance(point, hit); }
