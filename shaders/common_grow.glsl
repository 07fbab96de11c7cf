// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A seed of a fertile cluster, from its numbers to a plant on the drawn surface. GLSL only.
#include "common_frame.glsl"
#include "common_ground_color.glsl"

layout(location = 0) uniform int sward_species;  // index in the layer of what this program grows

// What classification feeds back: record, cluster, bits of the score s', bits of z.
struct FertileCluster {
  uint record;
  uint index;
  float score;
  float z;
};

FertileCluster unpack_cluster(uvec4 words) {
  return FertileCluster(words.x, words.y, uintBitsToFloat(words.z), uintBitsToFloat(words.w));
}

struct Seedling {
  vec3 root;           // relative to the eye
  float distance;      // from the eye
  vec3 ground_normal;  // of the drawn surface
  vec2 map_uv;         // of the base map
  uint rank;
  Presence presence;   // fade 0: nothing stands here
  PlantTraits traits;
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

// Seed `line` of a cluster. What cannot be seen or may not stand here comes back with fade 0, the rest of it undefined.
Seedling grow_seed(FertileCluster fertile, uint line) {
  Seedling s;
  s.presence = absent();
  s.rank = fertile.index * cluster_size() + line;
  if (s.rank >= fetch_submitted(fertile.record)) return s;

  Triangle t = fetch_triangle(fertile.record);
  Cluster cluster = make_cluster(t.id, fertile.index);
  vec2 point = seed_point(t.id, s.rank, cluster);
  vec2 offset = offset_from_apex(t.to_left, t.to_right, point);
  SurfacePoint surface = surface_at(t, point);
  s.root = vec3(t.apex.xy + offset, surface.z);
  s.distance = seed_distance(t.apex, offset, surface.z);
  Presence presence = seed_presence(sward_layer.layer, t.limit, t.id, s.rank, s.distance);
  if (presence.fade <= 0.0) return s;

  // Masks, water and bare ground are sharper than a cluster: the seed's own ground has a say.
  GroundColor ground = ground_color(t, offset);
  if (classify_ground(ground, fertile.z).species < 0) return s;

  s.presence = presence;
  s.ground_normal = surface.normal;
  s.map_uv = map_coordinates(t, offset);
  s.traits = make_traits(sward_layer.species[sward_species], frame_layer(), t.id, s.rank, fertile.score);
  return s;
}
