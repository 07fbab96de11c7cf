// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of litter: what is left of a leaf, or bark. Dead leaves keep no colour of the ground, only its brightness.
#include "common_object_shade.glsl"

bool is_twig() { return part_mask.w > 0.5; }

// Half the outline's width: a short stalk, ragged edges, a drawn-out tip.
float outline(float s, float side) {
  float blade = clamp((s - 0.1) / 0.9, 0.0, 1.0);
  float lobes = 1.0 - 0.16 * abs(sin(blade * 9.0 + 1.7 * side + 6.0 * part_self.z));
  return max(sin(3.1415927 * pow(blade, 0.8)) * lobes, s < 0.3 ? 0.07 : 0.0);
}

float object_cover(bool shadow) {
  if (is_twig()) return 1.0;
  return edge_cover(outline(part_mask.y, sign(part_mask.x)) - abs(part_mask.x));
}

vec3 dead_leaf(SpeciesParams species) {
  float own = fract(part_self.z * 57.3), age = part_color.w;
  float light = dot(part_color.rgb, vec3(0.2126, 0.7152, 0.0722));
  // From straw over russet to dark and rotten.
  vec3 brown = mix(vec3(1.9, 1.25, 0.55), vec3(1.55, 0.78, 0.34), own);
  brown = mix(brown, vec3(0.75, 0.52, 0.34), smoothstep(0.35, 1.0, age));
  vec3 tint = mix(species.tint.rgb, species.age_tint.rgb, age);
  if (is_twig()) return light * tint * vec3(0.85, 0.68, 0.50) * mix(0.6, 1.1, own);
  float x = part_mask.x, s = part_mask.y;
  float fine = 1.0 - smoothstep(0.25, 0.6, part_footprint.y * 9.0);
  float veins = 0.16 * fine * sin(6.2831853 * (s * 9.0 - abs(x) * 2.0)) - 0.25 * exp(-90.0 * x * x);
  return light * tint * brown * (1.0 + veins) * mix(0.75, 1.25, fract(part_self.z * 211.1));
}

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  Leaf leaf;
  leaf.albedo = dead_leaf(species) * image_detail(part_mask.xy);
  leaf.sky = vec3(mix(species.age_tint.w, 1.0, 0.7));
  leaf.sun = 1.0;
  vec3 normal = normalize(part_normal.xyz);
  leaf.sun *= body_light(part_ground.xyz, part_point.xyz);
  normal *= dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  return shade_leaf(species, leaf, normal, normalize(mix(normal, part_ground.xyz, part_ground.w)), to_eye);
}
