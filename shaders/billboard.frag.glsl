// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of shrubs and trees: leaves of a cluster, or bark. Leaves are ellipses strewn over the square, fewer towards its
// rim; where they are smaller than pixels their mean takes their place.
#include "common_object_shade.glsl"

const float k_leaf_m = 0.055;  // half a leaf's length
const float k_sprays = 3.5;    // sprays of leaves along half the square

bool is_trunk() { return part_mask.w > 500.0; }

// What the nearest of the leaves around a place is: found or not, its number, place across it.
struct LeafHit {
  float found, number;
  vec2 across;
};

uint cluster_number() { return uint(part_self.z * 16777216.0) + uint(part_mask.w + 0.5) * 7919u; }

// `cells`: leaves along half the square; `soft`: width of their edges in cells.
LeafHit find_leaf(vec2 at, float cells, float soft) {
  LeafHit hit = LeafHit(0.0, 0.5, vec2(0.0));
  vec2 place = at * cells;
  ivec2 home = ivec2(floor(place));
  float best = -1.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 cell = home + ivec2(i % 3 - 1, i / 3 - 1);
    uint own = uint(cell.x + 64) * 131u + uint(cell.y + 64) + cluster_number();
    float number = hash_unit(uvec2(own, 1u));
    vec2 centre = vec2(cell) + 0.5 + 0.6 * (vec2(hash_unit(uvec2(own, 2u)), hash_unit(uvec2(own, 3u))) - 0.5);
    // Leaves thin out towards the rim.
    if (length(centre) / cells > 0.45 + 0.5 * hash_unit(uvec2(own, 4u))) continue;
    float turn = 6.2831853 * hash_unit(uvec2(own, 5u));
    vec2 d = place - centre;
    vec2 across = vec2(d.x * cos(turn) + d.y * sin(turn), d.y * cos(turn) - d.x * sin(turn)) / vec2(0.95, 0.5);
    float inside = clamp((1.0 - length(across)) / max(soft, 0.05) + 0.5, 0.0, 1.0);
    if (inside <= 0.0 || number < best) continue;
    best = number;
    hit = LeafHit(max(hit.found, inside), number, across);
  }
  return hit;
}

LeafHit found_leaf;

float object_cover(bool shadow) {
  found_leaf = LeafHit(1.0, 0.5, vec2(0.0));
  if (is_trunk()) return 1.0;
  vec2 at = part_mask.xy;
  float radius = length(at);
  if (shadow) return 0.85 * (1.0 - smoothstep(0.35, 1.0, radius));
  if (has_cutout()) return cutout_cover(vec2(at.x, 0.5 + 0.5 * at.y));
  // Leaves, sprays of leaves, and their mean, each while it is larger than a pixel.
  float leaves = clamp((-1.0 - part_self.w) / k_leaf_m, 4.0, 18.0);
  float footprint = max(part_footprint.x, part_footprint.y);
  float fine = 1.0 - smoothstep(0.45, 1.0, footprint * leaves);
  float coarse = 1.0 - smoothstep(0.45, 1.0, footprint * k_sprays);
  float cover = mix(1.0 - smoothstep(0.55, 0.98, radius), 0.5, smoothstep(0.4, 1.2, footprint));
  LeafHit spray = found_leaf;
  if (coarse > 0.0 && fine < 1.0) {
    spray = find_leaf(at, k_sprays, 2.0 * footprint * k_sprays);
    cover = mix(cover, spray.found, coarse);
    spray.number = mix(0.5, spray.number, coarse);
  }
  found_leaf = spray;
  if (fine > 0.0) {
    LeafHit leaf = find_leaf(at, leaves, 2.0 * footprint * leaves);
    cover = mix(cover, leaf.found, fine);
    found_leaf = LeafHit(cover, mix(spray.number, leaf.number, fine), leaf.across * fine);
  }
  return cover;
}

vec3 bark_radiance(vec3 normal) {
  float light = dot(part_color.rgb, vec3(0.2126, 0.7152, 0.0722));
  vec2 place = vec2(asin(clamp(part_mask.x, -1.0, 1.0)) + 40.0 * part_self.z, 9.0 * part_mask.y);
  float rough = 1.0 + 0.8 * ground_noise(place, 2.0, 31u).x * (1.0 - smoothstep(0.1, 0.4, 2.0 * part_footprint.x));
  vec3 bark = rough * light * vec3(0.80, 0.66, 0.52) * mix(0.7, 1.1, fract(part_self.z * 19.3));
  float facing = max(dot(normal, frame.sun_direction.xyz), 0.0);
  float open = mix(0.75, 0.35, clamp(part_mask.y * 2.0, 0.0, 1.0));
  return bark * open * (ambient(normal) + sun_light(part_point.xyz) * 0.7 * facing);
}

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  vec3 normal = normalize(part_normal.xyz);
  if (is_trunk()) return bark_radiance(normal);
  float age = part_color.w, number = found_leaf.number;
  float tree = mix(0.82, 1.18, fract(part_self.z * 7.31));
  Leaf leaf;
  leaf.albedo = part_color.rgb * mix(species.tint.rgb, species.age_tint.rgb, age) * tree;
  leaf.albedo *= (0.78 + 0.44 * number) * (1.0 - 0.15 * found_leaf.across.x);
  leaf.albedo *= image_detail(vec2(part_mask.x, 0.5 + 0.5 * part_mask.y));
  float open = part_normal.w;
  // The crown's own shadow: the side away from the sun, and what lies within.
  float sunny = smoothstep(-0.75, 0.65, dot(normal, frame.sun_direction.xyz));
  leaf.sky = vec3(mix(species.age_tint.w, 1.0, open));
  leaf.sun = sunny * mix(species.age_tint.w, 1.0, open * open);
  vec2 tilt = 1.2 * (vec2(fract(number * 53.0), fract(number * 97.0)) - 0.5);
  vec3 own = normalize(normal + vec3(tilt, 0.3 * (number - 0.5)));
  leaf.sun *= body_light(part_ground.xyz, part_point.xyz);
  return shade_leaf(species, leaf, own, normalize(mix(own, part_ground.xyz, 0.8 * part_ground.w)), to_eye);
}
