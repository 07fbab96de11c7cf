// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The surface that clipmap rings draw (Losasso and Hoppe 2004): sward::ClipmapRings, as its class comment describes
// them. GLSL only.
layout(std140, binding = SWARD_BINDING_CLIPMAP) uniform SwardClipmap {
  ivec4 grid;      // cells a side of a ring; mask of its memory's indices; rings; the finest that is drawn
  ivec4 from;      // xy: the lattice point that places count from, near the eye
  vec4 place;      // metres a lattice unit east and north (negative); xy of that point, relative to the eye
  vec4 eye;        // xy: the rings' eye, in lattice units from that point
  vec4 height;     // the heights' origin, relative to the eye; where melting begins (cells), 1 / its width; the finest's
  ivec4 ring[20];  // first column, row; log2 of a cell's side in lattice units; 1 where it has relief
} sward_clipmap;

layout(binding = SWARD_BINDING_CLIPMAP_HEIGHTS) uniform sampler2DArray sward_clipmap_heights;

// Metres from the eye. The same lattice point has the same bits from every ring.
vec2 clipmap_xy(ivec2 lattice) {
  precise vec2 xy = vec2(lattice - sward_clipmap.from.xy) * sward_clipmap.place.xy + sward_clipmap.place.zw;
  return xy;
}

float clipmap_fetch(int ring, ivec2 point) {
  return texelFetch(sward_clipmap_heights, ivec3(point & sward_clipmap.grid.y, ring), 0).r;
}

// True where the diagonal of a cell runs from the north-west to the south-east.
bool falls_east(ivec2 cell) { return ((cell.x + cell.y) & 1) == 0; }

// The coarser ring's surface at a point of this ring.
float clipmap_coarser(int ring, ivec2 point) {
  ivec2 odd = point & 1;
  ivec2 a = point >> 1;
  ivec2 b = a + odd;
  if (odd.x + odd.y == 2 && !falls_east(a)) {
    b = a + ivec2(0, 1);
    a += ivec2(1, 0);
  }
  precise float z = 0.5 * (clipmap_fetch(ring + 1, a) + clipmap_fetch(ring + 1, b));
  return z;
}

// How far a point of a ring has melted into the coarser one.
float clipmap_melt(int ring, ivec2 point) {
  if (ring == sward_clipmap.grid.z - 1) return 0.0;
  int side = sward_clipmap.ring[ring].z;
  vec2 away = abs(vec2((point << side) - sward_clipmap.from.xy) - sward_clipmap.eye.xy) / float(1 << side);
  float melt = clamp((max(away.x, away.y) - sward_clipmap.height.y) * sward_clipmap.height.z, 0.0, 1.0);
  return ring == sward_clipmap.grid.w ? max(melt, sward_clipmap.height.w) : melt;
}

// Height of a ring's point as it is drawn, relative to the eye.
float clipmap_point_height(int ring, ivec2 point) {
  float z = clipmap_fetch(ring, point);
  float melt = clipmap_melt(ring, point);
  // Not by mix(): what has melted is the coarser ring's to the bit.
  if (melt >= 1.0) z = clipmap_coarser(ring, point);
  else if (melt > 0.0) z += (clipmap_coarser(ring, point) - z) * melt;
  return z + sward_clipmap.height.x;
}

// The drawn surface at a place: its height relative to the eye and its gradient (dz/dx, dz/dy).
struct ClipmapPoint {
  float z;
  vec2 gradient;
};

// At a lattice point and `rest` units from it, each in [0, 1).
ClipmapPoint clipmap_surface_at(ivec2 lattice, vec2 rest) {
  // The finest ring around the place.
  int ring = sward_clipmap.grid.w;
  ivec2 cell = lattice >> sward_clipmap.ring[ring].z;
  for (; ring < sward_clipmap.grid.z - 1; ++ring) {
    cell = lattice >> sward_clipmap.ring[ring].z;
    ivec2 column = cell - sward_clipmap.ring[ring].xy;
    if (all(greaterThanEqual(column, ivec2(0))) && all(lessThan(column, ivec2(sward_clipmap.grid.x)))) break;
  }
  int shift = sward_clipmap.ring[ring].z;
  cell = lattice >> shift;
  float side = float(1 << shift);
  vec2 t = (vec2(lattice - (cell << shift)) + rest) / side;
  // The two ends of the diagonal and the corner on the place's side of it.
  bool falls = falls_east(cell);
  bool first = falls ? t.x >= t.y : t.x + t.y <= 1.0;
  float slope_x, slope_y, z;
  if (falls) {
    float nw = clipmap_point_height(ring, cell), se = clipmap_point_height(ring, cell + ivec2(1, 1));
    float corner = clipmap_point_height(ring, cell + (first ? ivec2(1, 0) : ivec2(0, 1)));
    slope_x = first ? corner - nw : se - corner;
    slope_y = first ? se - corner : corner - nw;
    z = nw + slope_x * t.x + slope_y * t.y;
  } else {
    float ne = clipmap_point_height(ring, cell + ivec2(1, 0)), sw = clipmap_point_height(ring, cell + ivec2(0, 1));
    float corner = clipmap_point_height(ring, cell + (first ? ivec2(0, 0) : ivec2(1, 1)));
    slope_x = first ? ne - corner : corner - sw;
    slope_y = first ? sw - corner : corner - ne;
    float nw = first ? corner : ne + sw - corner;
    z = nw + slope_x * t.x + slope_y * t.y;
  }
  return ClipmapPoint(z, vec2(slope_x, slope_y) / (side * sward_clipmap.place.xy));
}

// At a place relative to the eye, metres.
ClipmapPoint clipmap_surface(vec2 xy) {
  vec2 units = (xy - sward_clipmap.place.zw) / sward_clipmap.place.xy;
  vec2 whole = floor(units);
  return clipmap_surface_at(sward_clipmap.from.xy + ivec2(whole), units - whole);
}
