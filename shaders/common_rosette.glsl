// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Leaves of a rosette, lit as blades are. The kind's file defines relief and object_cover. GLSL only.
#include "common_object_shade.glsl"

// Factor on brightness: ribs, veins, bulges.
float relief();

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  float own = fract(part_self.z * 13.7 + part_mask.w * 0.381966);
  Leaf leaf = grass_leaf(species, part_color, part_mask.y, part_mask.x, own);
  leaf.albedo *= has_cutout() ? 1.0 : relief();
  leaf.albedo *= image_detail(part_mask.xy);
  leaf.sun *= body_light(part_ground.xyz, part_point.xyz);
  vec3 normal = normalize(part_normal.xyz);
  normal *= dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  Canopy canopy = canopy_of(sward_layer.layer, species, dot(part_ground.xyz, frame.sun_direction.xyz));
  vec2 light = canopy_light(canopy, max(part_point.w, 0.0));
  leaf.sky *= light.x;
  leaf.sun *= light.y;
  vec3 shading = normalize(mix(normal, part_ground.xyz, mix(0.2, 1.0, part_ground.w)));
  vec3 sun = frame.sun_direction.xyz;
  float gloss = leaf_gloss(normal, normalize(to_eye + sun), to_eye) * (1.0 - part_ground.w);
  LeafSun direct;
  direct.through = leaf_through(species.optics, dot(normal, sun), -dot(to_eye, sun));
  direct.shine = leaf_streak(species.optics, part_normal.w) * gloss;
  return shade_leaf(leaf, direct, shading);
}
