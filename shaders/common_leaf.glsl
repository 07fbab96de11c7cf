// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Light on and through leaves (Papavasiliou 2015, section 2.4, equations 13 and 14). GLSL only.
#include "common_canopy.glsl"
#include "common_layer.glsl"
#include "common_light.glsl"

struct Leaf {
  vec3 albedo;
  vec3 sky;   // share of the sky's light that comes down to here, by channel: it has met other leaves on its way
  float sun;  // share of the sun's
};

// The sun's light on a leaf beyond the diffuse.
struct LeafSun {
  float through;  // leaf_through()
  float shine;    // leaf_streak() times leaf_gloss()
};

// A blade is darker along its middle. `across`: -1..1.
float leaf_vein(float across) { return 1.0 - 0.12 * exp(-12.0 * across * across); }

// Share of the sun that comes to what grows on a surface: a body that plants cover all around stands between the sun and
// those on its other side; and the host's shadow on the plant at `point`, relative to the eye.
float body_light(vec3 surface_normal, vec3 point) {
#if SWARD_ON_MESH
  return smoothstep(-0.25, 0.30, dot(surface_normal, frame.sun_direction.xyz)) * host_shadow(point);
#else
  return host_shadow(point);
#endif
}

// A blade at arc length `s`, `across` -1..1: the ground's colour, tinted towards the tip, older ones drier; one blade
// differs from the next. In the open: the canopy's shade is the caller's.
Leaf grass_leaf(SpeciesParams species, vec4 ground_and_age, float s, float across, float phase) {
  float age = ground_and_age.w;
  float root_shade = species.age_tint.w;
  vec3 fresh = mix(vec3(1.0), species.tint.rgb, smoothstep(0.0, 0.6, s));
  // Blades dry from the tip down.
  float dry = age * mix(0.6, 1.0, smoothstep(0.2, 1.0, s));
  float own = 0.82 + 0.36 * fract(phase * 7.31);
  Leaf leaf;
  leaf.albedo = ground_and_age.rgb * mix(fresh, species.age_tint.rgb, dry) * (own * leaf_vein(across));
  // The base map shows leaves and the shade between them together; a leaf alone is brighter.
  leaf.albedo *= 2.7 / (1.0 + root_shade);
  // What comes down has met other leaves on its way.
  vec3 filtered = leaf.albedo / max(max(leaf.albedo.r, leaf.albedo.g), 1.0e-4);
  leaf.sky = mix(vec3(1.0), filtered, 0.5 - 0.35 * s);
  leaf.sun = 1.0;
  return leaf;
}

// A plant's light far away is the ground's. `ground`: its normal; melting, 0 the plant alone, 1 the ground alone.
vec3 melt_into_ground(vec3 lit, vec3 albedo, vec4 ground, vec3 point) {
  vec3 around =
      albedo * (ambient(ground.xyz) + sun_light(point) * max(dot(ground.xyz, frame.sun_direction.xyz), 0.0));
  return apply_haze(mix(lit, around, ground.w), point);
}

// Equation 14; `normal`: unit, on the viewer's side.
vec3 shade_leaf(Leaf leaf, LeafSun light, vec3 normal) {
  float facing = max(dot(normal, frame.sun_direction.xyz), 0.0);
  // Light that has passed a leaf is of its own colour once more, and yellower.
  float most = max(max(leaf.albedo.r, leaf.albedo.g), 1.0e-4);
  vec3 through_tint = leaf.albedo * (leaf.albedo / most * vec3(1.15, 1.1, 0.75) + 0.1);
  vec3 direct = leaf.albedo * facing + through_tint * light.through + vec3(light.shine);
  return ambient(normal) * leaf.albedo * leaf.sky + sun_light() * leaf.sun * direct;
}

// The same for a leaf without a way of its own, which has a spot instead of a streak: `own` is its normal, `shading`
// that mixed with the ground's; both unit, on the viewer's side.
vec3 shade_leaf(SpeciesParams species, Leaf leaf, vec3 own, vec3 shading, vec3 to_eye) {
  vec3 sun = frame.sun_direction.xyz;
  vec3 half_way = normalize(to_eye + sun);
  float aside = 1.0 - min(dot(own, half_way) * dot(own, half_way), 1.0);
  LeafSun light;
  light.through = leaf_through(species.optics, dot(own, sun), -dot(to_eye, sun));
  light.shine = leaf_streak(species.optics, sqrt(aside)) * leaf_gloss(own, half_way, to_eye);
  return shade_leaf(leaf, light, shading);
}

// Light from a leaf of a strip. `light`: canopy_light of sky and sun, leaf_through, cosine for leaf_streak; `gloss`:
// leaf_gloss; `normal`: for diffuse light, unit.
vec3 strip_leaf(SpeciesParams species, Leaf leaf, vec4 light, float gloss, vec3 normal) {
  leaf.sky *= light.x;
  leaf.sun *= light.y;
  return shade_leaf(leaf, LeafSun(light.z, leaf_streak(species.optics, light.w) * gloss), normal);
}
