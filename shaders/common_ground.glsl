// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The ground's colour from the base map, with the structure that lies below its texels: patches, clods, grains.
// Everything is a function of the place alone; each octave fades before it would alias, and its mean is nothing, so
// that the near ground has the colour of the far.
#include "common_frame.glsl"
#include "common_noise.glsl"

struct GroundDetail {
  float shade;   // factor on brightness, around 1
  float litter;  // 1: towards bare earth and dry litter .. -1: away from it
  vec2 warp;     // of the base map lookup, texels
  vec2 slope;    // dz/dx, dz/dy of clods and grains
};

// Metres of ground that a pixel covers: between its width and its length along the view.
float ground_footprint(vec3 relative_position, vec3 normal) {
  float distance = max(length(relative_position), 1.0e-3);
  float facing = abs(dot(normal, relative_position)) / distance;
  return distance / (frame.focal.x * pow(max(facing, 0.02), 0.6));
}

// Weight of an octave: full while a cell spans four pixels, nothing below two.
float octave_weight(float cells, float footprint) { return 1.0 - smoothstep(0.25, 0.55, footprint * cells); }

GroundDetail ground_detail(vec3 relative_position, vec3 normal) {
  vec2 p = frame.eye_noise.xy + relative_position.xy;
  float footprint = ground_footprint(relative_position, normal);
  GroundDetail detail;
  float broad_weight = octave_weight(0.03125, footprint);
  float patch_weight = octave_weight(0.125, footprint);
  float broad = broad_weight > 0.0 ? broad_weight * ground_noise(p, 0.03125, 1u).x : 0.0;
  float patches = patch_weight > 0.0 ? patch_weight * ground_noise(p, 0.125, 2u).x : 0.0;
  detail.shade = 1.0 + 0.15 * broad + 0.22 * patches;
  detail.litter = 0.6 * broad + 0.9 * patches;
  detail.warp = vec2(0.0);
  detail.slope = vec2(0.0);

  // Octaves from half a metre to two centimetres: amplitudes of brightness, of height (m).
  float cells = 0.5;
  float height = 0.08;
  float grain = 0.36;
  for (uint i = 0u; i < 6u; ++i) {
    float weight = octave_weight(cells, footprint);
    if (weight > 0.0) {
      vec3 noise = ground_noise(p, cells, 3u + i) * weight;
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

// Linear colour of the ground. Bright, colourless ground (snow) and blue ground (water) keep the base map's colour.
vec3 ground_albedo(sampler2D base_map, vec2 uv, GroundDetail detail) {
  vec3 base = texture(base_map, uv + detail.warp / vec2(textureSize(base_map, 0))).rgb;
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

// The same for programs that need no more than the colour.
vec3 ground_albedo(sampler2D base_map, vec2 uv, vec3 relative_position, vec3 normal) {
  return ground_albedo(base_map, uv, ground_detail(relative_position, normal));
}
