// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The curve of a bent blade, from the table that blade_shape.h solves: columns are stiffnesses, rows points at equal
// arc length. GLSL only.

layout(binding = SWARD_BINDING_BLADE_SHAPE) uniform samplerBuffer sward_blade_shape;

// In the bending plane, in blade lengths: way along the azimuth, height, inclination from the vertical (radians).
struct BladePoint {
  float along;
  float up;
  float inclination;
};

vec3 blade_row(float column, int row) {
  int left = min(int(column), SWARD_BLADE_COLUMNS - 2);
  vec3 a = texelFetch(sward_blade_shape, row * SWARD_BLADE_COLUMNS + left).xyz;
  vec3 b = texelFetch(sward_blade_shape, row * SWARD_BLADE_COLUMNS + left + 1).xyz;
  return mix(a, b, column - float(left));
}

const float k_no_contact = 2.0;

// A blade's curve: stiffness, lean of the root, and where it reaches the ground.
struct BladeCurve {
  float column;
  vec2 lean;         // cosine, sine
  float lean_angle;
  float contact;     // arc length at which the blade meets the ground, or k_no_contact
  vec2 ground;       // direction along the ground in the bending plane: out, up
};

vec3 leaned(BladeCurve c, vec3 p) {
  return vec3(p.x * c.lean.x + p.y * c.lean.y, p.y * c.lean.x - p.x * c.lean.y, p.z + c.lean_angle);
}

vec3 curve_row(BladeCurve c, int row) { return leaned(c, blade_row(c.column, row)); }

// Above the ground's line by this much, blade lengths.
float clearance(BladeCurve c, vec3 p) { return p.y * c.ground.x - p.x * c.ground.y; }

// `slope`: rise of the ground per metre along the blade's azimuth. The contact is not looked for.
BladeCurve free_curve(float stiffness, float lean, float slope) {
  BladeCurve c;
  c.column = clamp(stiffness, 0.0, 1.0) * float(SWARD_BLADE_COLUMNS - 1);
  c.lean = vec2(cos(lean), sin(lean));
  c.lean_angle = lean;
  c.ground = normalize(vec2(1.0, slope));
  c.contact = k_no_contact;
  return c;
}

// Arc length at which a free curve meets the ground.
float find_contact(BladeCurve c) {
  int last = SWARD_BLADE_ROWS - 1;
  // The free curve bends one way only: a tip above the ground means that all of it is.
  if (clearance(c, curve_row(c, last)) >= 0.0) return k_no_contact;
  float before = 0.0;
  for (int row = 1; row <= last; ++row) {
    float here = clearance(c, curve_row(c, row));
    if (here < 0.0) return (float(row - 1) + before / max(before - here, 1.0e-6)) / float(last);
    before = here;
  }
  return k_no_contact;
}

// Point at arc length `s` of 0..1. Beyond the contact the blade lies on the ground, its length kept.
BladePoint curve_point(BladeCurve c, float s) {
  int last = SWARD_BLADE_ROWS - 1;
  float free = min(s, c.contact);
  float row = free * float(last);
  int below = min(int(row), last - 1);
  vec3 p = mix(curve_row(c, below), curve_row(c, below + 1), row - float(below));
  if (s > c.contact) {
    p.xy += (s - c.contact) * c.ground;
    p.z = 1.5707963 - atan(c.ground.y, c.ground.x);
  }
  return BladePoint(p.x, p.y, p.z);
}
