// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The curve of a bent blade (Papavasiliou 2015, section 2.3). Read by GLSL (common_blade.glsl) and C++
// (vegetation/src/vegetation/curve_twin.h), which define blade_texel(index): the table that blade_shape.h solves. Its
// columns are stiffnesses, its rows points at equal arc length; with SWARD_WIND 1 its layers are winds.

// In the bending plane, in blade lengths: way along the azimuth, height, inclination from the vertical (radians).
struct BladePoint {
  float along;
  float up;
  float inclination;
};

const float k_no_contact = 2.0f;

// A blade's curve: stiffness, lean of the root, and where it reaches the ground.
struct BladeCurve {
  float column;
  vec2 lean;         // cosine, sine
  float lean_angle;
  float contact;     // arc length at which the blade meets the ground, or k_no_contact
  vec2 ground;       // direction along the ground in the bending plane: out, up
#if SWARD_WIND
  float layer;       // of the table: what the wind does
  float scale;       // that keeps the length of few segments
#endif
};

SWARD_FN vec4 blade_columns(float column, int row) {
  int left = min(int(column), SWARD_BLADE_COLUMNS - 2);
  vec4 a = blade_texel(row * SWARD_BLADE_COLUMNS + left);
  vec4 b = blade_texel(row * SWARD_BLADE_COLUMNS + left + 1);
  return mix(a, b, column - float(left));
}

#if SWARD_WIND
SWARD_FN vec4 blade_cell(BladeCurve c, int row) {
  int below = min(int(c.layer), SWARD_WIND_LAYERS - 2);
  vec4 a = blade_columns(c.column, below * SWARD_BLADE_ROWS + row);
  vec4 b = blade_columns(c.column, (below + 1) * SWARD_BLADE_ROWS + row);
  return mix(a, b, c.layer - float(below));
}
SWARD_FN vec3 blade_row(BladeCurve c, int row) { return vec3(blade_cell(c, row)); }
#else
SWARD_FN vec3 blade_row(BladeCurve c, int row) { return vec3(blade_columns(c.column, row)); }
#endif

SWARD_FN vec3 leaned(BladeCurve c, vec3 p) {
  return vec3(p.x * c.lean.x + p.y * c.lean.y, p.y * c.lean.x - p.x * c.lean.y, p.z + c.lean_angle);
}

SWARD_FN vec3 curve_row(BladeCurve c, int row) { return leaned(c, blade_row(c, row)); }

// Above the ground's line by this much, blade lengths.
SWARD_FN float clearance(BladeCurve c, vec3 p) { return p.y * c.ground.x - p.x * c.ground.y; }

// `slope`: rise of the ground per metre along the blade's azimuth. The contact is not looked for.
SWARD_FN BladeCurve free_curve(float stiffness, float lean, float slope) {
  BladeCurve c;
  c.column = clamp(stiffness, 0.0f, 1.0f) * float(SWARD_BLADE_COLUMNS - 1);
  c.lean = vec2(cos(lean), sin(lean));
  c.lean_angle = lean;
  c.ground = normalize(vec2(1.0f, slope));
  c.contact = k_no_contact;
#if SWARD_WIND
  c.layer = float(SWARD_CALM_LAYER);
  c.scale = 1.0f;
#endif
  return c;
}

// Arc length at which a free curve meets the ground.
SWARD_FN float find_contact(BladeCurve c) {
  int last = SWARD_BLADE_ROWS - 1;
  // The free curve bends one way only: a tip above the ground means that all of it is.
  if (clearance(c, curve_row(c, last)) >= 0.0f) return k_no_contact;
  float before = 0.0f;
  for (int row = 1; row <= last; ++row) {
    float here = clearance(c, curve_row(c, row));
    if (here < 0.0f) return (float(row - 1) + before / max(before - here, 1.0e-6f)) / float(last);
    before = here;
  }
  return k_no_contact;
}

// Point at arc length `s` of 0..1. Beyond the contact the blade lies on the ground, its length kept.
SWARD_FN BladePoint curve_point(BladeCurve c, float s) {
  int last = SWARD_BLADE_ROWS - 1;
  float free = min(s, c.contact);
  float row = free * float(last);
  int below = min(int(row), last - 1);
  vec3 p = mix(curve_row(c, below), curve_row(c, below + 1), row - float(below));
  if (s > c.contact) {
    p.x += (s - c.contact) * c.ground.x;
    p.y += (s - c.contact) * c.ground.y;
    p.z = 1.5707963f - atan(c.ground.y, c.ground.x);
  }
#if SWARD_WIND
  p.x *= c.scale;
  p.y *= c.scale;
#endif
  return BladePoint(p.x, p.y, p.z);
}

#if SWARD_WIND
// Factor on a free curve that is drawn as so many segments (fractional, at most the rows' less one): it is as long as in
// calm, however it bends.
SWARD_FN float length_kept(BladeCurve c, float segments) {
  float place = segments - 1.0f;
  int below = min(int(place), SWARD_BLADE_ROWS - 3);
  return mix(blade_cell(c, below).w, blade_cell(c, below + 1).w, place - float(below));
}
#endif
