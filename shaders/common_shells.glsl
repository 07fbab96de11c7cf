// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants drawn as layers over the ground, bent without changing their length. Read by GLSL and C++.
//
// Bakay, Lalonde and Heidrich, "Real-time animated grass" (2002), sections 4 and 5: a blade is a stack of segments as
// long as the layers lie apart, inclined by equal steps from layer to layer. Departures, where the print does not keep
// lengths or bends the wrong way: the sine takes j as the cosine does, sums start at j = 1, so that layer 0 is the
// ground, the wind along the surface is of unit length, and it points away from its source.

// One segment, from layer j - 1 to layer j of `layers` (j from 1): along the wind and along the normal, in distances
// between layers. `intensity`: 0 upright .. 1 the last segment lies along the surface.
SWARD_FN vec2 shell_step(int j, int layers, float intensity) {
  float angle = 1.5707963f * intensity * float(j) / float(layers);
  return vec2(sin(angle), cos(angle));
}

// Where layer i, 0 the ground .. `layers` the tips, has moved to: along the wind, along the normal. Who draws the layers
// in order keeps a sum of shell_step() instead.
SWARD_FN vec2 shell_place(int i, int layers, float intensity) {
  vec2 sum = vec2(0.0f);
  for (int j = 1; j <= i; ++j) sum = sum + shell_step(j, layers, intensity);
  return sum;
}

// Unit vector along the surface in which a source at `to_source` (from the place, any length) blows; 0 where that is
// along the normal, which is of unit length.
SWARD_FN vec3 shell_wind(vec3 to_source, vec3 normal) {
  float up = to_source.x * normal.x + to_source.y * normal.y + to_source.z * normal.z;
  vec3 away = up * normal - to_source;
  float size = sqrt(away.x * away.x + away.y * away.y + away.z * away.z);
  return size > 1.0e-6f ? away / size : vec3(0.0f);
}
