// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass: a blade lit from both sides (Papavasiliou 2015, section 2.4), or its shadow on the ground.
#include "common_light.glsl"
#include "common_ground.glsl"
#include "common_leaf.glsl"
#include "common_ground_shadow.glsl"
#include "common_layer.glsl"
#include "common_cover.glsl"

layout(location = 0) uniform int sward_species;

layout(location = 0) in vec4 strip_point;        // relative to the eye; arc length
layout(location = 1) in vec4 strip_normal;       // towards the viewer, rounded; -1..1 across
layout(location = 2) in vec2 strip_cover;        // share of the strip that the plant covers; height above the ground
layout(location = 3) flat in vec4 strip_color;   // ground at the root; age
layout(location = 4) flat in vec4 strip_ground;  // normal; melting
layout(location = 5) flat in vec4 strip_self;    // base map coordinates below the eye; phase; shadow's strength or -1

layout(location = 0) out vec4 color;

// How much of the ground's normal even near blades take on.
const float k_field_share = 0.3;

vec3 shadow_color(float strength) {
  return darkened_ground(strip_point.xyz, strip_self.xy, strip_ground.xyz, 1.0, mix(1.0, k_shadow_light, strength));
}

vec3 blade_color() {
  SpeciesParams species = sward_layer.species[sward_species];
  Leaf leaf = grass_leaf(species, strip_color, strip_point.w, strip_normal.w, strip_self.z);
  // A meadow takes light from above as a whole, the more so the less single blades can be told apart.
  float together = mix(k_field_share, 0.8, strip_ground.w);
  vec3 normal = normalize(mix(normalize(strip_normal.xyz), strip_ground.xyz, together));
  vec3 lit = shade_leaf(species, leaf, normal, normalize(-strip_point.xyz));
  vec3 ground = strip_color.rgb * (ambient(strip_ground.xyz) +
                                   sun_light() * max(dot(strip_ground.xyz, frame.sun_direction.xyz), 0.0));
  return apply_haze(mix(lit, ground, strip_ground.w), strip_point.xyz);
}

void main() {
  float phase = strip_self.z;
  int mask = k_all_samples;
  if (frame.eye_noise.w > 1.0) {
    mask = coverage_mask(strip_cover.x, phase);
  } else if (hidden_by_hash(strip_cover.x, phase, strip_point)) {
    mask = 0;
  }
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  vec3 radiance = strip_self.w >= 0.0 ? shadow_color(strip_self.w) : blade_color();
  color = vec4(encode_output(radiance), 1.0);
}
