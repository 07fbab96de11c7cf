// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Light on and through leaves (Papavasiliou 2015, section 2.4, equations 13 and 14), darkened towards the root by the
// plants around (Reeves, Blau 1985). GLSL only.
#include "common_layer.glsl"
#include "common_light.glsl"

struct Leaf {
  vec3 albedo;
  vec3 sky;   // share of the sky's light that comes down to here
  float sun;  // share of the sun's
};

// Light that comes down between the neighbours to relative height `s`: nearly all at the tips, root_shade at the root.
float canopy_light(float root_shade, float s) { return mix(root_shade, 1.0, smoothstep(0.0, 0.9, s)); }

// Equation 13 without the light's colour.
float transmitted(float facing, float attenuation) {
  return facing < 0.0 ? -facing * exp(attenuation / min(facing, -0.05)) : 0.0;
}

// A blade at arc length `s`, `across` -1..1: the ground's colour, tinted towards the tip, older ones drier; one blade
// differs from the next.
Leaf grass_leaf(SpeciesParams species, vec4 ground_and_age, float s, float across, float phase) {
  float age = ground_and_age.w;
  float root_shade = species.age_tint.w;
  vec3 fresh = mix(vec3(1.0), species.tint.rgb, smoothstep(0.0, 0.6, s));
  // Blades dry from the tip down.
  float dry = age * mix(0.6, 1.0, smoothstep(0.2, 1.0, s));
  float own = 0.82 + 0.36 * fract(phase * 7.31);
  float vein = 1.0 - 0.12 * exp(-12.0 * across * across);
  Leaf leaf;
  leaf.albedo = ground_and_age.rgb * mix(fresh, species.age_tint.rgb, dry) * (own * vein);
  // The base map shows leaves and the shade between them together; a leaf alone is brighter.
  leaf.albedo *= 2.7 / (1.0 + root_shade);
  // What comes down has met other leaves on its way.
  vec3 filtered = leaf.albedo / max(max(leaf.albedo.r, leaf.albedo.g), 1.0e-4);
  leaf.sky = canopy_light(root_shade, s) * mix(vec3(1.0), filtered, 0.5 - 0.35 * s);
  leaf.sun = canopy_light(root_shade * root_shade, s);
  return leaf;
}

// A plant's light far away is the ground's. `ground`: its normal; melting, 0 the plant alone, 1 the ground alone.
vec3 melt_into_ground(vec3 lit, vec3 albedo, vec4 ground, vec3 point) {
  vec3 around =
      albedo * (ambient(ground.xyz) + sun_light() * max(dot(ground.xyz, frame.sun_direction.xyz), 0.0));
  return apply_haze(mix(lit, around, ground.w), point);
}

// Equation 14; `normal` and `to_eye` are unit vectors, the normal on the viewer's side.
vec3 shade_leaf(SpeciesParams species, Leaf leaf, vec3 normal, vec3 to_eye) {
  vec3 sun = frame.sun_direction.xyz;
  float facing = dot(normal, sun);
  float through = species.optics.x * transmitted(facing, species.optics.y);
  // Light that has passed a leaf is yellower.
  vec3 through_tint = leaf.albedo * vec3(1.25, 1.2, 0.6);
  vec3 diffuse = leaf.albedo * max(facing, 0.0) + through_tint * through;
  float gloss = pow(max(dot(to_eye, reflect(-sun, normal)), 0.0), species.optics.w);
  float shine = facing > 0.0 ? species.optics.z * gloss : 0.0;
  return ambient(normal) * leaf.albedo * leaf.sky + sun_light() * leaf.sun * (diffuse + vec3(shine));
}
