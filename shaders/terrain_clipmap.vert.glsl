// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A point of a clipmap's ring. An instance is a block of cells, an index a point of it.
#include "common_frame.glsl"
#include "common_clipmap.glsl"

layout(location = 0) in ivec4 block;  // ring; first column and row of cells in its window; cells a side

layout(binding = SWARD_BINDING_CLIPMAP_RELIEF) uniform sampler2DArray sward_clipmap_relief;

layout(location = 0) out vec3 relative_position;
layout(location = 1) out vec2 relief;
out float gl_CullDistance[1];

// On the outer border every other point moves onto its neighbour, so that edges are those of the coarser ring: what is
// left there are triangles of the bintree's odd level between the two rings.
ivec2 join_border(ivec2 column, int cells) {
  if (column.x == 0 || column.x == cells) column.y &= ~1;
  if (column.y == 0 || column.y == cells) column.x &= ~1;
  return column;
}

void main() {
  int ring = block.x;
  int cells = sward_clipmap.grid.x;
  ivec2 column = block.yz + ivec2(gl_VertexID % (block.w + 1), gl_VertexID / (block.w + 1));
  if (ring < sward_clipmap.grid.z - 1) column = join_border(column, cells);
  ivec2 point = sward_clipmap.ring[ring].xy + column;

  precise vec2 xy = clipmap_xy(point << sward_clipmap.ring[ring].z);
  precise float z = clipmap_point_height(ring, point);
  relative_position = vec3(xy, z);
  relief = vec2(0.0);
  if (sward_clipmap.ring[ring].w != 0)
    relief = texelFetch(sward_clipmap_relief, ivec3(point & sward_clipmap.grid.y, ring), 0).rg;
  gl_Position = frame.clip_from_relative * vec4(relative_position, 1.0);

  // Triangles with all corners in what the finer ring covers, its border included, are the finer ring's.
  gl_CullDistance[0] = 1.0;
  if (ring > sward_clipmap.grid.w) {
    ivec2 hole = sward_clipmap.ring[ring - 1].xy / 2;
    bool inside = all(greaterThanEqual(point, hole)) && all(lessThanEqual(point, hole + cells / 2));
    gl_CullDistance[0] = inside ? -1.0 : 1.0;
  }
}
