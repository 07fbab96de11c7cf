// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The sun's light on a strip, at its vertices: what the fragment stage interpolates. GLSL only.
#include "common_canopy.glsl"

// How much of the ground's normal even near blades take on: a meadow takes light from above as a whole.
const float k_field_share = 0.3;

// 0: the strip is itself .. 1: it cannot be told from its neighbours, being far away or thinner than a pixel.
// `melting`: into the ground; `cover`: share of the drawn width that it covers.
float strip_distance(float melting, float cover) {
  return max(melting, 0.75 - 0.75 * smoothstep(0.06, 0.45, cover));
}

// Light of sky and sun among neighbours, `near` being canopy_light(). Leaves are brighter than the ground's colour,
// which shows them and the shade between them together (grass_leaf), and stand aslant to the light. With the ground's
// normal that is taken back, so that far plants have the ground's light; and they have one light from root to tip.
vec2 field_light(SpeciesParams species, vec2 near, float far) {
  return mix(near, vec2(0.36 * (1.0 + species.age_tint.w)), far);
}

struct StripLight {
  vec3 normal;    // for diffuse light
  float through;  // leaf_through()
  float gloss;    // leaf_gloss()
  float along;    // cosine for leaf_streak()
};

// `normal`: the strip's at this vertex, on the viewer's side; `tangent`: unit, along it; `point`: relative to the eye.
// With distance normals become the ground's, so that what moves below a pixel does not shimmer.
StripLight strip_light_at(vec4 optics, vec3 normal, vec3 tangent, vec3 point, vec3 ground, float far) {
  vec3 sun = frame.sun_direction.xyz;
  vec3 to_eye = -point / max(length(point), 1.0e-4);
  vec3 half_way = normalize(to_eye + sun + vec3(0.0, 0.0, 1.0e-4));
  vec3 own = normalize(normal);
  StripLight light;
  light.normal = normalize(mix(own, ground, mix(k_field_share, 1.0, far)));
  // Of blades that cannot be told apart, as many as the eye looks towards the sun are lit from behind.
  float towards = -dot(to_eye, sun);
  light.through = leaf_through(optics, mix(dot(own, sun), -0.35 * towards, far), towards);
  light.gloss = leaf_gloss(own, half_way, to_eye) * (1.0 - far);
  light.along = dot(tangent, half_way);
  return light;
}
