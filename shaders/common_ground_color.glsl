// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The ground's colour for classification: mip 0, four fetches, interpolated as stored. GLSL only.
#include "common_layer.glsl"
#include "common_triangle.glsl"

layout(binding = SWARD_BINDING_BASE_MAP_RAW) uniform sampler2D sward_base_map_raw;

struct GroundColor {
  vec4 encoded;  // sRGB and alpha as the file has them
  bool open;     // plants can stand here at all
};

vec4 fetch_ground(ivec2 texel) { return texelFetch(sward_base_map_raw, clamp_texel(sward_layer.layer, texel), 0); }

// `offset` metres (east, north) from the triangle's apex.
GroundColor ground_color(Triangle t, vec2 offset) {
  MapSample s = locate_texel(sward_layer.layer, t.texel, t.texel_fraction, offset);
  GroundColor g;
  g.encoded = blend_texels(fetch_ground(s.texel), fetch_ground(s.texel + ivec2(1, 0)),
                           fetch_ground(s.texel + ivec2(0, 1)), fetch_ground(s.texel + ivec2(1, 1)), s.fraction);
  g.open = ground_is_open(s, g.encoded);
  return g;
}

// What grows on ground of this colour, z choosing between the two best species; species -1: nothing.
Choice classify_ground(GroundColor ground, float z) {
  Choice nothing = Choice(-1, 0.0);
  if (!ground.open) return nothing;
  vec3 hsv = rgb_to_hsv(ground.encoded.rgb);
  TopTwo best = no_species();
  for (int i = 0; i < species_count(); ++i) best = insert_score(best, i, species_score(sward_layer.species[i], hsv));
  if (best.first < 0) return nothing;
  Choice choice = choose_species(best, z);
  vec4 best_kind = sward_layer.species[best.first].kind;
  return plant_allowed(best, choice, best_kind, sward_layer.species[choice.species].kind) ? choice : nothing;
}
