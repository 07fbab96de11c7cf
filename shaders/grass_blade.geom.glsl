// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of grass, and of all that is made of shoots: a line segment becomes a piece of the blade's strip, and of its
// shadow on the ground's plane (Papavasiliou 2015, sections 2.3 and 3.6). One invocation makes both: what is read for
// one is read for the other, and an invocation more costs more than the vertices.
#include "common_frame.glsl"
#include "common_layer.glsl"
#include "common_visible.glsl"
#include "common_shadow_projection.glsl"
#include "common_strip_light.glsl"
#include "common_leaf.glsl"
#include "common_shadow_light.glsl"
#include "plant_kind.glsl"
#include "common_stance_shape.glsl"

layout(lines) in;
layout(triangle_strip, max_vertices = 4 * SWARD_GROWTH_INVOCATIONS) out;

layout(location = 0) in vec4 line_point[];    // relative to the eye; arc length 0..1
layout(location = 1) in vec4 line_tangent[];  // unit; half width
layout(location = 2) in vec4 line_plane[];    // of the ground: unit normal; its bend (shadow_bend)
layout(location = 3) in vec4 line_color[];    // ground at the root; age
layout(location = 4) in vec4 line_map[];      // base map coordinates below the eye; azimuth; phase
layout(location = 5) in vec4 line_fade[];     // melting into the ground; distance; share of the width that its edge
                                              // shows, 1: round; which of the plant's shoots
layout(location = 6) in vec3 line_root[];     // relative to the eye

#define SWARD_LINK out
#include "common_strip_links.glsl"

layout(location = 0) uniform int sward_species;

// Thinner than this on screen, pixels, a strip is drawn this wide with less coverage. Many samples show thinner ones.
const float k_least_half_width_px = 0.6;

// Pixels of half width up to which a strip is flat, and one light does for both edges; from which on it is as round as
// it is.
const float k_flat_px = 0.75;
const float k_round_px = 2.0;

float least_half_width(float distance) {
  float samples = max(frame.eye_noise.w, 1.0);
  return k_least_half_width_px * inversesqrt(sqrt(samples)) * distance / frame.focal.y;
}

// One end of the segment: its middle, half the drawn width to one side, the share of it that is covered, the normal.
struct Section {
  vec3 middle;
  vec3 side;
  float cover;
  vec3 normal;
  vec2 canopy;  // light of sky and sun among the neighbours
};

// What the whole plant shares.
struct Plant {
  vec3 flat_side;    // unit, level, across the bending plane
  vec3 root;
  vec3 plane;        // the ground's normal
  float edge_share;  // least share of the width that is seen: blades are not flat
  float shadow;      // strength; negative: this is the blade itself
  float far;         // 0: blades can be told apart .. 1: they cannot, and have the ground's normal
};

// What a vertex hands to the fragments about its light.
struct VertexLight {
  vec3 normal;
  float gloss;
  vec4 strip;  // strip_light
  vec3 lit;    // strip_lit
};

// Of the shadow on ground of the plant's own colour.
VertexLight shadow_vertex(Plant plant) {
  vec3 surface = to_world(plant.plane);
  vec3 lit = shade_ground(line_color[0].rgb, surface, to_world(line_root[0]), shadow_light(plant.shadow));
  return VertexLight(surface, 0.0, vec4(0.0), encode_output(lit));
}

vec3 lit_leaf(int i, vec3 surface, vec3 position, float across, StripLight light, vec4 strip) {
  SpeciesParams species = sward_layer.species[sward_species];
  Leaf leaf = kind_leaf(species, line_color[i], int(line_fade[i].w + 0.5), line_point[i].w, across, line_map[i].w);
  vec3 lit = strip_leaf(species, leaf, strip, light.gloss, light.normal);
  return encode_output(melt_into_ground(lit, line_color[i].rgb, vec4(surface, line_fade[i].x), position));
}

VertexLight leaf_vertex(int i, Plant plant, Section s, float across, vec3 normal) {
  vec3 position = to_world(s.middle + s.side * across), surface = to_world(plant.plane);
  StripLight light = strip_light_at(sward_layer.species[sward_species].optics, to_world(normal),
                                    to_world(line_tangent[i].xyz), position, surface, plant.far);
  vec4 strip = vec4(s.canopy, light.through, light.along);
  vec3 lit = SWARD_LIT_AT_VERTICES == 1 ? lit_leaf(i, surface, position, across, light, strip) : vec3(0.0);
  return VertexLight(light.normal, light.gloss, strip, lit);
}

void emit(int i, Plant plant, Section s, float across, VertexLight light) {
  vec3 position = to_world(s.middle + s.side * across);
  gl_Position = frame.clip_from_relative * vec4(position, 1.0);
  strip_place = vec3(line_point[i].w, across, s.cover);
  strip_self = vec2(line_map[i].w, plant.shadow);
  strip_lit = light.lit;
#if !SWARD_LIT_AT_VERTICES
  strip_point = position;
  strip_normal = vec4(light.normal, light.gloss);
  strip_light = light.strip;
  strip_color = line_color[i];
  strip_ground = vec4(to_world(plant.plane), line_fade[i].x);
  strip_map = line_map[i].xy;
#endif
  EmitVertex();
}

