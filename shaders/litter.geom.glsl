// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of litter: dead leaves and twigs on the drawn ground, turned and curled by their own numbers, never a centimetre
// above it; the second invocation lays their shadow.
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(triangle_strip, max_vertices = 8) out;

#include "common_object_shape.glsl"

const float k_twigs = 0.25;          // share of what lies there
const float k_lift_m = 0.0015;       // of the rib above the ground
const float k_most_curl_m = 0.0075;  // of an edge or an end

struct Litter {
  Object object;
  mat2x3 axes;
  bool twig;
  float reach, half_width;
  float bend;   // sideways, shares of the length
  float curl;   // metres
  float roll;   // -1..1: which edge rises more
  float cover;
};

Litter this_litter() {
  Litter l;
  Object o = this_object();
  l.object = o;
  l.axes = ground_axes(o);
  l.twig = own_number(o, 1u) < k_twigs;
  l.reach = o.height * (l.twig ? 1.7 : 1.0);
  l.half_width = o.width * (l.twig ? 0.06 : 0.5);
  l.bend = (own_number(o, 2u) - 0.5) * (l.twig ? 0.18 : 0.25);
  l.curl = min(k_most_curl_m, 0.3 * o.width) * (1.0 - o.stiffness) * (l.twig ? 0.3 : 1.0);
  l.roll = 2.0 * own_number(o, 3u) - 1.0;
  float size = pixels(o, 2.0 * l.half_width);
  l.half_width *= inflation(size);
  l.cover = smoothstep(0.3, 0.7, pixels(o, l.reach)) / inflation(size);
  return l;
}

// Height above the ground at a place of the leaf: its ends and edges rise.
float rise(Litter l, float s, float across) {
  float end = 2.0 * s - 1.0;
  float edge = 0.5 * abs(across) * (1.0 + l.roll * across);
  return k_lift_m + l.curl * clamp(0.45 * end * end + 0.55 * edge, 0.0, 1.0);
}

vec3 litter_point(Litter l, float s, float across) {
  float end = 2.0 * s - 1.0;
  vec2 level = vec2(0.5 * l.reach * end, l.bend * l.reach * (end * end - 0.3) + across * l.half_width);
  return l.object.root + l.axes * level + l.object.plane * rise(l, s, across);
}

vec3 litter_normal(Litter l, float s, float across) {
  if (l.twig) return l.object.plane + l.axes[1] * (1.6 * across);  // round
  float tilt = l.curl / max(l.half_width, 1.0e-4) * (0.55 * sign(across) + 0.3 * l.roll);
  return l.object.plane - l.axes[1] * min(tilt, 1.0) - l.axes[0] * (2.0 * s - 1.0) * l.curl * 1.8 / l.reach;
}

void emit_half(Litter l, float from, float to, float what, ShadowPlane ground) {
  for (int i = 0; i < 2; ++i) {
    float s = i == 0 ? l.object.first : l.object.second;
    for (int edge = 0; edge < 2; ++edge) {
      float across = edge == 0 ? from : to;
      vec3 point = litter_point(l, s, across);
      vec3 drawn = what >= 0.0 ? cast_on_ground(ground, point) : point * (1.0 - 1.5 * ground.lift);
      Part part = Part(vec2(across, s), l.cover, l.twig ? 1.0 : 0.0, what, 1.0);
      emit(l.object, part, drawn, litter_normal(l, s, 0.5 * (from + to)));
    }
  }
  EndPrimitive();
}

void main() {
  Litter l = this_litter();
  ShadowPlane ground = object_shadow_plane(l.object);
  float what = k_part_object;
  if (gl_InvocationID == 1) {
    what = object_shadow_strength(l.object);
    if (what <= 0.01) return;
  }
  emit_half(l, -1.0, 0.0, what, ground);
  emit_half(l, 0.0, 1.0, what, ground);
}
