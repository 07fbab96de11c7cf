// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of kinds made of shoots, a vertex of a shoot's middle line.
#include "common_layer.glsl"
#include "common_blade.glsl"
#include "common_outline.glsl"
#include "common_stance_line.glsl"
#include "plant_kind.glsl"
#include "common_sway.glsl"
#include "common_bend.glsl"

layout(isolines, fractional_odd_spacing) in;

layout(location = 0) uniform int sward_species;
layout(location = 1) uniform vec4 sward_images;  // common_plant_image.glsl: a cutout takes the outline's place

layout(location = 0) in vec4 plant_root[];
layout(location = 1) in vec4 plant_form[];
layout(location = 2) in vec4 plant_ground[];
layout(location = 3) in vec4 plant_color[];
layout(location = 4) in vec4 plant_self[];
layout(location = 5) in uvec4 plant_words[];
layout(location = 6) patch in uvec4 shoot_slots[4];
layout(location = 10) patch in int shoot_first;
#if SWARD_WIND
layout(location = 14) in vec4 plant_blown[];
layout(location = 15) in float plant_slow[];
layout(location = 16) in uvec3 plant_scales[];
#endif

layout(location = 0) out vec4 line_point;    // relative to the eye; arc length 0..1
layout(location = 1) out vec4 line_tangent;  // unit; half width
layout(location = 2) out vec4 line_plane;    // of the ground: unit normal; its bend (shadow_bend)
layout(location = 3) out vec4 line_color;    // ground at the root; age
layout(location = 4) out vec4 line_map;      // base map coordinates below the eye; azimuth; phase
layout(location = 5) out vec4 line_fade;     // melting into the ground; distance of the root; share of the width that
                                             // its edge shows; which of the plant's shoots
layout(location = 6) out vec3 line_root;     // relative to the eye

PlantTraits drawn_traits(int plant) {
  vec4 form = plant_form[plant];
  return PlantTraits(plant_root[plant].w, form.x, form.y, form.z, plant_color[plant].w, form.w, plant_self[plant].y,
                     plant_words[plant].w);
}

float shoot_contact(int plant, int index) {
  uint contact = plant_words[plant][index / 4] >> uint(8 * (index % 4)) & 255u;
  return contact == 255u ? k_no_contact : float(contact) / 255.0;
}

// The kind's outline, a little wider where few segments would make it smaller.
float drawn_outline(SpeciesParams species, int index, float s) {
  float foot = kind_outline(species, index, 0.0), tip = kind_outline(species, index, 1.0);
  float mean = (foot + 4.0 * kind_outline(species, index, 0.25) + 2.0 * kind_outline(species, index, 0.5) +
                4.0 * kind_outline(species, index, 0.75) + tip) / 12.0;
  return kind_outline(species, index, s) * outline_kept(foot, tip, mean, gl_TessLevelOuter[1]);
}

// The shoot's curve without its contact; it takes on the azimuth that the wind gives it.
BladeCurve shoot_curve(int plant, int index, vec3 normal, inout Shoot shoot) {
  vec2 azimuth = vec2(cos(shoot.azimuth), sin(shoot.azimuth));
#if SWARD_WIND
  vec4 blown = plant_blown[plant];
  PlantAir air = PlantAir(blown.xy, blown.z, blown.w, plant_slow[plant]);
  Bend bend = bend_in_wind(azimuth, shoot.stiffness, shoot.lean, swaying_wind(air, index));
  shoot.azimuth = atan(bend.way.y, bend.way.x);
  BladeCurve curve = bent_curve(bend, shoot.stiffness, normal);
  curve.scale = unpack_scale(plant_scales[plant][index / 4] >> uint(8 * (index % 4)) & 255u);
  return curve;
#else
  return free_curve(shoot.stiffness, shoot.lean, -dot(normal.xy, azimuth) / normal.z);
#endif
}

void main() {
  uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
  uint code = shoot_slots[line / 16u][(line / 4u) % 4u] >> (8u * (line % 4u)) & 255u;
  int plant = int(code) / SWARD_SHOOTS_PER_PATCH;
  int index = shoot_first + int(code) % SWARD_SHOOTS_PER_PATCH;
  SpeciesParams species = sward_layer.species[sward_species];
  PlantTraits traits = drawn_traits(plant);
  Shoot shoot = lay_shoot(species, traits, kind_shoot(species, traits, index));
  // The last shoot of a fraction has that share of its width.
  float shown = clamp(plant_self[plant].x - float(index), 0.0, 1.0);

  vec4 ground = plant_ground[plant];
  vec3 root = plant_root[plant].xyz;
  vec3 normal = vec3(ground.xy, sqrt(max(1.0 - dot(ground.xy, ground.xy), 1.0e-4)));
  vec3 foot = root + vec3(shoot.foot, -dot(normal.xy, shoot.foot) / normal.z);
  BladeCurve curve = shoot_curve(plant, index, normal, shoot);
  vec2 azimuth = vec2(cos(shoot.azimuth), sin(shoot.azimuth));
  curve.contact = shoot_contact(plant, index);
  float s = gl_TessCoord.x;
  BladePoint p = curve_point(curve, s);

  float outline = sward_images.w < 0.0 ? drawn_outline(species, index, s) : 1.0;
  float half_width = 0.5 * plant_form[plant].x * shoot.width * shown * outline;
  line_point = vec4(foot + plant_root[plant].w * shoot.height * vec3(azimuth * p.along, p.up), s);
  hand_on_stance();
  line_tangent = vec4(azimuth * sin(p.inclination), cos(p.inclination), half_width);
  line_plane = vec4(normal, plant_self[plant].w);
  line_root = root;
  line_color = plant_color[plant];
  vec2 uv_per_m = sward_layer.layer.map.xy / sward_layer.layer.map.zw;
  float distance = plant_self[plant].z;
  line_map = vec4(ground.zw - root.xy * uv_per_m, shoot.azimuth, plant_self[plant].y);
  line_fade = vec4(smoothstep(0.02, 0.6, distance / sward_layer.layer.reach.x), distance, shoot.edge, float(index));
}