bool pointed(int i) { return line_tangent[i].w <= 0.0; }

void emit_end(int i, Plant plant, Section s, VertexLight light) {
  emit(i, plant, s, pointed(i) ? 0.0 : -1.0, light);
  if (!pointed(i)) emit(i, plant, s, 1.0, light);
}

// Normals of the two edges lean outwards, so that the strip shades like a round or folded leaf.
void emit_leaf_end(int i, Plant plant, Section s, float roundness) {
  float half_px = length(s.side) * frame.focal.y / max(length(s.middle), 1.0e-3);
  roundness *= smoothstep(k_flat_px, k_round_px, half_px);
  if (pointed(i) || roundness <= 0.0) {
    emit_end(i, plant, s, leaf_vertex(i, plant, s, 0.0, s.normal));
    return;
  }
  vec3 outwards = normalize(s.side) * roundness;
  emit(i, plant, s, -1.0, leaf_vertex(i, plant, s, -1.0, s.normal - outwards));
  emit(i, plant, s, 1.0, leaf_vertex(i, plant, s, 1.0, s.normal + outwards));
}

// The strip between two sections must not cross itself.
Section turned_with(Section first, Section second) {
  if (dot(first.side, second.side) < 0.0) second.side = -second.side;
  return second;
}

Section blade_section(int i, Plant plant) {
  vec3 flat_side = plant.flat_side;
  vec3 point = line_point[i].xyz;
  vec3 tangent = line_tangent[i].xyz;
  float distance = max(length(point), 1.0e-3);
  vec3 to_eye = -point / distance;
  // Across the blade as the viewer sees it: never edge-on.
  vec3 across = cross(tangent, to_eye);
  vec3 side = normalize(across * (dot(across, flat_side) < 0.0 ? -1.0 : 1.0) + 0.1 * flat_side);
  float seen = line_tangent[i].w * max(abs(dot(side, flat_side)), plant.edge_share);
  float drawn = max(seen, least_half_width(distance));
  vec3 normal = cross(flat_side, tangent);
  normal = dot(normal, to_eye) < 0.0 ? -normal : normal;
  return Section(point, side * drawn, seen / drawn, normal, vec2(1.0));
}

void emit_blade(Plant plant) {
  Section sections[2] = Section[2](blade_section(0, plant), blade_section(1, plant));
  SpeciesParams species = sward_layer.species[sward_species];
  vec3 surface = to_world(plant.plane);
  Canopy canopy = canopy_of(sward_layer.layer, species, dot(surface, frame.sun_direction.xyz));
  plant.far = strip_distance(line_fade[0].x, max(sections[0].cover, sections[1].cover));
  for (int i = 0; i < 2; ++i) {
    float height = max(dot(plant.plane, line_point[i].xyz - plant.root), 0.0);
    sections[i].canopy = field_light(species, canopy_light(canopy, height), plant.far);
    sections[i].canopy.y *= body_light(surface, to_world(sections[i].middle));
  }
  float roundness = 0.5 + 0.6 * (plant.edge_share - 0.35);
  emit_leaf_end(0, plant, sections[0], roundness);
  emit_leaf_end(1, plant, turned_with(sections[0], sections[1]), roundness);
  EndPrimitive();
}

void emit_shadow(Plant plant) {
  float reach = sward_layer.species[sward_species].size.y;
  ShadowPlane ground = shadow_plane(plant.root, plant.plane, line_plane[0].w, reach);
  vec3 ends[2];
  for (int i = 0; i < 2; ++i) ends[i] = cast_shadow(ground, line_point[i].xyz);
  vec3 way = ends[1] - ends[0];
  if (dot(way, way) < 1.0e-10) return;
  vec3 across = normalize(cross(plant.plane, way));
  vec3 flat_shadow = plant.flat_side - plant.plane * dot(plant.plane, plant.flat_side) +
                     ground.slide * dot(plant.plane, plant.flat_side);
  float caster = abs(dot(flat_shadow, across));
  Section sections[2];
  for (int i = 0; i < 2; ++i) {
    float distance = max(length(ends[i]), 1.0e-3);
    float thrown = line_tangent[i].w * max(caster, plant.edge_share);
    float drawn = max(thrown + shadow_blur(line_point[i].xyz, ends[i]), least_half_width(distance));
    sections[i] = Section(lifted(ground, ends[i]), across * (drawn * (1.0 - ground.lift)), thrown / drawn,
                          plant.plane, vec2(0.0));
  }
  VertexLight light = shadow_vertex(plant);
  emit_end(0, plant, sections[0], light);
  emit_end(1, plant, turned_with(sections[0], sections[1]), light);
  EndPrimitive();
}

void main() {
  float azimuth = line_map[0].z;
  Plant plant = Plant(vec3(-sin(azimuth), cos(azimuth), 0.0), line_root[0], line_plane[0].xyz, line_fade[0].z,
                      -1.0 - line_fade[0].w, 0.0);
  emit_blade(plant);
  if (SWARD_GROWTH_INVOCATIONS == 1) return;
  plant.shadow = ground_shadow_strength(sward_layer.layer, line_fade[0].y, plant.plane);
  if (plant.shadow > 0.01) emit_shadow(plant);
}
