// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Classification by the ground's colour (Papavasiliou 2015, section 3.3, equations 16 and 18). Read by GLSL and C++.

// std140: every member a vec4.
struct SpeciesParams {
  vec4 reference;   // hue (turns), saturation, value; exponent p
  vec4 weights;     // of hue, saturation, value; least accepted score
  vec4 size;        // height min, max; width min, max (m)
  vec4 posture;     // stiffness min, max; largest lean (rad); phototropism
  vec4 tint;        // rgb; mean share of the age tint
  vec4 age_tint;    // rgb; brightness at the root
  vec4 optics;      // translucency, attenuation, specular, shininess
  vec4 kind;        // 1: grows, 0: bare; 1: forbids, or -1 .. 0 (yields); most segments; stream
  vec4 own_a;       // what only the species' kind reads: common_kinds.glsl; a host's kind finds its parameters here
  vec4 own_b;
  vec4 own_c;
  vec4 own_d;
  vec4 altitude;    // rule: least, greatest, soft edge; lowest place above the water (m)
  vec4 slope;       // rule: least, greatest, soft edge (rad); number of its mask, 0: none
  vec4 next;        // reference colour at the season's next step; share of the layer's density
};

struct LayerParams {
  vec4 law;       // law (0 distance, 1 screen area, 2 world area), rho0, d0 times zoom, gamma
  vec4 reach;     // horizon times zoom, cluster size, 1 if plain, species
  vec4 map;       // texels a metre east, texels a metre north (negative: rows run south), width, height
  vec4 detail;    // full segments up to (m, times zoom), shadow distance (times zoom), ceiling, sun's azimuth
  vec4 place;     // number of the layer's mask, 0: none; way to the season's next step; 1 if references move; number of
                  // the height map, 0: none
};

// HSV of an sRGB-encoded colour, as a colour picker shows it; hue in turns.
SWARD_FN vec3 rgb_to_hsv(vec3 c) {
  SWARD_PRECISE float value = max(c.x, max(c.y, c.z));
  SWARD_PRECISE float chroma = value - min(c.x, min(c.y, c.z));
  SWARD_PRECISE float hue = 0.0f;
  if (chroma > 0.0f) {
    if (value == c.x) hue = (c.y - c.z) / chroma;
    else if (value == c.y) hue = 2.0f + (c.z - c.x) / chroma;
    else hue = 4.0f + (c.x - c.y) / chroma;
    hue = hue / 6.0f;
    if (hue < 0.0f) hue = hue + 1.0f;
  }
  SWARD_PRECISE float saturation = value > 0.0f ? chroma / value : 0.0f;
  return vec3(hue, saturation, value);
}

// Equation 16: `reference` is hue (turns), saturation, value and the exponent p, `weights` those of hue, saturation and
// value, and the least score that counts: 0 below it. Hue differences wrap; a nearly grey ground has no hue.
SWARD_FN float color_score(vec4 reference, vec4 weights, vec3 hsv) {
  SWARD_PRECISE float dh = reference.x - hsv.x;
  dh = dh - floor(dh + 0.5f);
  if (hsv.y < 0.02f) dh = 0.0f;
  SWARD_PRECISE float x = dh * weights.x;
  SWARD_PRECISE float y = (reference.y - hsv.y) * weights.y;
  SWARD_PRECISE float z = (reference.z - hsv.z) * weights.z;
  SWARD_PRECISE float distance_squared = x * x + y * y + z * z;
  SWARD_PRECISE float distance = max(sqrt(distance_squared), 1.0e-4f);
  SWARD_PRECISE float score = pow(distance, -reference.w);
  return score >= weights.w ? score : 0.0f;
}

// A species' score by a reference colour of its own or its season's.
SWARD_FN float score_against(SpeciesParams species, vec3 reference, vec3 hsv) {
  return color_score(vec4(reference.x, reference.y, reference.z, species.reference.w), species.weights, hsv);
}

