// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of flowers' heads: petals lit from both sides in their own colour, the centre, or the shadow on the ground.
#include "common_strip.glsl"

vec3 head_light() {
  SpeciesParams species = sward_layer.species[sward_species];
  float radius = strip_point.w;
  bool centre = strip_color.a > 0.5;
  Leaf leaf;
  // Darker at the foot of a petal and along its middle; a centre is darker inside.
  float streak = 1.0 - 0.10 * exp(-10.0 * strip_normal.w * strip_normal.w);
  leaf.albedo = strip_color.rgb * (centre ? 0.75 + 0.5 * radius : mix(0.84, 1.0, smoothstep(0.1, 0.7, radius)) * streak);
  leaf.sky = vec3(1.0);
  leaf.sun = 1.0;
  if (centre) species.optics.x = 0.0;
  species.optics.z *= 0.3;
  return apply_haze(lit_leaf(species, leaf, 0.25), strip_point.xyz);
}

void main() {
  int mask = strip_mask();
  if (mask == 0) discard;
  gl_SampleMask[0] = mask;
  color = vec4(encode_output(strip_is_shadow() ? shadow_color(strip_self.w) : head_light()), 1.0);
}
