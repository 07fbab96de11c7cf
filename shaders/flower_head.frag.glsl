// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of flowers' heads: petals lit from both sides in their own colour, the centre, or the shadow on the ground.
#include "common_strip.glsl"
#include "common_shoot.glsl"

// Of a petal's shading, for heads too small to show any.
const float k_mean_petal = 0.95;

// A petal takes on the centre's colour at its foot, has fine veins where they can be told apart, and is darker where it
// lies under its neighbours.
vec3 petal_albedo(SpeciesParams species, float radius, float across) {
  float inner = species.own_c.w;
  vec3 foot = mix(strip_color.rgb, unpack_color(species.own_d.x), 0.6);
  vec3 albedo = mix(foot, strip_color.rgb, smoothstep(inner, 1.9 * inner + 0.02, radius));
  float veins = 1.0 - smoothstep(0.25, 0.7, fwidth(across) * 3.0);
  float ridge = 0.5 + 0.5 * cos(across * 21.0 + 3.0 * radius);
  albedo *= 1.0 - 0.13 * veins * ridge;
  return albedo * (1.0 - 0.22 * across * across * (1.0 - radius)) * mix(0.85, 1.0, smoothstep(0.1, 0.8, radius));
}

vec3 head_light() {
  SpeciesParams species = sward_layer.species[sward_species];
  float radius = strip_place.x;
  bool centre = strip_color.a > 0.75, whole = strip_color.a > 0.25;
  Leaf leaf;
  leaf.albedo = strip_color.rgb * (centre ? 0.7 + 0.6 * radius : k_mean_petal);
  if (!whole) leaf.albedo = petal_albedo(species, radius, strip_place.y);
  // Less light comes down into a bowl.
  float depth = clamp(species.own_b.w, 0.0, 1.0) * (whole ? 0.35 : 1.0 - min(radius, 1.0));
  leaf.sky = vec3(1.0 - 0.75 * depth);
  leaf.sun = (1.0 - 0.4 * depth) * host_shadow(strip_point);
  return apply_haze(lit_leaf(species, leaf), strip_point);
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(encode_output(strip_is_shadow() ? shadow_color(strip_self.y) : head_light()), 1.0);
}
