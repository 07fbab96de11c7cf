// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of plants that are small meshes: their own colours, tinted, lit as leaves are.
#include "common_object_shade.glsl"

layout(location = 6) in vec3 part_own_color;  // linear

float object_cover(bool shadow) { return 1.0; }

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  float own = 0.88 + 0.24 * fract(part_self.z * 7.31);
  Leaf leaf;
  leaf.albedo = part_own_color * mix(species.tint.rgb, species.age_tint.rgb, part_color.w) * own;
  Canopy canopy = canopy_of(sward_layer.layer, species, dot(part_ground.xyz, frame.sun_direction.xyz));
  vec2 light = canopy_light(canopy, max(part_point.w, 0.0));
  leaf.sky = vec3(light.x);
  leaf.sun = light.y * body_light(part_ground.xyz, part_point.xyz);
  vec3 normal = normalize(part_normal.xyz);
  normal *= dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  vec3 shading = normalize(mix(normal, part_ground.xyz, mix(0.1, 0.8, part_ground.w)));
  return shade_leaf(species, leaf, normal, shading, to_eye);
}
