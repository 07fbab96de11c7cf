// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of gravel: a facet, coloured by the ground that the stone came from, with its own shade and grain.
#include "common_object_shade.glsl"

// 0: contact is full at the stone and gone at its rim.
float object_cover(bool shadow) {
  if (part_self.w < 1.5) return 1.0;
  float out_of_it = 1.0 - clamp(part_mask.x, 0.0, 1.0);
  return out_of_it * out_of_it;
}

float grain(vec3 point) {
  vec2 p = frame.eye_noise.xy + point.xy + vec2(frame.eye_noise.z + point.z);
  float footprint = length(point) / frame.focal.y;
  float shade = 0.0;
  float cells = 16.0;
  for (uint i = 0u; i < 3u; ++i) {
    float weight = octave_weight(cells, footprint);
    if (weight > 0.0) shade += 0.22 * weight * ground_noise(p, cells, 21u + i).x;
    cells *= 2.0;
  }
  return 1.0 + shade;
}

vec3 object_radiance(SpeciesParams species, vec3 to_eye) {
  vec3 ground = part_color.rgb;
  float phase = part_self.z;
  float own = fract(phase * 37.13), warmth = fract(phase * 91.7);
  // Stones are greyer than the soil around them, each in its own way.
  vec3 stone = mix(ground, vec3(dot(ground, vec3(0.2126, 0.7152, 0.0722))), mix(0.05, 0.55, warmth));
  stone *= mix(species.tint.rgb, species.age_tint.rgb, part_color.w) * mix(0.85, 1.75, own * own);
  stone *= grain(part_point.xyz);
  // Light from the ground next to it warms the sides.
  vec3 bounce = 0.35 * ground * sun_light(part_point.xyz) * max(frame.sun_direction.z, 0.0);
  vec3 normal = normalize(part_normal.xyz);
  vec3 sun = frame.sun_direction.xyz;
  float open = mix(species.age_tint.w, 1.0, smoothstep(-0.1, 0.35, part_point.w / max(part_normal.w, 1.0e-3)));
  float facing = max(dot(normal, sun), 0.0);
  float gloss = pow(max(dot(to_eye, reflect(-sun, normal)), 0.0), species.optics.w);
  float shine = facing > 0.0 ? 0.25 * species.optics.z * gloss : 0.0;
  float low = 0.5 - 0.5 * dot(normal, part_ground.xyz);
  vec3 around = ambient(normal) * open + bounce * low;
  return around * stone + sun_light(part_point.xyz) * mix(open, 1.0, 0.5) * (stone * facing + vec3(shine));
}
