// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// For the benchmark of growth: a vertex of a blade's strip, or of its shadow, pulled from the lists of expand.comp.
#include "common_frame.glsl"
#include "common_layer.glsl"
#include "common_blade.glsl"

layout(location = 1) uniform ivec4 shape;  // segments, first blade, 1: shadow, unused

layout(std430, binding = 2) readonly buffer Blades { vec4 blades[]; };

layout(location = 0) out vec4 flat_cover;        // share that is covered, phase, arc length, 0
layout(location = 1) flat out vec4 flat_color;

const float k_least_half_width_px = 0.6;
const float k_edge_share = 0.35;

float outline(float s) { return 1.0 - s * s * (0.55 + 0.45 * s); }

vec3 onto_plane(vec3 point, vec3 root, vec3 plane) {
  vec3 sun = frame.sun_direction.xyz;
  return (point - sun * (dot(plane, point - root) / max(dot(plane, sun), 0.3))) * (1.0 - 0.0012);
}

void main() {
  int vertices = 2 * (shape.x + 1);
  int blade = gl_VertexID / vertices;
  int vertex = gl_VertexID - blade * vertices;
  float across = (vertex & 1) == 0 ? -1.0 : 1.0;
  float s = float(vertex >> 1) / float(shape.x);
  int at = 4 * (shape.y + blade);
  vec4 root = blades[at], form = blades[at + 1], ground = blades[at + 2];
  vec3 plane = vec3(ground.xy, sqrt(max(1.0 - dot(ground.xy, ground.xy), 1.0e-4)));
  vec2 azimuth = vec2(cos(form.z), sin(form.z));
  BladeCurve curve = free_curve(form.y, form.w, -dot(plane.xy, azimuth) / plane.z);
  curve.contact = ground.z;
  BladePoint p = curve_point(curve, s);
  vec3 point = root.xyz + root.w * vec3(azimuth * p.along, p.up);
  vec3 tangent = vec3(azimuth * sin(p.inclination), cos(p.inclination));
  vec3 flat_side = vec3(-azimuth.y, azimuth.x, 0.0);
  vec3 side;
  float seen = form.x * outline(s);
  if (shape.z == 1) {
    point = onto_plane(point, root.xyz, plane);
    side = normalize(flat_side - plane * dot(plane, flat_side));
  } else {
    vec3 way = cross(tangent, -point / max(length(point), 1.0e-3));
    side = normalize(way * (dot(way, flat_side) < 0.0 ? -1.0 : 1.0) + 0.1 * flat_side);
    seen *= max(abs(dot(side, flat_side)), k_edge_share);
  }
  float drawn = seen > 0.0 ? max(seen, k_least_half_width_px * length(point) / frame.focal.y) : 0.0;
  flat_cover = vec4(drawn > 0.0 ? seen / drawn : 0.0, ground.w, s, 0.0);
  flat_color = shape.z == 1 ? vec4(blades[at + 3].rgb * 0.3, 1.0) : blades[at + 3];
  gl_Position = frame.clip_from_relative * vec4(point + side * (across * drawn), 1.0);
}
