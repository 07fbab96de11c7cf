// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Clusters and seeds on a triangle: hierarchical strata (Papavasiliou 2015, section 3.4, equations 19-25). Read by GLSL
// and C++. Points are weights (a, b): apex + a (left - apex) + b (right - apex).

SWARD_FN uint pyramidal(uint n) { return n * (n + 1u) * (2u * n + 1u) / 6u; }

// Strata along a side for the cluster of index 0, 1, ...: the smallest n with pyramidal(n) >= i, i = cluster + 1, which
// is the root of equation 21 rounded up; integers decide, so that rounding cannot. Equation 22, ceil(cbrt(3 i) - 1/2),
// is the same up to i = 650; from there it is one less for the first (2 n + 1) / 24 clusters of a side.
SWARD_FN uint strata_side(uint cluster) {
  uint i = cluster + 1u;
  uint n = max(uint(pow(3.0f * float(i), 0.33333333f)), 1u);
  while (pyramidal(n) < i) ++n;
  while (n > 1u && pyramidal(n - 1u) >= i) --n;
  return n;
}

struct Cluster {
  uvec2 stratum;  // column, row
  uint side;      // strata along a side
  float z;        // chooses the second species when below its share
};

SWARD_FN Cluster make_cluster(uvec2 id, uint cluster) {
  uvec2 pair = random_pair(cluster | k_cluster_space, id);
  Cluster c;
  c.side = strata_side(cluster);
  uint cell = mul_wide(pair.x, c.side * c.side).y;  // uniform in [0, side^2)
  c.stratum = uvec2(cell % c.side, cell / c.side);
  c.z = uniform_float(pair.y);
  return c;
}

// Equations 23 and 24: the half of the unit square beyond the diagonal is reflected onto the other.
SWARD_FN vec2 reflect_onto_triangle(vec2 r) {
  SWARD_PRECISE float sum = r.x + r.y;
  if (sum < 1.0f) return r;
  SWARD_PRECISE vec2 mirrored = vec2(1.0f - r.y, 1.0f - r.x);
  return mirrored;
}

SWARD_FN vec2 point_in_stratum(Cluster c, uvec2 pair) {
  SWARD_PRECISE float side = float(c.side);
  SWARD_PRECISE vec2 r = vec2(float(c.stratum.x) + uniform_float(pair.x), float(c.stratum.y) + uniform_float(pair.y));
  SWARD_PRECISE vec2 scaled = vec2(r.x / side, r.y / side);
  return reflect_onto_triangle(scaled);
}

SWARD_FN vec2 cluster_centre(uvec2 id, uint cluster, Cluster c) {
  return point_in_stratum(c, random_pair(cluster | k_cluster_space | k_sequence_space, id));
}

SWARD_FN vec2 seed_point(uvec2 id, uint rank, Cluster c) { return point_in_stratum(c, random_pair(rank, id)); }

// Metres east and north of the apex.
SWARD_FN vec2 offset_from_apex(vec3 to_left, vec3 to_right, vec2 point) {
  SWARD_PRECISE vec2 offset =
      vec2(to_left.x * point.x + to_right.x * point.y, to_left.y * point.x + to_right.y * point.y);
  return offset;
}

// Distance from the eye to the point at `offset` from an apex relative to the eye, on ground at height `z` above the eye.
SWARD_FN float seed_distance(vec3 apex, vec2 offset, float z) {
  SWARD_PRECISE float x = apex.x + offset.x;
  SWARD_PRECISE float y = apex.y + offset.y;
  SWARD_PRECISE float squared = x * x + y * y + z * z;
  return sqrt(squared);
}

// One step down the drawn surface below a triangle: corner heights and the point's weights. Child 0 is
// (m, apex, left), child 1 (m, right, apex), m the middle of left-right.
struct SurfaceWalk {
  float z_apex, z_left, z_right;
  float w_apex, w_left, w_right;
};

SWARD_FN SurfaceWalk begin_walk(float z_apex, float z_left, float z_right, vec2 point) {
  SurfaceWalk w;
  w.z_apex = z_apex;
  w.z_left = z_left;
  w.z_right = z_right;
  w.w_left = point.x;
  w.w_right = point.y;
  w.w_apex = 1.0f - point.x - point.y;
  return w;
}

SWARD_FN uint walk_turn(SurfaceWalk w) { return w.w_left >= w.w_right ? 0u : 1u; }

SWARD_FN SurfaceWalk walk_down(SurfaceWalk w, float z_middle) {
  SurfaceWalk child;
  child.z_apex = z_middle;
  if (walk_turn(w) == 0u) {
    child.z_left = w.z_apex;
    child.z_right = w.z_left;
    child.w_apex = 2.0f * w.w_right;
    child.w_left = w.w_apex;
    child.w_right = w.w_left - w.w_right;
  } else {
    child.z_left = w.z_right;
    child.z_right = w.z_apex;
    child.w_apex = 2.0f * w.w_left;
    child.w_left = w.w_right - w.w_left;
    child.w_right = w.w_apex;
  }
  return child;
}

SWARD_FN float walk_height(SurfaceWalk w) {
  return w.z_apex * w.w_apex + w.z_left * w.w_left + w.z_right * w.w_right;
}
