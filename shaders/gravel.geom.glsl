// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of gravel: a slice of a faceted stone from one angle to the next, its shadow, and the dark ground at its foot
// (Papavasiliou 2015, figure 1). The outline is a function of the angle alone, so that corners slide when their number
// changes.
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(triangle_strip, max_vertices = 19) out;

#include "common_object_shape.glsl"

// The stone's heights in shares of its own: it is sunk by a third.
const float k_foot = -0.3333333;
const float k_top = 0.6666667;
const float k_least_sides = 5.0;

struct Stone {
  Object object;
  mat2x3 axes;
  vec3 turns;     // of the waves of its outline, radians
  float flatten;  // width across the azimuth against width along it
  float grown;    // inflation of what is smaller than a pixel
  float cover;
  float round;
};

// Factor on the radius that gives a ring of `level` corners (fractional odd spacing: two sides of it are shorter) the
// area of a circle.
float rounding(float level) {
  float sides = 2.0 * ceil(0.5 * (level - 1.0)) + 1.0;
  float shorter = 0.5 * (1.0 - (sides - 2.0) / level);
  float area = (sides - 2.0) * sin(6.2831853 / level) + 2.0 * sin(6.2831853 * shorter);
  return sqrt(6.2831853 / max(area, 1.0));
}

Stone this_stone() {
  Stone s;
  s.object = this_object();
  s.axes = ground_axes(s.object);
  s.turns = 6.2831853 * vec3(own_number(s.object, 1u), own_number(s.object, 2u), own_number(s.object, 3u));
  s.flatten = mix(0.62, 1.0, own_number(s.object, 4u));
  float size = pixels(s.object, s.object.width);
  s.grown = inflation(size);
  s.cover = cover_small(size);
  s.round = rounding(max(line_self[0].w, k_least_sides));
  return s;
}

// Corners pushed in and out, ring by ring.
float push(Stone s, float angle, float ring) {
  vec3 waves = sin(angle * vec3(2.0, 3.0, 5.0) + s.turns + ring * vec3(0.4, 1.1, 2.3));
  return 1.0 + dot(waves, vec3(0.10, 0.12, 0.09));
}

vec3 place(Stone s, vec2 level, float up) {
  Object o = s.object;
  vec2 across = level * vec2(1.0, s.flatten) * (0.5 * o.width * s.grown);
  return o.root + s.axes * across + o.plane * (up * o.height * s.grown);
}

vec3 on_ring(Stone s, float angle, float radius, float up, float ring) {
  return place(s, radius * s.round * push(s, angle, ring) * vec2(cos(angle), sin(angle)), up);
}

vec3 foot(Stone s, float angle) { return on_ring(s, angle, 0.72, k_foot, 0.0); }
vec3 belt(Stone s, float angle) { return on_ring(s, angle, 0.94, 0.08 + 0.07 * sin(angle + s.turns.y), 0.6); }
vec3 shoulder(Stone s, float angle) { return on_ring(s, angle, 0.64, 0.40 + 0.14 * sin(angle + s.turns.z), 1.5); }
vec3 top(Stone s) {
  vec2 aside = vec2(own_number(s.object, 5u), own_number(s.object, 6u)) - 0.5;
  return place(s, 0.5 * aside, k_top);
}

void emit_facet(Stone s, vec3 a, vec3 b, vec3 c) {
  vec3 normal = cross(b - a, c - a);
  float size = length(normal);
  if (size < 1.0e-12) return;
  vec3 centre = s.object.root;
  normal *= (dot(normal, a + b + c - 3.0 * centre) < 0.0 ? -1.0 : 1.0) / size;
  Part part = Part(vec2(0.5), s.cover, 0.0, k_part_object, s.object.height * s.grown);
  emit(s.object, part, a, normal);
  emit(s.object, part, b, normal);
  emit(s.object, part, c, normal);
  EndPrimitive();
}

// The ground next to the stone sees less of the sky.
void emit_contact(Stone s) {
  float near = smoothstep(5.0, 14.0, pixels(s.object, s.object.width));
  if (near <= 0.0 || SWARD_ON_MESH > 0) return;
  float lift = 1.0 - object_shadow_plane(s.object).lift;
  for (int i = 0; i < 2; ++i) {
    float angle = 6.2831853 * (i == 0 ? s.object.first : s.object.second);
    for (int edge = 0; edge < 2; ++edge) {
      Part part = Part(vec2(float(edge), 0.5), near, 1.0, k_part_contact, 1.0);
      emit(s.object, part, on_ring(s, angle, edge == 0 ? 0.8 : 1.35, 0.0, 0.4) * lift, s.object.plane);
    }
  }
  EndPrimitive();
}

void emit_slice(Stone s) {
  float a = 6.2831853 * s.object.first, b = 6.2831853 * s.object.second;
  vec3 belt_a = belt(s, a), belt_b = belt(s, b), shoulder_a = shoulder(s, a), shoulder_b = shoulder(s, b);
  emit_facet(s, foot(s, a), foot(s, b), belt_a);
  emit_facet(s, foot(s, b), belt_b, belt_a);
  // The split of a side goes one way or the other.
  emit_facet(s, belt_a, belt_b, shoulder_a);
  emit_facet(s, belt_b, shoulder_b, shoulder_a);
  emit_facet(s, shoulder_a, shoulder_b, top(s));
  emit_contact(s);
}

// A far stone: what is seen of it, as a diamond facing the eye.
void emit_dot(Stone s) {
  Object o = s.object;
  vec3 to_eye = normalize(-o.root);
  float above = abs(dot(to_eye, o.plane));
  float half_width = 0.5 * 0.9 * o.width * s.grown;
  float half_height = mix(0.34 * o.height, half_width * s.flatten, above) * s.grown;
  vec3 right = cross(o.plane, to_eye);
  right = dot(right, right) < 1.0e-6 ? s.axes[0] : normalize(right);
  vec3 up = cross(to_eye, right);
  vec3 centre = o.root + o.plane * (0.3 * o.height * (1.0 - above));
  vec3 normal = o.plane + 0.6 * to_eye;
  Part part = Part(vec2(0.5), s.cover, 0.0, k_part_object, 0.3 * o.height);
  // A diamond of about the area of what it stands for.
  float wider = 1.17;
  emit(o, part, centre - right * half_width * wider, normal);
  emit(o, part, centre - up * half_height * wider, normal);
  emit(o, part, centre + up * half_height * wider, normal);
  emit(o, part, centre + right * half_width * wider, normal);
  EndPrimitive();
}

void emit_shadow(Stone s) {
  Object o = s.object;
  float strength = object_shadow_strength(o);
  if (strength <= 0.01) return;
  ShadowPlane ground = object_shadow_plane(o);
  float a = 6.2831853 * o.first, b = 6.2831853 * o.second;
  Part part = Part(vec2(0.5), s.cover, 2.0, strength, 1.0);
  vec3 outline[6] = vec3[6](o.root, belt(s, a), belt(s, b), shoulder(s, a), shoulder(s, b), top(s));
  for (int i = 0; i < 6; ++i) emit(o, part, cast_on_ground(ground, outline[i]), o.plane);
  EndPrimitive();
}

void main() {
  Stone s = this_stone();
  bool dot_only = line_self[0].w < 2.0;
  if (gl_InvocationID == 0) {
    if (dot_only) emit_dot(s);
    else emit_slice(s);
  } else if (!dot_only) {
    emit_shadow(s);
  }
}
