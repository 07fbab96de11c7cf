// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the wind is at a moment, as block SwardWind holds it. Read by GLSL and C++; vec4s alone, so that std140 and C++
// lay it out alike. Places are relative to the eye, metres east and north.

// A gust or a whirlwind. Its speed at a place d metres away is
//   push * min(d/radius, 1) * max(d/radius, 1)^-falloff * (1 - (d/reach)^2)^2
// times what it has risen to at the moment that reaches the place now.
struct WindSourceParams {
  vec4 place;   // x, y; z: m/s away from it; w: m/s counter-clockwise around it
  vec4 course;  // s since its start; s that a metre takes; s it lasts; s it takes to rise, and to fall
  vec4 shape;   // 1 / radius, 1 / reach (1/m); falloff; s after which it starts again, 0: never
  vec4 wave;    // radians a second; share of the speed that waves take, 0..1
};

const int k_wind_sources = 16;

struct WindParams {
  vec4 mean;                // x, y: m/s; z: gustiness, 0..1; w: 1 when there is wind, else 0
  vec4 ambient;             // x: m/s in calm; y: share of the directional speed; z: sources; w: 1 when painted, else 0
  vec4 gust_place[2];       // x, y: the eye's place on the map, tiles; z, w: tiles a metre times its turn's cosine, sine
  vec4 ambient_place[2];    // the same of the noise
  vec4 ambient_turn;        // cosine and sine of what its vectors are turned by: first layer, second layer
  vec4 grid_place[2];       // fine, coarse: the eye's place, tiles; z: tiles a metre; w: 1 when anything moves, else 0
  vec4 grid_reach;          // x, y: the eye that the grids follow; z, w: reach of the fine and the coarse, metres
  vec4 painted;             // x, y: the eye's place on the map; z, w: maps a metre
  WindSourceParams sources[k_wind_sources];
};

// All of it 0 where there is none.
struct WindHere {
  vec2 velocity;  // m/s east and north: directional, sources and movers
  vec2 ambient;   // m/s: the small, quick part, which is there in calm too
  float gust;     // how much of a gust there is here, 0..1; 0.5 is the mean wind
};
