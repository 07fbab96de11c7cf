// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What has touched the ground around the viewer: nested levels of cells, each a repeating texture (toroidal: a cell keeps
// its texel while the viewer moves), the finest that holds a place blended with the next towards its border. Filled by
// sward::DisturbanceTextures. Press and water decay here, by one factor each: texels hold them as of one moment. GLSL
// only.
#include "common_shared.glsl"
#include "common_disturbed.glsl"

layout(std140, binding = SWARD_BINDING_DISTURBANCE) uniform SwardDisturbance {
  vec4 state;     // levels held, 0: none; factors on press and on water; layers in use: 0, 1 burn, 2 paint too
  vec4 level[3];  // texture place of the eye; 1 / width (1/m); reach (m)
} sward_disturbance;

// Three layers a level: press, water, cut; burn; paint.
layout(binding = SWARD_BINDING_DISTURBANCE_MAP) uniform sampler2DArray sward_disturbance_map;

bool ground_is_disturbed() { return sward_disturbance.state.x > 0.0; }

Disturbed disturbance_level(int level, vec2 xy) {
  vec4 l = sward_disturbance.level[level];
  vec2 place = l.xy + xy * l.z;
  float layer = float(3 * level);
  vec4 moving = textureLod(sward_disturbance_map, vec3(place, layer), 0.0);
  Disturbed d = undisturbed();
  d.press = moving.xy * sward_disturbance.state.y;
  d.wet = moving.z * sward_disturbance.state.z;
  d.cut = moving.w;
  if (sward_disturbance.state.w > 0.0)
    d.burn = textureLod(sward_disturbance_map, vec3(place, layer + 1.0), 0.0).x;
  if (sward_disturbance.state.w > 1.0) d.paint = textureLod(sward_disturbance_map, vec3(place, layer + 2.0), 0.0);
  return d;
}

// `point`: relative to the eye, world axes.
Disturbed disturbed_here(vec3 point) {
  Disturbed d = undisturbed();
  int levels = int(sward_disturbance.state.x);
  float away = max(abs(point.x), abs(point.y));
  int level = 0;
  while (level < levels && away >= sward_disturbance.level[level].w) ++level;
  if (level >= levels) return d;
  d = disturbance_level(level, point.xy);
  float next = next_disturbance_level(away / sward_disturbance.level[level].w);
  if (next > 0.0) {
    Disturbed beyond = undisturbed();
    if (level + 1 < levels) beyond = disturbance_level(level + 1, point.xy);
    d = mix_disturbed(d, beyond, next);
  }
  return settle_disturbed(d);
}

// Linear colour of what has been touched: wet is darker, burnt is black, paint covers.
vec3 disturbed_color(vec3 color, Disturbed d) {
  color *= 1.0 - 0.45 * d.wet;
  float gray = dot(color, vec3(0.2126, 0.7152, 0.0722));
  color = mix(color, vec3(0.12 * gray + 0.004), d.burn);
  if (d.paint.a <= 0.0) return color;
  vec3 encoded = clamp(d.paint.rgb / max(d.paint.a, 1.0e-4), 0.0, 1.0);
  return mix(color, pow(encoded, vec3(2.2)), min(d.paint.a, 1.0));
}

// The same for ground and what takes its colour, at `point` relative to the eye: green that lies away from the eye shows
// its broad sides and is bright, what lies towards the eye is dark, as mown lawns have stripes; stubble is pale.
vec3 disturbed_ground(vec3 color, Disturbed d, vec3 point) {
  float brightest = max(color.r, max(color.g, color.b));
  float grassy = smoothstep(-0.35, -0.05, (color.g - color.r) / max(brightest, 1.0e-3));
  vec2 ahead = point.xy * inversesqrt(dot(point, point) + 1.0e-6);
  color *= 1.0 + grassy * (0.75 * dot(d.press, ahead) + 0.25 * length(d.press));
  color *= mix(vec3(1.0), vec3(1.34, 1.18, 0.86), grassy * smoothstep(0.2, 0.8, d.cut));
  return disturbed_color(color, d);
}
