// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Classification: a vertex is a triangle record, an instance a cluster on it (Papavasiliou 2015, sections 3.2 to 3.5).
#include "common_ground_color.glsl"

layout(location = 0) out ClusterOut {
  flat uvec4 words;  // record, cluster, bits of the score s' (negative: it turns to another species), bits of z
  flat int species;  // -1: nothing grows
} cluster_out;

void main() {
  uint record = uint(gl_VertexID);
  uint index = uint(gl_InstanceID);
  cluster_out.words = uvec4(record, index, 0u, 0u);
  cluster_out.species = -1;
  // A bin submits as many clusters as its upper edge needs; most triangles need fewer.
  if (index * cluster_size() >= fetch_submitted(record)) return;
  Triangle t = fetch_triangle(record);
  Cluster cluster = make_cluster(t.id, index);
  vec2 centre = cluster_centre(t.id, index, cluster);
  Choice choice = choose_cluster(t, centre, cluster.z);
  cluster_out.species = choice.species;
  cluster_out.words.zw = uvec2(floatBitsToUint(choice.score), floatBitsToUint(cluster.z));
}
