// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding on the GPU, over clipmap rings (Papavasiliou 2015, section 4: steps 2 and 3 of the sketch for geometry
// clipmaps): candidate triangles of a layer's level around the eye, what is known of them, the buffers between the
// passes. What seeding.cpp does on the CPU, for the same triangles with the same ids. GLSL only.
//
//  seed_count    a thread a candidate: corners, culling, the layer's law -> seeds; smallest and largest number
//  seed_edges    the 32 geometric bins between them
//  seed_bins     a row of bin sizes a work group
//  seed_layout   where each group's records of each bin begin; the indirect draws
//  seed_records  a thread a candidate: its record to its place; the order is that of candidates, in every run
#include "common_clipmap.glsl"

const uint k_bins = 32u;
const int k_root_side = 262144;

// Mirror of SeedingUniforms in clipmap_seeder_buffers.h.
layout(std140, binding = SWARD_BINDING_SEEDING) uniform SwardSeeding {
  dvec2 origin;     // of the data's middle, world, metres
  dvec2 spacing;    // between samples, metres
  dvec2 middle;     // of the data, samples: half of columns - 1, of rows - 1
  dvec2 eye_xy;     // world
  dvec2 scale;      // samples a lattice unit; how far plants and shadows reach aside (m)
  vec4 plane[6];    // halfspaces of the frustum, relative to the eye
  mat4 clip;        // clip from relative to the eye
  ivec4 window;     // first column and row of cells around the eye, columns, rows
  ivec4 cell;       // log2 of a cell's side in lattice units, triangles a cell, masks of the table's columns and rows
  ivec4 level;      // seeding level; cells along a root square's side, log2; candidates; work groups
  vec4 law;         // law (0 distance, 1 screen area, 2 world area), rho0, d0 times zoom, gamma
  vec4 reach;       // horizon times zoom, cluster size, 1 if plain, ceiling
  vec4 view;        // focal length of clip space (y), aspect, canopy (m), most seeds
} sward_seeding;

// What is static of a triangle of the table, mirror of SeedGround in clipmap_table.h.
struct SeedGround {
  ivec2 texel;
  vec2 texel_fraction;
  float area;       // 0: no plant stands on it
  float slope;
  float bound;      // how far the finest surface leaves the triangle, metres
  uint exclusions;
  vec4 altitude;
};

struct DrawCommand {
  uint count, instance_count, first, base_instance;
};

layout(std430, binding = SWARD_STORAGE_SEED_GROUND) readonly buffer SwardSeedGround { SeedGround seed_ground[]; };
layout(std430, binding = SWARD_STORAGE_SEED_COUNTS) buffer SwardSeedCounts { uvec2 seed_counts[]; };
layout(std430, binding = SWARD_STORAGE_SEED_GROUPS) buffer SwardSeedGroups { uint seed_groups[]; };
layout(std430, binding = SWARD_STORAGE_SEED_FRAME) buffer SwardSeedFrame {
  uint n_min, n_max, seeded, visible;
  uint clusters, unused_a, unused_b, unused_c;
  float edges[32];          // of the bins, smallest first
  DrawCommand commands[32];  // in drawing order: largest count first
} seed_frame;

struct Candidate {
  ivec2 apex, left, right;  // lattice points
  uvec2 id;
};

uint candidates() { return uint(sward_seeding.level.z); }

// A candidate's cell in the window around the eye, and which of its triangles.
ivec3 candidate_place(uint index) {
  uint a_cell = uint(sward_seeding.cell.y);
  uint cell = index / a_cell, columns = uint(sward_seeding.window.z);
  return ivec3(sward_seeding.window.xy + ivec2(int(cell % columns), int(cell / columns)), int(index % a_cell));
}

uint table_place(ivec3 place) {
  ivec2 wrapped = place.xy & sward_seeding.cell.zw;
  return uint((wrapped.y * (sward_seeding.cell.z + 1) + wrapped.x) * sward_seeding.cell.y + place.z);
}

