// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A clear sky: from the horizon's haze to the zenith's blue, the sun's disc, its glow, and thin high clouds. At the
// horizon it equals what apply_haze leads to, so that the farthest ground melts into it.
#include "common_light.glsl"
#include "common_noise.glsl"

layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 color;

const float k_sun_radius = 0.00465;  // radians

vec3 clear_sky(vec3 towards) {
  float height = max(towards.z, 0.0);
  float away = 1.0 - exp(-4.2 * height);
  vec3 sky = mix(horizon_light(towards), frame.sky_radiance.rgb, away);
  float cosine = max(dot(towards, frame.sun_direction.xyz), 0.0);
  float halo = 0.10 * pow(cosine, 60.0) + 0.25 * pow(cosine, 700.0);
  return sky + frame.sun_radiance.rgb * (halo * frame.sun_direction.w);
}

// Streaks of cirrus on a plane far above, fading towards the horizon.
float cirrus(vec3 towards) {
  float height = towards.z;
  if (height < 0.03) return 0.0;
  vec2 p = towards.xy / (height + 0.12) * 26.0 + vec2(310.0, 170.0);
  p += 9.0 * vec2(ground_noise(p, 0.03125, 40u).x, ground_noise(p, 0.03125, 41u).x);
  vec2 streak = vec2(dot(p, vec2(0.8, 0.6)) * 0.35, dot(p, vec2(-0.6, 0.8)));
  float density = 0.0;
  float amplitude = 0.55;
  float cells = 0.0625;
  for (uint i = 0u; i < 5u; ++i) {
    density += amplitude * ground_noise(streak, cells, 50u + i).x;
    cells *= 2.0;
    amplitude *= 0.55;
  }
  float cover = ground_noise(p, 0.015625, 60u).x;
  return smoothstep(0.02, 0.55, density + 0.45 * cover) * smoothstep(0.03, 0.25, height);
}

void main() {
  vec3 towards = normalize(direction);
  vec3 sky = clear_sky(towards);
  float cosine = dot(towards, frame.sun_direction.xyz);
  vec3 lit = mix(frame.horizon_radiance.rgb, frame.sun_radiance.rgb * 0.45, 0.5 * frame.sun_direction.w);
  sky = mix(sky, lit * (1.0 + 0.5 * pow(max(cosine, 0.0), 8.0)), 0.38 * cirrus(towards));
  float angle = acos(clamp(cosine, -1.0, 1.0));
  float disc = 1.0 - smoothstep(k_sun_radius * 0.92, k_sun_radius * 1.08, angle);
  sky += frame.sun_radiance.rgb * (disc * 30.0 * frame.sun_direction.w);
  // Half a step of an 8-bit target, at random, against bands.
  float dither = float(noise_hash(uvec2(gl_FragCoord.xy), 77u) & 0xFFFFu) * (1.0 / 65535.0) - 0.5;
  vec3 encoded = encode_output(sky);
  if (frame.sky_radiance.w == 1.0) encoded += dither / 255.0;
  color = vec4(encoded, 1.0);
}
