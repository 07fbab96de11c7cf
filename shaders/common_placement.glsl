// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rules of placement: ranges with soft edges, masks, excluded shapes; and what stands while a season turns. Read by GLSL
// and C++.

// 1 within [range.x, range.y], 0 from range.z beyond it, straight between.
SWARD_FN float range_factor(float value, vec4 range) {
  SWARD_PRECISE float beyond = max(range.x - value, value - range.y);
  if (beyond <= 0.0f) return 1.0f;
  if (beyond >= range.z) return 0.0f;
  SWARD_PRECISE float factor = 1.0f - beyond / range.z;
  return factor;
}

// Slope (radians) and altitude (metres) by a species' rules; `altitude.w` is the lowest place above the water.
SWARD_FN float terrain_factor(vec4 altitude_rule, vec4 slope_rule, float altitude, float slope) {
  if (altitude < altitude_rule.w) return 0.0f;
  SWARD_PRECISE float factor = range_factor(altitude, altitude_rule) * range_factor(slope, slope_rule);
  return factor;
}

// Altitude at a point of a triangle, by weights (left, right).
SWARD_FN float altitude_at(vec3 corners, vec2 point) {
  SWARD_PRECISE float left = (corners.y - corners.x) * point.x;
  SWARD_PRECISE float right = (corners.z - corners.x) * point.y;
  SWARD_PRECISE float altitude = corners.x + left + right;
  return altitude;
}

// Where to look a mask up: (u, v) in its texels, row 0 in the north. `scale` is texels of the mask a texel of the map.
SWARD_FN vec2 mask_place(vec2 scale, LayerParams layer, ivec2 apex_texel, vec2 apex_fraction, vec2 offset) {
  SWARD_PRECISE float u = float(apex_texel.x) + (apex_fraction.x + offset.x * layer.map.x);
  SWARD_PRECISE float v = float(apex_texel.y) + (apex_fraction.y + offset.y * layer.map.y);
  SWARD_PRECISE float x = u * scale.x;
  SWARD_PRECISE float y = v * scale.y;
  return vec2(x, y);
}

// Place of a texel in a mask of `size`, rows one after the other; the outermost repeat.
SWARD_FN uint mask_texel(ivec2 texel, ivec2 size) {
  return uint(clamp(texel.y, 0, size.y - 1)) * uint(size.x) + uint(clamp(texel.x, 0, size.x - 1));
}

// Values 0..255 of the texels around, and of the one that the place lies in: 0 there forbids.
SWARD_FN float mask_factor(float own, float nw, float ne, float sw, float se, vec2 f) {
  if (own == 0.0f) return 0.0f;
  SWARD_PRECISE float top = nw + (ne - nw) * f.x;
  SWARD_PRECISE float bottom = sw + (se - sw) * f.x;
  SWARD_PRECISE float factor = (top + (bottom - top) * f.y) / 255.0f;
  return factor;
}

// Four texels of a tiled map around a place given in tiles, and how far between them it lies.
struct TilePlace {
  ivec2 low;   // north-western
  ivec2 high;  // south-eastern
  vec2 fraction;
};

SWARD_FN TilePlace tile_place(vec2 place, ivec2 size) {
  SWARD_PRECISE float x = (place.x - floor(place.x)) * float(size.x) - 0.5f;
  SWARD_PRECISE float y = (place.y - floor(place.y)) * float(size.y) - 0.5f;
  ivec2 corner = ivec2(int(floor(x)), int(floor(y)));
  TilePlace t;
  t.fraction = vec2(x - floor(x), y - floor(y));
  t.low = ivec2(corner.x < 0 ? size.x - 1 : corner.x, corner.y < 0 ? size.y - 1 : corner.y);
  t.high = ivec2(corner.x + 1 < size.x ? corner.x + 1 : 0, corner.y + 1 < size.y ? corner.y + 1 : 0);
  return t;
}

// Factor on a plant's height from four greys, 0..255: `least` where they are black.
SWARD_FN float height_factor(float nw, float ne, float sw, float se, vec2 f, float least) {
  SWARD_PRECISE float top = nw + (ne - nw) * f.x;
  SWARD_PRECISE float bottom = sw + (se - sw) * f.x;
  SWARD_PRECISE float factor = least + (1.0f - least) * ((top + (bottom - top) * f.y) / 255.0f);
  return factor;
}

// Excluded shapes near a triangle: a run of texels that ends with one whose w is 0. A disc is (x, y, squared radius, 1); a
// polygon (inside before any edge, edges, 0, 2) and then that many edges (x0, y0, x1, y1), which the ray from a place to
// the east may cross. All x, y in metres from the triangle's apex.
const float k_shape_end = 0.0f;
const float k_shape_disc = 1.0f;

SWARD_FN bool disc_covers(vec4 disc, vec2 place) {
  SWARD_PRECISE float x = place.x - disc.x;
  SWARD_PRECISE float y = place.y - disc.y;
  SWARD_PRECISE float squared = x * x + y * y;
  return squared <= disc.z;
}

SWARD_FN bool edge_crossed(vec4 edge, vec2 place) {
  bool up = edge.y <= place.y && edge.w > place.y;
  bool down = edge.w <= place.y && edge.y > place.y;
  SWARD_PRECISE float side = (edge.z - edge.x) * (place.y - edge.y) - (place.x - edge.x) * (edge.w - edge.y);
  return (up && side > 0.0f) || (down && side < 0.0f);
}

// A seed's own number in [0, 1), of bits that its place does not use: it stands where that is below its factor.
SWARD_FN float standing_number(uvec2 pair) {
  return float((pair.x & 255u) << 8 | (pair.y & 255u)) * 1.52587890625e-5f;
}

// While reference colours move, plants are chosen at two steps of the season and what differs between them shrinks in
// the first half of the way and grows in the second. `layer.place`: mask, way (0..1), 1 while they move.
SWARD_FN Choice blend_choice(LayerParams layer, Choice now, Choice next) {
  Choice c = layer.place.y < 0.5f ? now : next;
  if (now.species == next.species) {
    SWARD_PRECISE float score = now.score + (next.score - now.score) * layer.place.y;
    c.score = score;
  } else {
    c.score = -c.score;  // marks a cluster that turns from one species to another
  }
  return c;
}

// How much of a seed stands: `now` and `next` say whether its own ground allows it at the two steps.
SWARD_FN float season_presence(LayerParams layer, bool now, bool next, bool turning) {
  bool shown = layer.place.y < 0.5f ? now : next;
  if (!shown) return 0.0f;
  if (!turning && now == next) return 1.0f;
  SWARD_PRECISE float way = 1.0f - 2.0f * layer.place.y;
  return way < 0.0f ? -way : way;
}
