// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Detail textures on the ground, blended by the base map's colour (Papavasiliou 2015, equation 17): factors around 1 on
// the base map's colour, at three scales, on the two planes that steep ground turns to most. GLSL only.
//
// Texture reads a fragment, for each of the materials that share it (1, at a border 2, never above 3): near the eye 2
// for the finest scale (factor, slope) and 1 for the middle one; from where a pixel is an eighth of the finest tile 2,
// then 1, then none. Where two pieces of the texture meet twice as many (about a third of the ground), on faces between
// flat and steep twice again. So 3 to 6 near on most ground, 36 at the very worst.
#include "common_frame.glsl"
#include "common_shared.glsl"
#include "common_classify.glsl"
#include "common_material.glsl"
#include "common_noise.glsl"

layout(std140, binding = SWARD_BINDING_MATERIALS) uniform SwardMaterials {
  vec4 head;  // materials; reads along a pixel's longer side: more than 1 where filters know no anisotropy
  MaterialParams material[k_most_materials];
} sward_materials;

layout(binding = SWARD_BINDING_DETAIL) uniform sampler2DArray sward_detail;              // factor, height
layout(binding = SWARD_BINDING_DETAIL_SLOPE) uniform sampler2DArray sward_detail_slope;  // of the height

const float k_shade_unit = 255.0 / 128.0;  // DetailTexture::k_unit
const float k_middle_step = 6.7;           // the middle scale's tile against the finest
const float k_broad_step = 43.0;
const float k_least_share = 0.08;          // is taken from every material's share: those that are left with none are not read

// The place, and what is the same for all materials.
struct SplatPlace {
  vec3 point;      // metres, modulo the period
  vec3 across, down;  // on the ground, from one pixel to the next
  float footprint;    // metres a pixel
  vec3 planes;     // shares of the planes across x, y, z
  vec3 variants;   // noise that the pieces of the finest, the middle, the broad scale hang on
};

struct Splat {
  vec3 shade;     // factor on the base map's colour, mean 1
  vec3 gradient;  // of the height along the surface, metres a metre
};

struct SplatTap {
  vec3 shade;
  float height;
  vec2 slope;
};

bool has_materials() { return sward_materials.head.x > 0.0; }

// Step on the plane through `point` (relative to the eye) with this normal, from a pixel to its neighbour `direction`
// (unit, along the screen).
vec3 pixel_step(vec3 point, vec3 normal, vec3 direction, float depth, float focal) {
  vec3 step_across = direction * (depth / focal);
  float facing = dot(normal, point);
  float least = 0.01 * length(point);
  facing = facing < 0.0 ? min(facing, -least) : max(facing, least);
  return step_across - point * (dot(normal, step_across) / facing);
}

// Shares of the planes across the axes: flat ground has one, ground between flat and steep two, none of them stretched.
vec3 plane_shares(vec3 normal) {
  vec3 n = abs(normal);
  n -= min(n.x, min(n.y, n.z));
  n *= n;
  n *= n;
  n = max(n / (n.x + n.y + n.z) - 0.03, 0.0);
  return n / (n.x + n.y + n.z);
}

SplatPlace splat_place(vec3 relative_position, vec3 normal, float footprint, vec3 variants) {
  SplatPlace place;
  mat4 turn = frame.eye_from_relative;
  vec3 right = vec3(turn[0][0], turn[1][0], turn[2][0]);
  vec3 up = vec3(turn[0][1], turn[1][1], turn[2][1]);
  float depth = max(-dot(vec3(turn[0][2], turn[1][2], turn[2][2]), relative_position), 1.0e-3);
  place.point = relative_position + vec3(frame.eye_noise.xy, frame.up.w);
  place.across = pixel_step(relative_position, normal, right, depth, frame.focal.x);
  place.down = pixel_step(relative_position, normal, up, depth, frame.focal.y);
  place.footprint = footprint;
  place.planes = plane_shares(normal);
  place.variants = variants;
  return place;
}

vec2 on_plane(vec3 v, int axis) { return axis == 2 ? v.xy : (axis == 1 ? v.xz : v.yz); }

// Filters without anisotropy blur by the longer step: it is shortened towards the shorter one, as ground_footprint does,
// and read in several places along it.
struct SplatFilter {
  vec2 du, dv;  // one read's
  vec2 along;   // from one read to the next
  float reads;
};

SplatFilter splat_filter(vec2 dx, vec2 dy) {
  SplatFilter f;
  f.du = dx;
  f.dv = dy;
  f.along = vec2(0.0);
  f.reads = sward_materials.head.y;
  if (f.reads <= 1.0) return f;
  float x = max(length(dx), 1.0e-9), y = max(length(dy), 1.0e-9);
  float part = pow(min(x, y) / max(x, y), 0.3);
  f.along = (x > y ? dx : dy) * (part / f.reads);
  part = max(part / f.reads, min(x, y) / max(x, y));
  if (x > y) f.du *= part;
  else f.dv *= part;
  return f;
}

// Pieces of the texture are moved about, so that no tile is seen twice in a row: `piece` numbers them.
vec4 read_piece(float layer, vec2 uv, SplatFilter f, float piece, bool relief, out vec2 slope) {
  vec2 at = uv + fract(vec2(0.7548777, 0.5698403) * piece) - f.along * (0.5 * (f.reads - 1.0));
  vec4 shade = vec4(0.0);
  slope = vec2(0.0);
  for (float i = 0.0; i < f.reads; i += 1.0) {
    vec3 place = vec3(at + f.along * i, layer);
    shade += textureGrad(sward_detail, place, f.du, f.dv);
    if (relief) slope += textureGrad(sward_detail_slope, place, f.du, f.dv).rg;
  }
  slope /= f.reads;
  return shade / f.reads;
}

