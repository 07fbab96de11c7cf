// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of plants that are small meshes: a piece of the line becomes eight faces, bent along the plant's axis by the
// blade's curve (Papavasiliou 2015, section 2.3), so that lengths along it are kept; the second invocation lays their
// shadow on the ground's plane.
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(triangle_strip, max_vertices = 24) out;

#include "common_object_shape.glsl"
#include "common_blade.glsl"
#include "common_bend.glsl"
#include "common_mesh_plant.glsl"

layout(location = 0) uniform int sward_species;

// Two texels a corner: x, y (of the widest's diameter), height coordinate, colour; normal, height beyond the coordinate.
layout(binding = SWARD_BINDING_PLANT_MESH) uniform samplerBuffer sward_plant_mesh;

layout(location = 6) out vec3 part_own_color;  // linear

struct Corner {
  vec3 place;  // relative to the root, metres
  vec3 normal;
  vec3 color;
};

struct Bent {
  Object object;
  BladeCurve curve;
  vec3 way, aside;  // level: towards the azimuth, to its left
  mat2 turn;        // of the mesh about its axis
};

Bent this_bent() {
  Bent b;
  b.object = this_object();
  Object o = b.object;
  b.curve = free_curve(o.stiffness, o.lean, 0.0);
  b.way = vec3(cos(o.azimuth), sin(o.azimuth), 0.0);
  float turn = 6.2831853 * own_number(o, 1u);
#if SWARD_WIND
  Bend bend = bend_in_wind(b.way.xy, o.stiffness, o.lean, swaying_wind(object_air(), 0));
  // The plane of bending turns, the plant does not.
  turn -= atan(b.way.x * bend.way.y - b.way.y * bend.way.x, dot(b.way.xy, bend.way));
  b.way = vec3(bend.way, 0.0);
  b.curve = free_curve(o.stiffness, bend.lean, 0.0);
  b.curve.layer = bend.layer;
#endif
  b.aside = vec3(-b.way.y, b.way.x, 0.0);
  b.turn = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  return b;
}

vec3 unpack_linear(float packed_color) {
  vec3 bytes = floor(mod(vec3(packed_color) / vec3(65536.0, 256.0, 1.0) + 0.0009765625, vec3(256.0)));
  return pow(bytes / 255.0, vec3(2.2));
}

// A corner on the bent axis. What would be in the ground lies on it.
Corner bent_corner(Bent b, int index) {
  vec4 place = texelFetch(sward_plant_mesh, 2 * index);
  vec4 normal = texelFetch(sward_plant_mesh, 2 * index + 1);
  BladePoint p = curve_point(b.curve, place.z);
  vec3 up = b.way * sin(p.inclination) + vec3(0.0, 0.0, cos(p.inclination));
  vec3 ahead = b.way * cos(p.inclination) - vec3(0.0, 0.0, sin(p.inclination));
  vec2 across = b.turn * place.xy * b.object.width;
  vec2 facing = b.turn * normal.xy;
  Corner c;
  c.place = b.object.height * (b.way * p.along + vec3(0.0, 0.0, p.up) + up * normal.w) + ahead * across.x +
            b.aside * across.y;
  float depth = dot(c.place, b.object.plane);
  if (place.z > 0.0 && depth < 0.0) c.place -= b.object.plane * depth;
  c.normal = ahead * facing.x + b.aside * facing.y + up * normal.z;
  c.color = unpack_linear(place.w);
  return c;
}

void emit_face(Bent b, int face, float size, float cover, float strength, ShadowPlane ground) {
  Corner corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = bent_corner(b, 3 * face + i);
  vec3 middle = (corners[0].place + corners[1].place + corners[2].place) / 3.0;
  for (int i = 0; i < 3; ++i) {
    vec3 point = b.object.root + middle + (corners[i].place - middle) * size;
    vec2 mask = vec2(i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0);
    Part part = Part(mask, cover, float(face), strength, dot(point - b.object.root, b.object.plane) / b.object.height);
    part_own_color = corners[i].color;
    emit(b.object, part, strength >= 0.0 ? cast_on_ground(ground, point) : point, corners[i].normal);
  }
  EndPrimitive();
}

void main() {
  Bent b = this_bent();
  Object o = b.object;
  float faces = sward_layer.species[sward_species].own_a.x;
  float shown = o.parts * k_faces_a_part;
  float pieces = ceil(line_self[0].w);
  int first = int(floor(o.first * pieces + 0.5)) * int(k_faces_a_part);
  float strength = k_part_object;
  ShadowPlane ground = object_shadow_plane(o);
  if (gl_InvocationID == 1) {
    strength = object_shadow_strength(o);
    if (strength <= 0.01) return;
  }
  float size = pixels(o, max(o.width, o.height)), grown = inflation(size);
  for (int i = 0; i < int(k_faces_a_part); ++i) {
    // The last face of a fraction is that much smaller.
    float share = clamp(shown - float(first + i), 0.0, 1.0);
    if (share <= 0.0) return;
    emit_face(b, first + i, sqrt(faces / shown) * share * grown, cover_small(size), strength, ground);
  }
}
