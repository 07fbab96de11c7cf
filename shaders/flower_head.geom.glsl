// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of flowers' heads: a segment becomes a petal with its wedge of the centre, or a dot; the second invocation
// lays the shadow of that on the ground's plane.
#include "common_frame.glsl"
#include "common_layer.glsl"
#include "common_visible.glsl"
#include "common_shadow_projection.glsl"
#include "common_head.glsl"
#include "common_strip_light.glsl"
#include "common_stance_shape.glsl"
#include "common_sway.glsl"

layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(triangle_strip, max_vertices = 14) out;

layout(location = 0) uniform int sward_species;

layout(location = 0) in vec4 petal_place[];   // middle relative to the eye, radius as drawn
layout(location = 1) in vec4 petal_axis[];    // where the head looks, unit; its turn about that (rad)
layout(location = 2) in vec4 petal_plane[];   // of the ground: unit normal; its bend (shadow_bend)
layout(location = 3) in vec4 petal_color[];   // linear; pixels across the head
layout(location = 4) in vec4 petal_map[];     // base map coordinates below the eye; phase; distance
layout(location = 5) in vec2 petal_number[];  // of the segment's end; segments of the head
layout(location = 6) in vec3 petal_root[];    // of the plant, relative to the eye
#if SWARD_WIND
layout(location = 8) flat in vec4 petal_air[];  // wind, m/s; sway; cycle; slow cycle
#endif

#define SWARD_LINK out
#include "common_strip_links.glsl"

// Half of the least size at which a head is drawn, pixels; smaller ones cover less.
const float k_least_radius_px = 0.7;
// A head from its edge shows this much of its breadth: heads are not flat.
const float k_edge_share = 0.4;

struct Head {
  SpeciesParams species;
  vec3 middle, axis, right, ahead;  // right, ahead: unit, across the axis, the head's own
  float radius;
  float met;        // petals_met
  vec3 wide, tall;  // the ellipse that the viewer sees of a flat head: half axes
  float shadow;     // strength; negative: this is the head itself
  float cover;      // of what is drawn larger than it is
};

float least_radius(vec3 place) { return k_least_radius_px * length(place) / frame.focal.y; }

// The ellipse in the picture, never thinner than the least size.
Head face_viewer(Head head) {
  vec3 to_eye = normalize(-head.middle);
  vec3 wide = cross(head.axis, to_eye);
  wide = dot(wide, wide) > 1.0e-6 ? normalize(wide) : head.right;
  float open = max(abs(dot(head.axis, to_eye)), k_edge_share);
  float least = least_radius(head.middle);
  float half_wide = max(head.radius, least), half_tall = max(head.radius * open, least);
  head.wide = wide * half_wide;
  head.tall = cross(to_eye, wide) * half_tall;
  head.cover = mix(1.0, head.radius * head.radius * open / (half_wide * half_tall), head.met);
  return head;
}

Head make_head() {
  Head head;
  head.species = sward_layer.species[sward_species];
  head.middle = petal_place[0].xyz;
  head.radius = petal_place[0].w;
  head.axis = petal_axis[0].xyz;
  vec3 east = normalize(vec3(head.axis.z, 0.0, -head.axis.x) + vec3(1.0e-4, 0.0, 0.0));
  vec3 north = cross(head.axis, east);
  float turn = petal_axis[0].w;
  head.right = cos(turn) * east + sin(turn) * north;
  head.ahead = cross(head.axis, head.right);
  head.met = petals_met(petal_color[0].w);
  head.shadow = -1.0;
  return face_viewer(head);
}

// A point of the head: x right, y ahead, z along the axis, in radii.
vec3 head_point(Head head, vec3 p) {
  vec3 own = head.radius * (head.right * p.x + head.ahead * p.y + head.axis * p.z);
  if (head.shadow >= 0.0) {
    ShadowPlane ground = shadow_plane(petal_root[0], petal_plane[0].xyz, petal_plane[0].w, head.species.size.y);
    return lifted(ground, cast_shadow(ground, head.middle + own));
  }
  // Along the ellipse's axes.
  vec3 flat_point = head.right * p.x + head.ahead * p.y;
  vec3 wide = normalize(head.wide);
  vec3 seen = head.wide * dot(flat_point, wide) + head.tall * dot(flat_point, cross(head.axis, wide)) *
                                                     sign(dot(cross(head.axis, wide), head.tall) + 1.0e-6);
  return head.middle + mix(own, seen, head.met);
}

// Petals have no way along which they shine: the streak is a spot.
void light_petal(Head head, vec3 normal, vec3 position) {
  vec3 plane = to_world(petal_plane[0].xyz);
  float facing = dot(plane, frame.sun_direction.xyz);
  Canopy canopy = canopy_of(sward_layer.layer, head.species, facing);
  StripLight light = strip_light_at(head.species.optics, normal, vec3(0.0), position, plane, 0.0);
  vec3 half_way = normalize(normalize(-position) + frame.sun_direction.xyz + vec3(0.0, 0.0, 1.0e-4));
  float up = dot(normalize(normal), half_way);
  strip_normal.xyz = light.normal;
  strip_normal.w = 0.3 * light.gloss;
  strip_light = vec4(canopy_light(canopy, max(dot(plane, position - to_world(petal_root[0])), 0.0)), light.through,
                     sqrt(max(1.0 - up * up, 0.0)));
}

