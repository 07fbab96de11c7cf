// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The ground's colour for classification: mip 0, four fetches, interpolated as stored. GLSL only.
#include "common_layer.glsl"
#include "common_triangle.glsl"

layout(binding = SWARD_BINDING_BASE_MAP_RAW) uniform sampler2D sward_base_map_raw;

layout(binding = SWARD_BINDING_PLACEMENT) uniform usamplerBuffer sward_placement;
layout(binding = SWARD_BINDING_EXCLUSIONS) uniform samplerBuffer sward_exclusions;

// A place on a triangle, as classification sees it.
struct Site {
  vec4 encoded;  // sRGB and alpha as the file has them
  bool open;     // plants can stand here at all
  vec2 offset;   // from the apex, metres east and north
  float altitude;
};

vec4 fetch_ground(ivec2 texel) { return texelFetch(sward_base_map_raw, clamp_texel(sward_layer.layer, texel), 0); }

// `point` in weights of the triangle.
Site site_at(Triangle t, vec2 point) {
  Site site;
  site.offset = offset_from_apex(t.to_left, t.to_right, point);
  site.altitude = altitude_at(t.altitude, point);
#if SWARD_ON_MESH
  site.encoded = vec4(surface_color(t.texel, t.texel_fraction, point), 1.0);
  site.open = true;
  return site;
#else
  MapSample s = locate_texel(sward_layer.layer, t.texel, t.texel_fraction, site.offset);
  site.encoded = blend_texels(fetch_ground(s.texel), fetch_ground(s.texel + ivec2(1, 0)),
                              fetch_ground(s.texel + ivec2(0, 1)), fetch_ground(s.texel + ivec2(1, 1)), s.fraction);
  site.open = ground_is_open(s, site.encoded);
  return site;
#endif
}

// Masks: two texels each tell the first texel, width, height; the header (layer_params.h). The greys stand sixteen a texel.
float fetch_mask(uvec4 mask, ivec2 texel) {
  uint place = mask_texel(texel, ivec2(mask.yz));
  uvec4 greys = texelFetch(sward_placement, int(mask.x + (place >> 4)));
  return float(greys[(place >> 2) & 3u] >> (8u * (place & 3u)) & 255u);
}

float mask_share(Triangle t, vec2 offset, float number) {
  if (number == 0.0) return 1.0;
  int head = 2 * (int(number) - 1);
  uvec4 mask = texelFetch(sward_placement, head);
  vec2 scale = uintBitsToFloat(texelFetch(sward_placement, head + 1).xy);
  vec2 place = mask_place(scale, sward_layer.layer, t.texel, t.texel_fraction, offset);
  precise vec2 corner = place - vec2(0.5);
  vec2 whole = floor(corner);
  precise vec2 fraction = corner - whole;
  ivec2 nw = ivec2(whole);
  return mask_factor(fetch_mask(mask, ivec2(floor(place))), fetch_mask(mask, nw), fetch_mask(mask, nw + ivec2(1, 0)),
                     fetch_mask(mask, nw + ivec2(0, 1)), fetch_mask(mask, nw + ivec2(1, 1)), fraction);
}

// Factor on the heights of what stands here, of the layer's tiled map (Knowles and Fryazinov 2015, section 2).
float height_share(Triangle t, vec2 offset) {
  float number = sward_layer.layer.place.w;
  if (number == 0.0) return 1.0;
  int head = 2 * (int(number) - 1);
  uvec4 map = texelFetch(sward_placement, head);
  vec4 header = uintBitsToFloat(texelFetch(sward_placement, head + 1));
  vec2 place = mask_place(header.xy, sward_layer.layer, t.texel, t.texel_fraction, offset);
  TilePlace at = tile_place(place, ivec2(map.yz));
  return height_factor(fetch_mask(map, at.low), fetch_mask(map, ivec2(at.high.x, at.low.y)),
                       fetch_mask(map, ivec2(at.low.x, at.high.y)), fetch_mask(map, at.high), at.fraction, header.z);
}

// By the species' own rules: slope, altitude, water, mask.
float species_share(Triangle t, Site site, SpeciesParams species) {
  precise float share = terrain_factor(species.altitude, species.slope, site.altitude, t.slope) *
                        mask_share(t, site.offset, species.slope.w);
  return share;
}

// What grows here, z choosing between the two best species; species -1: nothing. `next`: at the season's next step.
Choice classify_site(Triangle t, Site site, float z, bool next) {
  Choice nothing = Choice(-1, 0.0);
  if (!site.open) return nothing;
  vec3 hsv = rgb_to_hsv(site.encoded.rgb);
  TopTwo best = no_species();
  for (int i = 0; i < species_count(); ++i) {
    SpeciesParams species = sward_layer.species[i];
    precise float score = score_against(species, next ? species.next.xyz : species.reference.xyz, hsv);
    if (score > 0.0) score = score * species_share(t, site, species);
    best = insert_score(best, i, score);
  }
  if (best.first < 0) return nothing;
  Choice choice = choose_species(best, z);
  vec4 best_kind = sward_layer.species[best.first].kind;
  return plant_allowed(best, choice, best_kind, sward_layer.species[choice.species].kind) ? choice : nothing;
}

// What a cluster grows; a score below 0 marks one that turns from one species to another.
Choice choose_cluster(Triangle t, vec2 centre, float z) {
  Site site = site_at(t, centre);
  Choice now = classify_site(t, site, z, false);
  if (sward_layer.layer.place.z == 0.0) return now;
  return blend_choice(sward_layer.layer, now, classify_site(t, site, z, true));
}

bool excluded(uint run, vec2 offset) {
  if (run == 0u) return false;
  for (int at = int(run);; ++at) {
    vec4 head = texelFetch(sward_exclusions, at);
    if (head.w == k_shape_end) return false;
    if (head.w == k_shape_disc) {
      if (disc_covers(head, offset)) return true;
      continue;
    }
    bool inside = head.x != 0.0;
    for (int edges = int(head.y); edges > 0; --edges) {
      ++at;
      if (edge_crossed(texelFetch(sward_exclusions, at), offset)) inside = !inside;
    }
    if (inside) return true;
  }
  return false;
}
