// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A part of a plant bent by its own weight and the wind. Read by GLSL, after common_blade.glsl, and C++
// (vegetation/src/vegetation/curve_twin.h); nothing in programs for still air.
#include "common_curve.glsl"

#if SWARD_WIND

// Where a plant bends and how far.
struct Bend {
  vec2 way;     // unit: azimuth of the bending plane
  float lean;   // of the root in it
  float layer;  // of the table of shapes
};

// The wind that bends as far as a plant's own weight does, m/s: what it takes to turn the plant.
SWARD_FN float own_wind(float stiffness) { return 0.4f + 2.6f * (1.0f - clamp(stiffness, 0.0f, 1.0f)); }

// The layer of WindShapes for so much more wind than calm (m/s); wind_of_layer() of blade_shape.h turned around.
SWARD_FN float layer_of_wind(float wind) {
  const float k_end = 40.0f / 46.0f;
  float share = min(wind / (wind + 6.0f), k_end) / k_end;
  return float(SWARD_CALM_LAYER) + float(SWARD_WIND_LAYERS - 1 - SWARD_CALM_LAYER) * share;
}

// Own bend and wind, as two pushes in one sum: wind along the own bend bends farther, one against it raises the plant
// before it bends the other way, so that the posture is continuous in the wind and without it as it always was.
// `own_way`: unit.
SWARD_FN Bend bend_in_wind(vec2 own_way, float stiffness, float lean, vec2 wind) {
  float own = own_wind(stiffness);
  vec2 sum = own * own_way + wind;
  float size = sqrt(sum.x * sum.x + sum.y * sum.y);
  Bend bend;
  bend.way = size > 1.0e-4f ? sum / size : own_way;
  bend.lean = lean * min(size / own, 1.0f);
  bend.layer = size < own ? float(SWARD_CALM_LAYER) * size / own : layer_of_wind(size - own);
  return bend;
}

// Rise of ground with this normal per metre along a level direction.
SWARD_FN float rise_towards(vec3 normal, vec2 way) { return -(normal.x * way.x + normal.y * way.y) / normal.z; }

// The curve of a part bent so, without its contact with the ground.
SWARD_FN BladeCurve bent_curve(Bend bend, float stiffness, vec3 normal) {
  BladeCurve c = free_curve(stiffness, bend.lean, rise_towards(normal, bend.way));
  c.layer = bend.layer;
  return c;
}

// Length of a curve that is drawn as so many segments.
SWARD_FN float drawn_length(BladeCurve c, float segments) {
  BladePoint before = BladePoint(0.0f, 0.0f, 0.0f);
  float sum = 0.0f;
  int count = int(segments - 1.0e-4f) + 1;
  for (int i = 1; i <= count; ++i) {
    BladePoint here = curve_point(c, min(float(i) / segments, 1.0f));
    float along = here.along - before.along;
    float up = here.up - before.up;
    sum += sqrt(along * along + up * up);
    before = here;
  }
  return sum;
}

// A curve that lies on the ground where it meets it, and is as long as in calm when it is drawn as so many segments
// (fractional). `own_way`, `lean`: of the part in calm.
SWARD_FN BladeCurve laid_curve(BladeCurve c, vec2 own_way, float lean, float stiffness, vec3 normal, float segments) {
  BladeCurve calm = free_curve(stiffness, lean, rise_towards(normal, own_way));
  calm.contact = find_contact(calm);
  c.contact = find_contact(c);
  float n = clamp(segments, 1.0f, float(SWARD_BLADE_ROWS - 1));
  // What the ground bends is in no table.
  if (min(calm.contact, c.contact) < 1.0f) c.scale = drawn_length(calm, n) / drawn_length(c, n);
  else c.scale = length_kept(c, n);
  return c;
}

// A factor of 0.75..1.25 in 8 bits.
SWARD_FN uint packed_scale(float scale) { return uint(clamp((scale - 0.75f) * 508.0f + 0.5f, 0.0f, 254.0f)); }
SWARD_FN float unpack_scale(uint code) { return 0.75f + float(code) / 508.0f; }

#endif
