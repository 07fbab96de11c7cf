// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, a vertex of the blade's middle line: bent, turned, scaled (Papavasiliou 2015, section 2.3).
#include "common_layer.glsl"
#include "common_blade.glsl"
#include "common_outline.glsl"
#include "common_stance_line.glsl"

layout(isolines, fractional_odd_spacing) in;

layout(location = 1) uniform vec4 sward_images;  // common_plant_image.glsl: a cutout takes the outline's place

layout(location = 0) in vec4 blade_root[];
layout(location = 1) in vec4 blade_form[];
layout(location = 2) in vec4 blade_ground[];
layout(location = 3) in vec4 blade_color[];
layout(location = 4) in vec4 blade_self[];
#if SWARD_WIND
layout(location = 14) in vec2 blade_bend[];
#endif
layout(location = 5) patch in uint blade_slots[(SWARD_CLUSTER_SIZE + 3) / 4];

layout(location = 0) out vec4 line_point;    // relative to the eye; arc length 0..1
layout(location = 1) out vec4 line_tangent;  // unit; half width
layout(location = 2) out vec4 line_plane;    // of the ground: unit normal; its bend (shadow_bend)
layout(location = 3) out vec4 line_color;    // ground at the root; age
layout(location = 4) out vec4 line_map;      // base map coordinates below the eye; azimuth; phase
layout(location = 5) out vec4 line_fade;     // melting into the ground; distance of the root; share of the width that
                                             // its edge shows; which of the plant's shoots
layout(location = 6) out vec3 line_root;     // relative to the eye

// A blade seen from its edge shows at least this share of its width.
const float k_edge_share = 0.35;

// A blade's outline: broad at the base, pointed.
float outline(float s) { return 1.0 - s * s * (0.55 + 0.45 * s); }
const float k_mean_outline = 0.704;

void main() {
  uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
  uint i = blade_slots[line / 4u] >> (8u * (line % 4u)) & 255u;
  vec4 form = blade_form[i];
  vec4 ground = blade_ground[i];
  vec3 root = blade_root[i].xyz;
  vec3 normal = vec3(ground.xy, sqrt(max(1.0 - dot(ground.xy, ground.xy), 1.0e-4)));

  vec2 azimuth = vec2(cos(form.z), sin(form.z));
  BladeCurve curve = free_curve(form.y, form.w, -dot(normal.xy, azimuth) / normal.z);
  curve.contact = blade_self[i].x;
#if SWARD_WIND
  curve.layer = blade_bend[i].x;
  curve.scale = blade_bend[i].y;
#endif
  float s = gl_TessCoord.x;
  BladePoint p = curve_point(curve, s);

  vec3 point = root + blade_root[i].w * vec3(azimuth * p.along, p.up);
  hand_on_stance();
  line_point = vec4(point, s);
  float width = sward_images.w < 0.0 ? outline(s) * outline_kept(1.0, 0.0, k_mean_outline, gl_TessLevelOuter[1]) : 1.0;
  line_tangent = vec4(azimuth * sin(p.inclination), cos(p.inclination), form.x * width);
  line_plane = vec4(normal, blade_self[i].w);
  line_root = root;
  line_color = blade_color[i];
  vec2 uv_per_m = sward_layer.layer.map.xy / sward_layer.layer.map.zw;
  line_map = vec4(ground.zw - root.xy * uv_per_m, form.z, blade_self[i].y);
  float distance = blade_self[i].z;
  line_fade = vec4(smoothstep(0.02, 0.6, distance / sward_layer.layer.reach.x), distance, k_edge_share, 0.0);
}
