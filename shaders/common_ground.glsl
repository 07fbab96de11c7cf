// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The ground's colour from the base map, with the structure that lies below its texels: patches, clods, grains.
// Everything is a function of the place alone; each octave fades before it would alias, and its mean is nothing, so
// that the near ground has the colour of the far. Where the ground has materials, their detail textures take the place
// of the finer octaves.
#include "common_frame.glsl"
#include "common_noise.glsl"
#include "common_splat.glsl"
#include "common_disturbance.glsl"

struct GroundDetail {
  float shade;   // factor on brightness, around 1
  float litter;  // 1: towards bare earth and dry litter .. -1: away from it
  vec2 warp;     // of the base map lookup, texels
  vec2 slope;    // dz/dx, dz/dy of clods and grains
  vec3 point;    // relative to the eye
  vec3 normal;
  float footprint;
  vec3 variants;  // noise of 2, 8, 32 m
};

// Metres of ground that a pixel covers: between its width and its length along the view.
float ground_footprint(vec3 relative_position, vec3 normal) {
  float distance = max(length(relative_position), 1.0e-3);
  float facing = abs(dot(normal, relative_position)) / distance;
  return distance / (frame.focal.x * pow(max(facing, 0.02), 0.6));
}

// Weight of an octave: full while a cell spans four pixels, nothing below two.
float octave_weight(float cells, float footprint) { return 1.0 - smoothstep(0.25, 0.55, footprint * cells); }

// Octaves of half a metre and finer are left out where `coarse` says so.
GroundDetail octaves_of_ground(vec3 relative_position, vec3 normal, bool coarse) {
  vec2 p = frame.eye_noise.xy + relative_position.xy;
  GroundDetail detail;
  detail.point = relative_position;
  detail.normal = normal;
  detail.footprint = ground_footprint(relative_position, normal);
  float broad_weight = octave_weight(0.03125, detail.footprint);
  float patch_weight = octave_weight(0.125, detail.footprint);
  float broad = broad_weight > 0.0 ? ground_noise(p, 0.03125, 1u).x : 0.0;
  float patches = patch_weight > 0.0 ? ground_noise(p, 0.125, 2u).x : 0.0;
  detail.variants = vec3(0.0, patches, broad);
  broad *= broad_weight;
  patches *= patch_weight;
  detail.shade = 1.0 + 0.15 * broad + 0.22 * patches;
  detail.litter = 0.6 * broad + 0.9 * patches;
  detail.warp = vec2(0.0);
  detail.slope = vec2(0.0);

  // Octaves from half a metre to two centimetres: amplitudes of brightness, of height (m).
  float cells = 0.5;
  float height = 0.08;
  float grain = coarse ? 0.18 : 0.36;
  uint last = coarse ? 2u : 6u;
  for (uint i = 0u; i < last; ++i) {
    float weight = octave_weight(cells, detail.footprint);
    if (weight > 0.0) {
      vec3 noise = ground_noise(p, cells, 3u + i);
      if (i == 0u) detail.variants.x = noise.x;
      noise *= weight;
      detail.shade += grain * noise.x;
      detail.litter += (i < 3u ? 0.9 : 0.35) * noise.x;
      detail.slope += height * noise.yz;
      if (i < 2u) detail.warp += noise.yz / cells * 0.2;
    }
    cells *= 2.0;
    height *= 0.5;
    grain *= 1.06;
  }
  detail.shade = max(detail.shade, 0.35);
  detail.litter = clamp(1.3 * detail.litter, -1.0, 1.0);
  return detail;
}

GroundDetail ground_detail(vec3 relative_position, vec3 normal) {
  return octaves_of_ground(relative_position, normal, has_materials());
}

vec3 ground_encoded(vec3 linear) {
  vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(linear * 12.92, high, greaterThan(linear, vec3(0.0031308)));
}

// Factor of the materials' detail textures on ground of this colour; their relief joins detail.slope.
vec3 material_shade(vec3 base, inout GroundDetail detail) {
  SplatPlace place = splat_place(detail.point, detail.normal, detail.footprint, detail.variants);
  Splat splat = splat_materials(materials_at(ground_encoded(base)), place);
  vec3 n = detail.normal;
  vec3 rough = n - splat.gradient + n * dot(n, splat.gradient);
  rough.z = max(rough.z, 0.15 * n.z);
  detail.slope += n.xy / n.z - rough.xy / rough.z;
  return splat.shade;
}

// The base map's colour at a place, with the octaves' share. Bright, colourless ground (snow) and blue ground (water) keep the base map's colour.
vec3 octaves_albedo(vec3 base, GroundDetail detail) {
  float brightest = max(base.r, max(base.g, base.b));
  float darkest = min(base.r, min(base.g, base.b));
  float snow = smoothstep(0.30, 0.60, darkest);
  float water = smoothstep(0.0, 0.25, (base.b - max(base.r, base.g)) / max(brightest, 1.0e-3));
  float earthy = (1.0 - snow) * (1.0 - water);
  float luminance = dot(base, vec3(0.2126, 0.7152, 0.0722));
  vec3 earth = luminance * vec3(1.24, 0.95, 0.62);
  vec3 color = max(mix(base, earth, 0.45 * detail.litter * earthy), 0.25 * base);
  // What is green follows the season, the more the greener it is.
  float green = smoothstep(0.0, 0.25, (base.g - max(base.r, base.b)) / max(brightest, 1.0e-3) + 0.1) * earthy;
  color *= mix(vec3(1.0), frame.ground_tint.rgb, green);
  return color * mix(1.0, detail.shade, 0.25 + 0.75 * earthy);
}

vec3 base_color(sampler2D base_map, vec2 uv, GroundDetail detail) {
  return texture(base_map, uv + detail.warp / vec2(textureSize(base_map, 0))).rgb;
}

// Linear colour of the ground. `detail` comes from ground_detail; its slope takes on the materials' relief.
vec3 ground_albedo(sampler2D base_map, vec2 uv, inout GroundDetail detail) {
  vec3 base = base_color(base_map, uv, detail);
  vec3 color = octaves_albedo(base, detail);
  if (has_materials()) color *= material_shade(base, detail);
  return ground_is_disturbed() ? disturbed_ground(color, disturbed_here(detail.point), detail.point) : color;
}

// For plants, which take on the ground's colour but not its texture. What has touched it is the caller's to add.
vec3 ground_albedo(sampler2D base_map, vec2 uv, vec3 relative_position, vec3 normal) {
  GroundDetail detail = octaves_of_ground(relative_position, normal, false);
  return octaves_albedo(base_color(base_map, uv, detail), detail);
}
