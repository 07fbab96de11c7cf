// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Leaves of a rosette, lit as blades are. The kind's file defines relief and object_cover. GLSL only.
#include "common_object_shade.glsl"

// Factor on brightness: ribs, veins, bulges.
float relief();

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  float own = fract(part_self.z * 13.7 + part_mask.w * 0.381966);
  Leaf leaf = grass_leaf(species, part_color, part_mask.y, part_mask.x, own);
  leaf.albedo *= relief();
  vec3 normal = normalize(part_normal.xyz);
  normal *= dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  return shade_leaf(species, leaf, normalize(mix(normal, part_ground.xyz, mix(0.2, 0.8, part_ground.w))), to_eye);
}
