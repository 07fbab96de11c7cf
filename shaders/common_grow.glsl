// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A seed of a fertile cluster, from its numbers to a plant on the drawn surface. GLSL only.
#include "common_frame.glsl"
#include "common_ground_color.glsl"
#include "common_disturbance.glsl"
#include "common_disturbed_plant.glsl"

layout(location = 0) uniform int sward_species;  // index in the layer of what this program grows

// What classification feeds back: record, cluster, bits of the score s', bits of z.
struct FertileCluster {
  uint record;
  uint index;
  float score;
  float z;
  bool turning;  // to another species, as the season goes
};

FertileCluster unpack_cluster(uvec4 words) {
  float score = uintBitsToFloat(words.z);
  return FertileCluster(words.x, words.y, abs(score), uintBitsToFloat(words.w), score < 0.0);
}

// Where the presence's fade is 0 nothing stands, and the rest may be undefined.
struct Seedling {
  vec2 point;          // in weights of the triangle
  vec2 offset;         // from the triangle's apex, metres east and north
  vec3 root;           // relative to the eye
  float distance;      // from the eye
  vec3 ground_normal;  // of the drawn surface
  vec2 map_uv;         // of the base map
  vec3 own_color;      // of the surface below, sRGB; on meshes alone
  uint rank;
  Presence presence;
  PlantTraits traits;
  Disturbed disturbed;
  float left;          // share of its height that cuts and fire have left
};

// The sun's place moves with the frame, the rest of the layer's parameters with the view.
LayerParams frame_layer() {
  LayerParams layer = sward_layer.layer;
  layer.detail.w = atan(frame.sun_direction.y, frame.sun_direction.x);
  return layer;
}

vec2 map_coordinates(Triangle t, vec2 offset) {
  vec2 texel = vec2(t.texel) + t.texel_fraction + offset * sward_layer.layer.map.xy;
  return texel / sward_layer.layer.map.zw;
}

Presence absent() { return Presence(0.0, 0.0, 1.0); }

// A seed's place, and whether it is there at this distance; `triangle` is the cluster's.
Seedling place_seed(FertileCluster fertile, Triangle triangle, uint line) {
  Seedling s;
  s.presence = absent();
  s.rank = fertile.index * cluster_size() + line;
  if (s.rank >= triangle.submitted) return s;
  Cluster cluster = make_cluster(triangle.id, fertile.index);
  vec2 point = seed_point(triangle.id, s.rank, cluster);
  SurfacePoint surface = surface_at(triangle, point);
  s.point = point;
  s.offset = offset_from_apex(triangle.to_left, triangle.to_right, point);
  s.root = vec3(triangle.apex.xy + s.offset, surface.z);
  s.distance = seed_distance(triangle.apex, s.offset, surface.z);
  s.ground_normal = surface.normal;
  precise float limit = triangle.limit * sward_layer.species[sward_species].next.w;
  s.presence = seed_presence(sward_layer.layer, limit, triangle.id, s.rank, s.distance);
  return s;
}

// Share of a seed that stands: its own ground has a say, in rules that are sharper than a cluster.
float seed_share(FertileCluster fertile, Triangle t, Seedling s) {
  if (excluded(t.exclusions, s.offset)) return 0.0;
  LayerParams layer = sward_layer.layer;
  Site site = site_at(t, s.point);
  if (!site.open) return 0.0;
  precise float share =
      species_share(t, site, sward_layer.species[sward_species]) * mask_share(t, s.offset, layer.place.x);
  if (share < 1.0 && standing_number(random_pair(s.rank, t.id)) >= share) return 0.0;
  bool now = classify_site(t, site, fertile.z, false).species >= 0;
  if (layer.place.z == 0.0) return now ? 1.0 : 0.0;
  return season_presence(layer, now, classify_site(t, site, fertile.z, true).species >= 0, fertile.turning);
}

// What has touched the seed's place.
Seedling disturb_seed(Seedling s) {
  s.disturbed = undisturbed();
  s.left = 1.0;
#if !SWARD_ON_MESH
  if (!ground_is_disturbed()) return s;
  float yielding = yields(sward_layer.species[sward_species]);
  s.disturbed = disturbed_here(s.root);
  s.left = share_left(s.traits, s.disturbed, yielding);
  s.traits = disturb_traits(s.traits, s.disturbed, yielding, s.left);
#endif
  return s;
}

// Gives a placed seed its traits; where nothing stands, fade comes back 0.
Seedling grow_seed(FertileCluster fertile, Triangle triangle, Seedling s) {
  float share = seed_share(fertile, triangle, s);
  if (share <= 0.0) {
    s.presence = absent();
    return s;
  }
  s.presence.fade *= share;
  s.presence.grow *= share;
  s.map_uv = map_coordinates(triangle, s.offset);
  s.traits = make_traits(sward_layer.species[sward_species], frame_layer(), triangle.id, s.rank, fertile.score);
  s.traits.height *= height_share(triangle, s.offset);
#if SWARD_ON_MESH
  s.own_color = surface_color(triangle.texel, triangle.texel_fraction, s.point);
  s.traits = settle_traits(s.traits, triangle_normal(triangle.to_left, triangle.to_right));
#endif
  return disturb_seed(s);
}
