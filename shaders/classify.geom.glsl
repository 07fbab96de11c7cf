// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Sorts clusters by species: one feedback stream each for the four growing species of this pass.
#include "common_layer.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;

layout(location = 0) uniform int sward_first_growing;  // ordinal of the pass's first growing species

layout(location = 0) in ClusterOut {
  flat uvec4 words;
  flat int species;
} cluster_in[];

layout(xfb_buffer = 0, xfb_stride = 16) out;
layout(xfb_buffer = 1, xfb_stride = 16) out;
layout(xfb_buffer = 2, xfb_stride = 16) out;
layout(xfb_buffer = 3, xfb_stride = 16) out;
layout(stream = 0, xfb_buffer = 0, xfb_offset = 0) out uvec4 sward_words_0;
layout(stream = 1, xfb_buffer = 1, xfb_offset = 0) out uvec4 sward_words_1;
layout(stream = 2, xfb_buffer = 2, xfb_offset = 0) out uvec4 sward_words_2;
layout(stream = 3, xfb_buffer = 3, xfb_offset = 0) out uvec4 sward_words_3;

void main() {
  int species = cluster_in[0].species;
  if (species < 0) return;
  uvec4 words = cluster_in[0].words;
  switch (int(sward_layer.species[species].kind.w) - sward_first_growing) {
    case 0:
      sward_words_0 = words;
      EmitStreamVertex(0);
      EndStreamPrimitive(0);
      break;
    case 1:
      sward_words_1 = words;
      EmitStreamVertex(1);
      EndStreamPrimitive(1);
      break;
    case 2:
      sward_words_2 = words;
      EmitStreamVertex(2);
      EndStreamPrimitive(2);
      break;
    case 3:
      sward_words_3 = words;
      EmitStreamVertex(3);
      EndStreamPrimitive(3);
      break;
  }
}
