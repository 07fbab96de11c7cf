// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of rosettes: each invocation makes one leaf of the plant and its shadow. Leaves bend by the blade's curve
// (Papavasiliou 2015, section 2.3); the fragment stage cuts their outline.
layout(lines, invocations = 8) in;
layout(triangle_strip, max_vertices = 8) out;

#include "common_object_shape.glsl"
#include "common_blade.glsl"
#include "common_bend.glsl"
#include "common_disturbed.glsl"
#include "common_disturbed_plant.glsl"

layout(location = 0) uniform int sward_species;

struct Frond {
  BladeCurve curve;
  vec3 way;         // level, unit, away from the plant's middle
  vec3 flat_side;   // level, unit, across
  float reach, half_width;
  float flutter;    // turn about the midrib at the tip, radians
};

#if SWARD_WIND
// What a rosette's leaves, held close together at their feet, feel of the wind.
const float k_frond_share = 0.7;

// Bends a leaf in the wind; its blade turns about the midrib, faster than the plant sways.
Frond blown_frond(Object o, Frond f, float lean) {
  uint i = uint(gl_InvocationID);
  PlantAir air = object_air();
  vec2 wind = k_frond_share * swaying_wind(air, int(i));
  Bend bend = bend_in_wind(f.way.xy, o.stiffness, lean, wind);
  f.way = vec3(bend.way, 0.0);
  f.flat_side = vec3(-f.way.y, f.way.x, 0.0);
  f.curve = bent_curve(bend, o.stiffness, vec3(0.0, 0.0, 1.0));
  f.curve.scale = length_kept(f.curve, clamp(o.parts, 1.0, float(SWARD_BLADE_ROWS - 1)));
  f.flutter = fluttering(air, length(wind), own_number(o, 2u * i + 50u));
  return f;
}
#endif

Frond this_frond(Object o, float count) {
  uint i = uint(gl_InvocationID);
  Frond f;
  float spread = 6.2831853 / count;
  float turn = o.azimuth + spread * (float(i) + 0.7 * (own_number(o, 2u * i + 8u) - 0.5));
  float size = mix(0.65, 1.0, own_number(o, 2u * i + 9u));
  // Of a pressed plant the leaves lie on one side, fanned out.
  float pressed = pressed_by_lean(sward_layer.species[sward_species].posture.z, o.lean);
  float aside = (o.azimuth - turn) / 6.2831853;
  turn += 0.7 * 6.2831853 * (aside - floor(aside + 0.5)) * smoothstep(0.0, 0.5, pressed);
  f.way = vec3(cos(turn), sin(turn), 0.0);
  f.flat_side = vec3(-f.way.y, f.way.x, 0.0);
  // The middle ones of a rosette stand, the others spread.
  float lean = sward_layer.species[sward_species].posture.z * mix(0.35, 1.0, own_number(o, 2u * i + 30u));
  f.curve = free_curve(o.stiffness, mix(lean, o.lean, pressed), 0.0);
  f.reach = o.height * size;
  f.half_width = 0.5 * o.width * size;
  f.flutter = 0.0;
#if SWARD_WIND
  f = blown_frond(o, f, mix(lean, o.lean, pressed));
#endif
  return f;
}

struct Section {
  vec3 middle;
  vec3 tangent;
  float along;
};

// A point of the midrib; what would be in the ground lies on it.
Section frond_section(Object o, Frond f, float s) {
  BladePoint p = curve_point(f.curve, s);
  vec3 point = f.reach * (f.way * p.along + vec3(0.0, 0.0, p.up));
  float depth = dot(point, o.plane);
  float above = 0.01 * f.reach * s;
  if (depth < above) point += o.plane * (above - depth);
  return Section(o.root + point, f.way * sin(p.inclination) + vec3(0.0, 0.0, cos(p.inclination)), s);
}

// Across the leaf, turned to the eye a little: never edge-on.
vec3 leaf_side(Frond f, Section at) {
  vec3 across = cross(at.tangent, normalize(-at.middle));
  across *= dot(across, f.flat_side) < 0.0 ? -1.0 : 1.0;
  return normalize(f.flat_side + 0.3 * across);
}

void emit_leaf(Object o, Frond f, Section a, Section b) {
  float size = pixels(o, 2.0 * f.half_width);
  float half_width = f.half_width * inflation(size);
  for (int i = 0; i < 2; ++i) {
    Section at = i == 0 ? a : b;
    vec3 side = leaf_side(f, at);
    vec3 half_way = normalize(normalize(-at.middle) + from_world(frame.sun_direction.xyz));
    vec3 normal = cross(at.tangent, f.flat_side);
    normal *= normal.z < 0.0 ? -1.0 : 1.0;
#if SWARD_WIND
    float turn = f.flutter * at.along;
    vec3 level = side;
    side = level * cos(turn) + normal * sin(turn);
    normal = normal * cos(turn) - level * sin(turn);
#endif
    for (int edge = -1; edge < 2; edge += 2) {
      Part part = Part(vec2(float(edge), at.along), 1.0 / inflation(size), float(gl_InvocationID), k_part_object,
                       dot(normalize(at.tangent), half_way));
      // The two halves of a leaf rise from the rib.
      vec3 folded = side * float(edge) + 0.25 * normal;
      emit(o, part, at.middle + folded * half_width, normal - 0.45 * float(edge) * side);
    }
  }
  EndPrimitive();
}

void emit_shadow(Object o, Frond f, Section a, Section b) {
  float strength = object_shadow_strength(o);
  if (strength <= 0.01) return;
  ShadowPlane ground = object_shadow_plane(o);
  for (int i = 0; i < 2; ++i) {
    Section at = i == 0 ? a : b;
    for (int edge = -1; edge < 2; edge += 2) {
      Part part = Part(vec2(float(edge), at.along), 1.0, float(gl_InvocationID), strength, 1.0);
      emit(o, part, cast_on_ground(ground, at.middle + f.flat_side * (float(edge) * f.half_width)), o.plane);
    }
  }
  EndPrimitive();
}

void main() {
  Object o = this_object();
  float count = sward_layer.species[sward_species].own_a.x;
  if (float(gl_InvocationID) >= count) return;
  Frond f = this_frond(o, count);
  Section a = frond_section(o, f, o.first), b = frond_section(o, f, o.second);
  emit_leaf(o, f, a, b);
  if (SWARD_GROWTH_INVOCATIONS > 1) emit_shadow(o, f, a, b);
}
