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

// Where the presence's fade is 0 nothing stands, and the rest may be undefined.
struct Seedling {
  vec2 offset;         // from the triangle's apex, metres east and north
  vec3 root;           // relative to the eye
  float distance;      // from the eye
  vec3 ground_normal;  // of the drawn surface
  vec2 map_uv;         // of the base map
  uint rank;
  Presence presence;
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

// A seed's place, and whether it is there at this distance; `triangle` is the cluster's.
Seedling place_seed(FertileCluster fertile, Triangle triangle, uint line) {
  Seedling s;
  s.presence = absent();
  s.rank = fertile.index * cluster_size() + line;
  if (s.rank >= triangle.submitted) return s;
  Cluster cluster = make_cluster(triangle.id, fertile.index);
  vec2 point = seed_point(triangle.id, s.rank, cluster);
  SurfacePoint surface = surface_at(triangle, point);
  s.offset = offset_from_apex(triangle.to_left, triangle.to_right, point);
  s.root = vec3(triangle.apex.xy + s.offset, surface.z);
  s.distance = seed_distance(triangle.apex, s.offset, surface.z);
  s.ground_normal = surface.normal;
  s.presence = seed_presence(sward_layer.layer, triangle.limit, triangle.id, s.rank, s.distance);
  return s;
}

// Gives a placed seed its traits. Masks, water and bare ground are sharper than a cluster: the seed's own ground has a
// say, and where it says no, fade comes back 0.
Seedling grow_seed(FertileCluster fertile, Triangle triangle, Seedling s) {
  if (classify_ground(ground_color(triangle, s.offset), fertile.z).species < 0) {
    s.presence = absent();
    return s;
  }
  s.map_uv = map_coordinates(triangle, s.offset);
  s.traits = make_traits(sward_layer.species[sward_species], frame_layer(), triangle.id, s.rank, fertile.score);
  return s;
}
