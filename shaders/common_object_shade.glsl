// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of single objects, fragments: coverage, shadows, the dark ground at the foot. The kind's file defines the two
// functions declared here; main is here. GLSL only.
#include "common_leaf.glsl"
#include "common_ground_shadow.glsl"
#include "common_cover.glsl"
#include "common_plant_image.glsl"

layout(location = 0) uniform int sward_species;

layout(location = 0) in vec4 part_point;        // relative to the eye; height above the ground's plane (m)
layout(location = 1) in vec4 part_normal;       // not of unit length; a number of the kind
layout(location = 2) in vec4 part_mask;         // the part's own coordinates; share that is covered; number of the part
layout(location = 3) flat in vec4 part_color;   // ground at the root; age
layout(location = 4) flat in vec4 part_ground;  // normal; melting
layout(location = 5) flat in vec4 part_self;    // base map coordinates below the eye; phase; what it is

layout(location = 0) out vec4 color;

const float k_contact_light = 0.45;  // share of the light at an object's foot

// The object's radiance before haze, at this fragment.
vec3 object_radiance(SpeciesParams species, vec3 to_eye);

// Share of this fragment that the object or its shadow covers, before the part's own coverage.
float object_cover(bool shadow);

// Change of the part's own coordinates from pixel to pixel, taken before anything is discarded.
vec2 part_footprint;

vec3 ground_radiance() {
  float what = part_self.w;
  bool contact = what > 1.5;
  float open = contact ? k_contact_light : 1.0;
  float sun = contact ? 1.0 : mix(1.0, k_shadow_light, what);
  return darkened_ground(part_point.xyz, part_self.xy, part_ground.xyz, open, sun);
}

vec3 visible_radiance() {
  SpeciesParams species = sward_layer.species[sward_species];
  vec3 lit = object_radiance(species, normalize(-part_point.xyz));
  return melt_into_ground(lit, part_color.rgb, part_ground, part_point.xyz);
}

// A pattern that stays on the part while the eye moves: cells of its own coordinates about a pixel large.
float part_pattern(vec2 place, float footprint) {
  float cells = exp2(floor(-log2(max(footprint, 1.0e-4))));
  ivec2 cell = ivec2(floor(place * cells));
  uint own = uint(part_self.z * 16777216.0) + uint(part_mask.w + 0.5) * 977u;
  return hash_unit(uvec2(uint(cell.x) + own, uint(cell.y)));
}

void main() {
  part_footprint = max(fwidth(part_mask.xy), vec2(1.0e-4));
  float footprint = max(part_footprint.x, part_footprint.y);
  float cover = object_cover(part_self.w >= 0.0) * part_mask.z;
  int mask = k_all_samples;
  float pattern = part_pattern(part_mask.xy, footprint);
  if (frame.eye_noise.w > 1.0) {
    mask = coverage_mask(clamp(cover, 0.0, 1.0), pattern);
  } else if (cover < 1.0 && cover <= pattern) {
    mask = 0;
  }
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  vec3 radiance = part_self.w >= 0.0 ? ground_radiance() : visible_radiance();
  color = vec4(encode_output(radiance), 1.0);
}