// A point inside of a cell's triangle, in sixths of the cell's side from its north-western corner. Cells of even levels
// are halved along the diagonal from even to odd corners (a root square from south-west to north-east), cells of odd
// levels quartered.
ivec2 point_in_candidate(ivec2 cell, int triangle) {
  if (sward_seeding.cell.y == 4) {
    if (triangle == 0) return ivec2(3, 1);
    if (triangle == 1) return ivec2(5, 3);
    return triangle == 2 ? ivec2(3, 5) : ivec2(1, 3);
  }
  if (falls_east(cell) && sward_seeding.level.y > 0) return triangle == 0 ? ivec2(4, 2) : ivec2(2, 4);
  return triangle == 0 ? ivec2(2, 2) : ivec2(4, 4);
}

// Down from the root to the triangle of the seeding level around the point: sward::TriangleId.
Candidate find_candidate(ivec3 place) {
  int side = 1 << sward_seeding.cell.x;
  ivec2 corner = place.xy << sward_seeding.cell.x;
  ivec2 square = corner >> 18, origin = square << 18;
  ivec2 point = 6 * (corner - origin) + side * point_in_candidate(place.xy, place.z);
  bool second = point.x + point.y > 6 * k_root_side;
  ivec2 nw = ivec2(0), ne = ivec2(k_root_side, 0), sw = ivec2(0, k_root_side), se = ivec2(k_root_side);
  ivec2 apex = second ? se : nw, left = second ? ne : sw, right = second ? sw : ne;
  uint high_turns = 0u, low_turns = 0u;
  for (int level = 0; level < sward_seeding.level.x; ++level) {
    ivec2 middle = left + (right - left) / 2;
    ivec2 towards = sign(left - right), offset = point - 6 * middle;
    ivec2 old_apex = apex;
    apex = middle;
    if (towards.x * offset.x + towards.y * offset.y > 0) {
      right = left;
      left = old_apex;
    } else {
      left = right;
      right = old_apex;
      int bit = 34 - level;
      if (bit >= 32) high_turns |= 1u << uint(bit - 32);
      else low_turns |= 1u << uint(bit);
    }
  }
  uint high = uint(sward_seeding.level.x) << 26u | (second ? 1u << 25u : 0u) | uint(square.x + 1024) << 14u |
              uint(square.y + 1024) << 3u | high_turns;
  return Candidate(origin + apex, origin + left, origin + right, uvec2(low_turns, high));
}

// Lattice::world_xy, to the bit.
dvec2 world_xy(ivec2 p) {
  precise dvec2 samples = dvec2(p) * sward_seeding.scale.x;
  precise double x = sward_seeding.origin.x + (samples.x - sward_seeding.middle.x) * sward_seeding.spacing.x;
  precise double y = sward_seeding.origin.y + (sward_seeding.middle.y - samples.y) * sward_seeding.spacing.y;
  return dvec2(x, y);
}

// A candidate on the drawn surface; x and y have the bits of the CPU's.
struct DrawnCandidate {
  vec3 apex, to_left, to_right;
};

DrawnCandidate draw_candidate(Candidate c) {
  dvec2 apex = world_xy(c.apex), left = world_xy(c.left), right = world_xy(c.right);
  precise dvec2 from_eye = apex - sward_seeding.eye_xy;
  precise dvec2 to_left = left - apex, to_right = right - apex;
  float z = clipmap_surface_at(c.apex, vec2(0.0)).z;
  float z_left = clipmap_surface_at(c.left, vec2(0.0)).z, z_right = clipmap_surface_at(c.right, vec2(0.0)).z;
  return DrawnCandidate(vec3(vec2(from_eye), z), vec3(vec2(to_left), z_left - z), vec3(vec2(to_right), z_right - z));
}

// The first bin, smallest first, whose upper edge reaches a count; in drawing order.
uint bin_of(uint submitted) {
  uint bin = 0u;
  while (bin < k_bins - 1u && float(submitted) > seed_frame.edges[bin]) ++bin;
  return k_bins - 1u - bin;
}
