// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of single objects, geometry: what the kinds share when they make shapes from a piece of their line. GLSL only.
#include "common_frame.glsl"
#include "common_layer.glsl"
#include "common_visible.glsl"
#include "common_shadow_projection.glsl"
#include "common_hash.glsl"
#include "common_stance_shape.glsl"
#include "common_sway.glsl"

layout(location = 0) in vec4 line_root[];   // relative to the eye; height (m)
layout(location = 1) in vec4 line_form[];   // width (m), stiffness, azimuth, lean
layout(location = 2) in vec4 line_plane[];  // of the ground: unit normal; place along the line, 0..1
layout(location = 3) in vec4 line_color[];  // ground at the root; age
layout(location = 4) in vec4 line_self[];   // distance, phase, own parts, parts drawn
layout(location = 5) in vec4 line_map[];    // base map coordinates below the eye; melting; bend (shadow_bend)
layout(location = 6) flat in uint line_record[];
#if SWARD_WIND
layout(location = 8) flat in vec4 line_blown[];  // wind, sway, cycle
layout(location = 9) flat in float line_slow[];  // slow cycle
#endif

layout(location = 0) out vec4 part_point;        // relative to the eye; height above the ground's plane (m)
layout(location = 1) out vec4 part_normal;       // not of unit length; a number of the kind
layout(location = 2) out vec4 part_mask;         // the part's own coordinates; share that is covered; number of the part
layout(location = 3) flat out vec4 part_color;   // ground at the root; age
layout(location = 4) flat out vec4 part_ground;  // normal; melting
layout(location = 5) flat out vec4 part_self;    // base map coordinates below the eye; phase; what it is (see below)

// What a part is: -1 and below the object itself, 0..1 its shadow of that strength, from 2 the dark ground at its foot.
const float k_part_object = -1.0;
const float k_part_contact = 2.0;

struct Object {
  vec3 root;
  float height, width;
  float stiffness, azimuth, lean;
  vec3 plane;
  float distance, phase, parts;
  float first, second;  // the piece of the line, 0..1
};

Object this_object() {
  Object o;
  o.root = line_root[0].xyz;
  o.height = line_root[0].w;
  o.width = line_form[0].x;
  o.stiffness = line_form[0].y;
  o.azimuth = line_form[0].z;
  o.lean = line_form[0].w;
  o.plane = line_plane[0].xyz;
  o.distance = line_self[0].x;
  o.phase = line_self[0].y;
  o.parts = line_self[0].z;
  o.first = min(line_plane[0].w, line_plane[1].w);
  o.second = max(line_plane[0].w, line_plane[1].w);
  return o;
}

PlantAir object_air() {
#if SWARD_WIND
  return PlantAir(line_blown[0].xy, line_blown[0].z, line_blown[0].w, line_slow[0]);
#else
  return still_air();
#endif
}

// The object's own numbers beyond its traits, 0..1.
float own_number(Object o, uint index) { return hash_unit(uvec2(uint(o.phase * 16777216.0), index)); }

// Two unit vectors in the ground's plane, the first towards the azimuth.
mat2x3 ground_axes(Object o) {
  vec3 level = vec3(cos(o.azimuth), sin(o.azimuth), 0.0);
  vec3 along = normalize(level - o.plane * dot(level, o.plane));
  return mat2x3(along, cross(o.plane, along));
}

float pixels(Object o, float size) { return size * frame.focal.y / max(o.distance, 1.0e-3); }

// Factor by which an object of this size is drawn larger so as not to fall between samples.
float inflation(float size_px) { return max(1.0, 1.3 / max(size_px, 1.0e-3)); }

// Its coverage: the inverse of the inflated area, gone before it is left out.
float cover_small(float size_px) {
  float inflated = inflation(size_px);
  return smoothstep(0.3, 0.7, size_px) / (inflated * inflated);
}

struct Part {
  vec2 mask;
  float cover, number, what, extra;
};

void emit(Object o, Part part, vec3 position, vec3 normal) {
  vec3 seen = to_world(position);
  gl_Position = frame.clip_from_relative * vec4(seen, 1.0);
  part_point = vec4(seen, dot(o.plane, position - o.root));
  part_normal = vec4(to_world(normal), part.extra);
  part_mask = vec4(part.mask, part.cover, part.number);
  part_color = line_color[0];
  part_ground = vec4(to_world(o.plane), line_map[0].z);
  part_self = vec4(line_map[0].xy, o.phase, part.what);
  EmitVertex();
}

float object_shadow_strength(Object o) { return ground_shadow_strength(sward_layer.layer, o.distance, o.plane); }

ShadowPlane object_shadow_plane(Object o) { return shadow_plane(o.root, o.plane, line_map[0].w, o.height); }

// Where a point's shadow falls, a little before the ground.
vec3 cast_on_ground(ShadowPlane ground, vec3 point) { return lifted(ground, cast_shadow(ground, point)); }
