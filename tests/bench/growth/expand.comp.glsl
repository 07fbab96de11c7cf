// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// For the benchmark of growth: the control stage's work, an invocation a seed, with what grows appended to lists by
// number of segments instead of handed to the tessellator.
#include "common_grow.glsl"
#include "common_blade.glsl"
#include "common_ground.glsl"
#include "common_worth.glsl"

layout(local_size_x = 64) in;

layout(location = 1) uniform uint cluster_count;
layout(location = 2) uniform uint list_size;  // blades that a list can hold

layout(std430, binding = 0) readonly buffer Clusters { uvec4 clusters[]; };
struct Draw {
  uint count, instances, first_index;
  int base_vertex;
  uint base_instance;
};
layout(std430, binding = 1) buffer Draws { Draw draws[SWARD_LISTS]; };
layout(std430, binding = 2) writeonly buffer Blades { vec4 blades[]; };
// Seeds: of fertile clusters; beyond their law's count; too small or outside of the frustum; on ground that is not
// theirs; grown.
layout(std430, binding = 3) buffer Counts { uint counts[5]; };

layout(binding = SWARD_BINDING_BASE_MAP) uniform sampler2D sward_base_map;

void count(uint what) {
  if (SWARD_COUNTED == 1) atomicAdd(counts[what], 1u);
}

// Fractional odd spacing of this level has as many segments.
uint odd_segments(float level) { return level <= 1.0 ? 1u : 2u * uint(ceil(0.5 * (level - 1.0))) + 1u; }

void main() {
  uint cluster = gl_GlobalInvocationID.x / uint(SWARD_CLUSTER_SIZE);
  uint line = gl_GlobalInvocationID.x % uint(SWARD_CLUSTER_SIZE);
  if (cluster >= cluster_count) return;
  FertileCluster fertile = unpack_cluster(clusters[cluster]);
  Triangle triangle = fetch_triangle(fertile.record);
  count(0u);
  Seedling s = place_seed(fertile, triangle, line);
  if (s.presence.fade <= 0.0) {
    count(1u);
    return;
  }
  SpeciesParams species = sward_layer.species[sward_species];
  if (!worth_growing(s, species.size.y)) {
    count(2u);
    return;
  }
  s = grow_seed(fertile, triangle, s);
  if (s.presence.fade <= 0.0) {
    count(3u);
    return;
  }
  count(4u);
  uint segments = odd_segments(segment_count(species, sward_layer.layer, s.distance));
  uint list = min((segments - 1u) / 2u, uint(SWARD_LISTS - 1));
  uint indices = 6u * segments - 3u;
  uint slot = atomicAdd(draws[list].count, indices) / indices;
  if (slot >= list_size) return;
  vec2 azimuth = vec2(cos(s.traits.azimuth), sin(s.traits.azimuth));
  float slope = -dot(s.ground_normal.xy, azimuth) / s.ground_normal.z;
  BladeCurve curve = free_curve(s.traits.stiffness, s.traits.lean, slope);
  vec3 color = ground_albedo(sward_base_map, s.map_uv, s.root, s.ground_normal);
  uint at = 4u * (list * list_size + slot);
  blades[at] = vec4(s.root, s.traits.height * s.presence.fade);
  blades[at + 1u] = vec4(0.5 * s.traits.width * s.presence.grow * s.presence.widen, s.traits.stiffness,
                         s.traits.azimuth, s.traits.lean);
  blades[at + 2u] = vec4(s.ground_normal.xy, find_contact(curve), s.traits.phase);
  blades[at + 3u] = vec4(color, s.traits.age);
}