void emit(Head head, vec3 p, vec3 normal, float across, float cover, vec4 color) {
  vec3 position = head_point(head, p);
  vec3 seen = to_world(position);
  gl_Position = frame.clip_from_relative * vec4(seen, 1.0);
  if (dot(normal, position) > 0.0) normal = -normal;
  strip_place = vec3(length(p.xy), across, cover * head.cover);
  strip_self = vec2(petal_map[0].z, head.shadow);
  strip_lit = vec3(0.0);
  strip_point = seen;
  strip_normal = vec4(to_world(normal), 0.0);
  strip_light = vec4(0.0);
  if (head.shadow < 0.0) light_petal(head, to_world(normal), seen);
  strip_color = color;
  strip_ground = vec4(to_world(petal_plane[0].xyz), 0.0);
  strip_map = petal_map[0].xy;
  EmitVertex();
}

vec4 centre_color(Head head) { return vec4(unpack_color(head.species.own_d.x), 1.0); }

// A wedge of the domed centre, its rim in two.
void emit_centre(Head head, vec2 along, vec2 across) {
  float radius = head_centre(head.species);
  if (radius <= 0.0) return;
  float side = radius * head_wedge(head.species);
  float rise = 0.3 * radius;
  vec4 color = centre_color(head);
  vec3 rim_normal = normalize(head.axis + 0.7 * (head.right * along.x + head.ahead * along.y));
  emit(head, vec3(along * radius - across * side, 0.3 * rise), rim_normal, -1.0, 1.0, color);
  emit(head, vec3(0.0, 0.0, rise), head.axis, 0.0, 1.0, color);
  emit(head, vec3(along * mix(radius / cos(atan(head_wedge(head.species))), radius, head.met), 0.3 * rise), rim_normal,
       0.0, 1.0, color);
  emit(head, vec3(along * radius + across * side, 0.3 * rise), rim_normal, 1.0, 1.0, color);
  EndPrimitive();
}

// Petals rise by the square of the radius; each by a little of its own.
void emit_petal(Head head, vec2 along, vec2 across, float own) {
  float cup = head.species.own_b.w + 2.0 * k_cup_spread * (own - 0.5);
#if SWARD_WIND
  // Petals beat a little.
  vec4 blown = petal_air[0];
  cup += k_petal_flutter * fluttering(PlantAir(vec2(0.0), blown.y, blown.z, blown.w), blown.x, own);
#endif
  for (int i = 0; i < k_petal_sections; ++i) {
    float radius = petal_radius(head.species, i);
    float wedge = radius * head_wedge(head.species);
    float width = petal_half_width(head.species, i);
    float drawn = mix(width, wedge, head.met);
    // Petals wider than their wedge lie over one another: no more than all is covered.
    float cover = mix(1.0, min(width / max(drawn, 1.0e-5), 1.0), head.met);
    vec3 outwards = head.right * along.x + head.ahead * along.y;
    vec3 sideways = head.right * across.x + head.ahead * across.y;
    vec3 normal = normalize(head.axis - 2.0 * cup * radius * outwards);
    // At last all are alike, for the mean.
    vec4 color = vec4(petal_color[0].rgb * mix(0.86 + 0.28 * own, 1.0, head.met), 0.0);
    float height = cup * radius * radius + 0.04 * own;
    // Edges bend up a little: a petal is a shallow trough.
    emit(head, vec3(along * radius - across * drawn, height + 0.1 * width), normalize(normal + 0.3 * sideways), -1.0,
         cover, color);
    emit(head, vec3(along * radius + across * drawn, height + 0.1 * width), normalize(normal - 0.3 * sideways), 1.0,
         cover, color);
  }
  EndPrimitive();
}

// A hexagon of the disc's area and of the head's mean colour and coverage.
void emit_dot(Head head) {
  vec2 areas = wedge_areas(head.species);
  float wedge = head_wedge(head.species);
  vec3 mean = (centre_color(head).rgb * areas.x + petal_color[0].rgb * areas.y) / (areas.x + areas.y);
  float size = sqrt(head_petals(head.species) * wedge / 2.598076);
  const vec2 corners[6] = vec2[6](vec2(-1.0, 0.0), vec2(-0.5, -0.866025), vec2(-0.5, 0.866025), vec2(0.5, -0.866025),
                                  vec2(0.5, 0.866025), vec2(1.0, 0.0));
  for (int i = 0; i < 6; ++i) {
    emit(head, vec3(corners[i] * size, 0.0), head.axis, corners[i].y, (areas.x + areas.y) / wedge, vec4(mean, 0.5));
  }
  EndPrimitive();
}

void emit_part(Head head) {
  float petals = petal_number[0].y;
  if (petals < 2.0) {
    emit_dot(head);
    return;
  }
  float number = floor(min(petal_number[0].x, petal_number[1].x) + 0.5);
  float angle = 6.2831853 * number / petals;
  vec2 along = vec2(cos(angle), sin(angle));
  vec2 across = vec2(-along.y, along.x);
  emit_centre(head, along, across);
  emit_petal(head, along, across, fract(sin(number * 12.9898 + petal_axis[0].w * 78.233) * 437.5453));
}

void main() {
  Head head = make_head();
  if (gl_InvocationID == 0) {
    emit_part(head);
    return;
  }
  // Shadows of heads too small to see are left to those of the stems.
  head.shadow = ground_shadow_strength(sward_layer.layer, petal_map[0].w, petal_plane[0].xyz) *
                smoothstep(2.0, 5.0, petal_color[0].w);
  if (head.shadow > 0.01) emit_part(head);
}