SWARD_FN float species_score(SpeciesParams species, vec3 hsv) {
  return score_against(species, vec3(species.reference.x, species.reference.y, species.reference.z), hsv);
}

// The two best species so far; index -1: none.
struct TopTwo {
  int first, second;
  float first_score, second_score;
};

SWARD_FN TopTwo no_species() {
  TopTwo t;
  t.first = -1;
  t.second = -1;
  t.first_score = 0.0f;
  t.second_score = 0.0f;
  return t;
}

SWARD_FN TopTwo insert_score(TopTwo t, int index, float score) {
  if (score > t.first_score) {
    t.second = t.first;
    t.second_score = t.first_score;
    t.first = index;
    t.first_score = score;
  } else if (score > t.second_score) {
    t.second = index;
    t.second_score = score;
  }
  return t;
}

struct Choice {
  int species;  // -1: nothing competes here
  float score;  // s' of equation 18
};

// The second species is taken when z < s1 / (s0 + s1).
SWARD_FN Choice choose_species(TopTwo t, float z) {
  Choice c;
  c.species = t.first;
  c.score = 0.0f;
  if (t.first < 0) return c;
  SWARD_PRECISE float share = t.second_score / (t.first_score + t.second_score);
  bool take_second = t.second >= 0 && z < share;
  c.species = take_second ? t.second : t.first;
  c.score = take_second ? share : 1.0f - share;
  return c;
}

// Bilinear weights by hand, in one order: top row, bottom row, then down.
SWARD_FN vec4 blend_texels(vec4 nw, vec4 ne, vec4 sw, vec4 se, vec2 f) {
  SWARD_PRECISE vec4 top = nw + (ne - nw) * f.x;
  SWARD_PRECISE vec4 bottom = sw + (se - sw) * f.x;
  SWARD_PRECISE vec4 result = top + (bottom - top) * f.y;
  return result;
}

// Where to fetch for a point at `offset` metres (east, north) from a triangle's apex.
struct MapSample {
  ivec2 texel;    // north-western of the four; not clamped
  vec2 fraction;
  bool inside;    // on the map
};

SWARD_FN MapSample locate_texel(LayerParams layer, ivec2 apex_texel, vec2 apex_fraction, vec2 offset) {
  SWARD_PRECISE float u = apex_fraction.x + offset.x * layer.map.x;
  SWARD_PRECISE float v = apex_fraction.y + offset.y * layer.map.y;
  MapSample s;
  SWARD_PRECISE float cu = u - 0.5f;
  SWARD_PRECISE float cv = v - 0.5f;
  s.texel = apex_texel + ivec2(int(floor(cu)), int(floor(cv)));
  s.fraction = vec2(cu - floor(cu), cv - floor(cv));
  ivec2 whole = apex_texel + ivec2(int(floor(u)), int(floor(v)));
  s.inside = whole.x >= 0 && whole.y >= 0 && whole.x < int(layer.map.z) && whole.y < int(layer.map.w);
  return s;
}

// The base map repeats its outermost texels.
SWARD_FN ivec2 clamp_texel(LayerParams layer, ivec2 texel) {
  return ivec2(clamp(texel.x, 0, int(layer.map.z) - 1), clamp(texel.y, 0, int(layer.map.w) - 1));
}

// Whether the ground at a sample can carry plants at all: on the map, and its blended alpha (red, green, blue, alpha as
// blend_texels gives them) does not forbid it.
SWARD_FN bool ground_is_open(MapSample s, vec4 color) { return s.inside && color.w >= 0.5f; }

// Whether a plant may stand where `t` are the best species and `c` is the choice among them: something grows there, and
// the best species of all does not forbid it. `best` and `chosen` are their SpeciesParams::kind, ignored where there is
// no species. Asked at a cluster's centre, and again, with the cluster's z, at each of its seeds.
SWARD_FN bool plant_allowed(TopTwo t, Choice c, vec4 best, vec4 chosen) {
  if (t.first < 0 || c.species < 0) return false;
  return chosen.x > 0.5f && best.y < 0.5f;
}