SplatTap detail_tap(float layer, vec2 q, vec2 dx, vec2 dy, float variant, bool relief) {
  SplatFilter f = splat_filter(vec2(dx.x, -dx.y), vec2(dy.x, -dy.y));
  float level = variant * 7.0 + 64.0;
  float piece = floor(level);
  float way = smoothstep(0.35, 0.65, level - piece);
  vec2 uv = vec2(q.x, -q.y);
  vec4 shade = vec4(0.0);
  vec2 slope = vec2(0.0), read_slope;
  if (way < 1.0) {
    shade = (1.0 - way) * read_piece(layer, uv, f, piece, relief, read_slope);
    slope = (1.0 - way) * read_slope;
  }
  if (way > 0.0) {
    shade += way * read_piece(layer, uv, f, piece + 1.0, relief, read_slope);
    slope += way * read_slope;
  }
  SplatTap tap;
  tap.shade = shade.rgb * k_shade_unit;
  tap.height = shade.a;
  tap.slope = slope;
  return tap;
}

// Whole tiles in the period along a turned axis, so that the turned grid repeats with it too.
mat2 turned_grid(float tiles, vec2 axis) {
  vec2 a = floor(max(tiles, 1.0) * axis + 0.5);
  return mat2(a.x, -a.y, a.y, a.x) / 1024.0;
}

// A material on one plane, at the scales that the pixel's size leaves.
SplatTap plane_tap(MaterialParams m, SplatPlace place, int axis) {
  bool flat_plane = axis == 2;
  float tiles = flat_plane ? m.look.x : m.look.y;
  float layer = flat_plane ? m.layers.x : m.layers.y;
  float coarse_layer = flat_plane ? m.relief.z : m.relief.w;
  vec2 q = on_plane(place.point, axis), dx = on_plane(place.across, axis), dy = on_plane(place.down, axis);
  vec3 variants = flat_plane ? place.variants
                             : vec3(ground_noise(q, 0.125, 21u).x, ground_noise(q, 0.03125, 22u).x, 0.0);
  if (!flat_plane) variants.z = variants.y;

  // Shares of the scales: the finest until a pixel is an eighth of its tile, the broad one from there on.
  float pixel = place.footprint * tiles / 1024.0;
  float fine = 1.0 - smoothstep(0.03, 0.13, pixel);
  float middle = 1.0 - smoothstep(0.03, 0.13, pixel / k_middle_step);
  float broad = (1.0 - smoothstep(0.03, 0.13, pixel / k_broad_step)) * (1.0 - fine);

  SplatTap sum;
  sum.shade = vec3(1.0);
  sum.height = 0.5;
  sum.slope = vec2(0.0);
  if (fine > 0.0) {
    float scale = tiles / 1024.0;
    SplatTap tap = detail_tap(layer, q * scale, dx * scale, dy * scale, variants.x, true);
    sum.shade = mix(vec3(1.0), tap.shade, fine * m.look.z);
    sum.height += 0.7 * fine * (tap.height - 0.5);
    sum.slope = fine * tap.slope * (flat_plane ? m.relief.x : m.relief.y);
  }
  if (middle > 0.0) {
    // Strata stay level.
    mat2 grid = turned_grid(tiles / k_middle_step, flat_plane ? vec2(0.8, 0.6) : vec2(1.0, 0.0));
    SplatTap tap = detail_tap(coarse_layer, grid * q, grid * dx, grid * dy, variants.y, false);
    sum.shade *= mix(vec3(1.0), tap.shade, 0.6 * middle * m.look.z);
    sum.height += 0.3 * middle * (tap.height - 0.5);
  }
  if (broad > 0.0) {
    mat2 grid = turned_grid(tiles / k_broad_step, flat_plane ? vec2(0.6, -0.8) : vec2(1.0, 0.0));
    SplatTap tap = detail_tap(coarse_layer, grid * q, grid * dx, grid * dy, variants.z, false);
    sum.shade *= mix(vec3(1.0), tap.shade, 0.5 * broad * m.look.z);
  }
  return sum;
}

vec3 along_surface(vec2 slope, int axis) {
  return axis == 2 ? vec3(slope, 0.0) : (axis == 1 ? vec3(slope.x, 0.0, slope.y) : vec3(0.0, slope));
}

// Three scores of equation 17 at least, sharpened by height: what lies higher hides what lies lower.
Splat splat_materials(BestMaterials best, SplatPlace place) {
  vec3 shares = max(material_shares_of(best) - k_least_share, 0.0);
  shares /= max(shares.x + shares.y + shares.z, 1.0e-4);
  ivec3 which = ivec3(best.first, best.second, best.third);
  Splat splat;
  splat.shade = vec3(0.0);
  splat.gradient = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (shares[i] <= 0.0) continue;
    MaterialParams m = sward_materials.material[which[i]];
    for (int axis = 0; axis < 3; ++axis) {
      if (place.planes[axis] <= 0.0) continue;
      SplatTap tap = plane_tap(m, place, axis);
      float weight = shares[i] * place.planes[axis] * exp2(m.look.w * (tap.height - 0.5));
      splat.shade += weight * tap.shade;
      splat.gradient += weight * along_surface(tap.slope, axis);
      total += weight;
    }
  }
  if (total <= 0.0) {
    splat.shade = vec3(1.0);
    return splat;
  }
  splat.shade /= total;
  splat.gradient /= total;
  return splat;
}

// The materials of ground of this colour, sRGB-encoded.
BestMaterials materials_at(vec3 encoded) {
  vec3 hsv = rgb_to_hsv(encoded);
  BestMaterials best = no_materials();
  for (int i = 0; i < int(sward_materials.head.x); ++i)
    best = insert_material(best, i, material_score(sward_materials.material[i], hsv));
  return best;
}
