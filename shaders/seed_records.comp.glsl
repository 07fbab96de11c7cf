// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding, last pass: TriangleRecord of seeding.h, six texels, for every candidate that submits seeds.
#include "common_seeding.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = SWARD_STORAGE_SEED_RECORDS) writeonly buffer SwardSeedRecords { uvec4 seed_records[]; };

shared uint bins[256];

void write_record(uint at, uint index, uvec2 count) {
  ivec3 place = candidate_place(index);
  SeedGround ground = seed_ground[table_place(place)];
  Candidate c = find_candidate(place);
  DrawnCandidate t = draw_candidate(c);
  seed_records[6u * at] = uvec4(floatBitsToUint(t.apex), c.id.x);
  seed_records[6u * at + 1u] = uvec4(floatBitsToUint(t.to_left), c.id.y);
  seed_records[6u * at + 2u] = uvec4(floatBitsToUint(t.to_right), 0u);
  seed_records[6u * at + 3u] = uvec4(uvec2(ground.texel), floatBitsToUint(ground.texel_fraction));
  seed_records[6u * at + 4u] = uvec4(count.y, floatBitsToUint(ground.slope), 0u, count.x);
  seed_records[6u * at + 5u] = uvec4(floatBitsToUint(ground.altitude.xyz), ground.exclusions);
}

void main() {
  uint index = gl_GlobalInvocationID.x, local = gl_LocalInvocationIndex;
  uvec2 count = index < candidates() ? seed_counts[index] : uvec2(0u);
  uint bin = count.x > 0u ? bin_of(count.x) : k_bins;
  bins[local] = bin;
  barrier();
  if (bin == k_bins) return;
  uint before = 0u;
  for (uint i = 0u; i < local; ++i) before += bins[i] == bin ? 1u : 0u;
  write_record(seed_groups[gl_WorkGroupID.x * k_bins + bin] + before, index, count);
}
