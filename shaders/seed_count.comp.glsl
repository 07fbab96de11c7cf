// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Seeding, first pass: which candidates are in sight, and how many seeds the layer's law gives each (equations 1 and 2;
// seeding.cpp says where it departs from them).
#include "common_seeding.glsl"

layout(local_size_x = 256) in;

shared uint group_min, group_max, group_seeded, group_visible;

bool in_frustum(DrawnCandidate t, float deviation) {
  for (int i = 0; i < 6; ++i) {
    vec4 plane = sward_seeding.plane[i];
    float most = dot(plane.xyz, t.apex) + plane.w +
                 max(max(dot(plane.xyz, t.to_left), dot(plane.xyz, t.to_right)), 0.0) +
                 max(plane.z, 0.0) * sward_seeding.view.z + abs(plane.z) * deviation +
                 length(plane.xy) * float(sward_seeding.scale.y);
    if (most < 0.0) return false;
  }
  return true;
}

float squared_distance_to_edge(vec3 a, vec3 ab) {
  float t = clamp(-dot(a, ab) / dot(ab, ab), 0.0, 1.0);
  vec3 p = a + t * ab;
  return dot(p, p);
}

// From the eye to the nearest point of the triangle: inside, on an edge or at a corner.
float distance_to_triangle(DrawnCandidate t) {
  vec3 normal = cross(t.to_left, t.to_right);
  float area2 = dot(normal, normal);
  float to_left = dot(cross(t.to_right, t.apex), normal), to_right = dot(cross(t.apex, t.to_left), normal);
  if (to_left >= 0.0 && to_right >= 0.0 && to_left + to_right <= area2)
    return abs(dot(t.apex, normal)) * inversesqrt(area2);
  vec3 left = t.apex + t.to_left;
  return sqrt(min(min(squared_distance_to_edge(t.apex, t.to_left), squared_distance_to_edge(t.apex, t.to_right)),
                  squared_distance_to_edge(left, t.to_right - t.to_left)));
}

// In units of half the viewport's height, squared; negative behind the near plane.
float projected_area(DrawnCandidate t) {
  vec3 corner[3] = vec3[3](t.apex, t.apex + t.to_left, t.apex + t.to_right);
  vec2 p[3];
  for (int i = 0; i < 3; ++i) {
    vec4 clip = sward_seeding.clip * vec4(corner[i], 1.0);
    if (dot(sward_seeding.plane[4].xyz, corner[i]) + sward_seeding.plane[4].w < 0.0 || clip.w <= 0.0) return -1.0;
    p[i] = vec2(clip.x * sward_seeding.view.y, clip.y) / clip.w;
  }
  vec2 u = p[1] - p[0], v = p[2] - p[0];
  return 0.5 * abs(u.x * v.y - u.y * v.x);
}

// Projected area seen from one unit ahead, as world_count() and steady_area() have it.
float seen_area(DrawnCandidate t, bool plain) {
  vec3 v = t.apex + (t.to_left + t.to_right) / 3.0;
  vec3 normal = 0.5 * cross(t.to_left, t.to_right);
  float area = length(normal), away = length(v);
  float facing = -dot(normal, v) / (area * away);
  if (plain) return max(facing, 0.0) * area / (away * away);
  float far = max(away, 2.0 * sward_seeding.law.z);
  return 0.5 * (facing + sqrt(facing * facing + 0.25)) * area / (far * far);
}

// Seeds of a triangle whose nearest point is `near` metres away, not rounded.
float limit_at(DrawnCandidate t, float area, float near) {
  float density = sward_seeding.law.y, ceiling = sward_seeding.reach.w;
  bool plain = sward_seeding.reach.z != 0.0;
  if (sward_seeding.law.x == 0.0)
    return area * density / pow(max(near / sward_seeding.law.z, 1.0), sward_seeding.law.w);
  if (sward_seeding.law.x == 2.0) return min(density * seen_area(t, plain), ceiling);
  float focal = sward_seeding.view.x;
  float screen = plain ? projected_area(t) : focal * focal * seen_area(t, false);
  return screen < 0.0 ? ceiling : min(density * pow(screen, sward_seeding.law.w), ceiling);
}

// In plain layers ground is left out whose plane is more than the canopy above the eye.
bool faces_away(DrawnCandidate t) {
  if (sward_seeding.reach.z == 0.0) return false;
  vec3 normal = cross(t.to_left, t.to_right);
  return -dot(normal, t.apex) < -sward_seeding.view.z * length(normal);
}

// Seeds to submit and the record's limit; the first 0 where nothing is in sight.
uvec2 count_seeds(uint index, out bool seen) {
  seen = false;
  ivec3 place = candidate_place(index);
  SeedGround ground = seed_ground[table_place(place)];
  if (ground.area == 0.0) return uvec2(0u);
  DrawnCandidate t = draw_candidate(find_candidate(place));
  float away = distance_to_triangle(t), horizon = sward_seeding.reach.x;
  bool plain = sward_seeding.reach.z != 0.0;
  // Of the drawn surface, which lies between the triangle and the finest one and may have melted: see the docs.
  float deviation = 3.0 * ground.bound;
  if (away > horizon || !in_frustum(t, deviation) || faces_away(t)) return uvec2(0u);
  seen = true;
  float limit = limit_at(t, ground.area, plain ? away : max(away - deviation, 0.0));
  uint submitted = uint(ceil(min(limit, sward_seeding.view.w)));
  precise float full = ground.area * sward_seeding.law.y;
  return uvec2(submitted, floatBitsToUint(sward_seeding.law.x == 0.0 ? full : limit));
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    group_min = 0xffffffffu;
    group_max = 0u;
    group_seeded = 0u;
    group_visible = 0u;
  }
  barrier();
  uint index = gl_GlobalInvocationID.x;
  if (index < candidates()) {
    bool seen;
    uvec2 count = count_seeds(index, seen);
    seed_counts[index] = count;
    if (seen) atomicAdd(group_visible, 1u);
    if (count.x > 0u) {
      atomicMin(group_min, count.x);
      atomicMax(group_max, count.x);
      atomicAdd(group_seeded, 1u);
    }
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u) return;
  if (group_visible > 0u) atomicAdd(seed_frame.visible, group_visible);
  if (group_seeded == 0u) return;
  atomicMin(seed_frame.n_min, group_min);
  atomicMax(seed_frame.n_max, group_max);
  atomicAdd(seed_frame.seeded, group_seeded);
}
