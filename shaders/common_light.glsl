// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Light, haze and the final colour, the same for terrain, plants, their shadows and the sky. All colours are linear,
// Rec. 709, until encode_output. Needs common_frame.glsl.
#include "common_frame.glsl"
#include "common_host.glsl"

// Haze, and the sky at the horizon, in a direction (unit): brighter and tinted by the sun on its side.
vec3 horizon_light(vec3 direction) {
  float towards = clamp(dot(direction, frame.sun_direction.xyz) * 0.5 + 0.5, 0.0, 1.0);
  float low = 1.0 - clamp(frame.sun_direction.z, 0.0, 1.0);
  float glow = frame.sun_direction.w * low * (0.10 * towards * towards + 0.16 * pow(towards, 24.0));
  return frame.horizon_radiance.rgb * (0.94 + 0.06 * towards) + frame.sun_radiance.rgb * glow;
}

// What a surface of this normal gets from the whole sky and the ground around it, over pi.
vec3 ambient(vec3 normal) {
  float up = dot(normal, frame.up.xyz);
  vec3 above = mix(frame.horizon_radiance.rgb, frame.sky_radiance.rgb, 0.55 + 0.25 * up);
  return mix(frame.ground_radiance.rgb, above, smoothstep(-1.0, 1.0, up));
}

// What is left of the light on its way from `relative_position` to the eye: haze that thins exponentially with height.
// Blue is scattered first.
vec3 haze_transmittance(vec3 relative_position) {
  float distance = length(relative_position);
  float inverse_height = frame.ground_radiance.w;
  float climb = clamp(dot(relative_position, frame.up.xyz) * inverse_height, -4.0, 60.0);
  float density = exp(-clamp(frame.eye_noise.z * inverse_height, 0.0, 4.0));
  float mean = abs(climb) < 1.0e-3 ? 1.0 - 0.5 * climb : (1.0 - exp(-climb)) / climb;
  float depth = distance * frame.horizon_radiance.w * density * mean;
  return exp(-depth * vec3(0.86, 1.0, 1.22));
}

vec3 apply_haze(vec3 color, vec3 relative_position) {
  vec3 left = haze_transmittance(relative_position);
  vec3 direction = relative_position / max(length(relative_position), 1.0e-4);
  return host_fog(color * left + horizon_light(direction) * (1.0 - left), relative_position);
}

// Direct sun on a surface facing it, where nothing of the host's stands between.
vec3 sun_light() { return frame.sun_radiance.rgb * frame.sun_direction.w; }
vec3 sun_light(vec3 relative_position) { return sun_light() * host_shadow(relative_position); }

// The ground, lit. sun_visibility 0: in full shadow, which is how planar shadows are drawn.
vec3 shade_ground(vec3 albedo, vec3 normal, vec3 relative_position, float sun_visibility) {
  float facing = max(dot(normal, frame.sun_direction.xyz), 0.0);
  vec3 sun = sun_light(relative_position) * (facing * sun_visibility);
  return apply_haze(albedo * (ambient(normal) + sun), relative_position);
}

vec3 srgb_encode(vec3 linear) {
  vec3 low = linear * 12.92;
  vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(low, high, greaterThan(linear, vec3(0.0031308)));
}

// Contrast in the shadows, then a shoulder that never clips.
vec3 tone_curve(vec3 x) { return 1.0 - exp(-1.15 * x * x / (x + 0.03)); }

// Exposure, tone curve and sRGB encoding where the frame asks for encoded colours; else the radiance as it is. Half of
// the curve acts on luminance, so that bright greens keep their hue, half on each channel, so that the very bright turns
// white.
vec3 encode_output(vec3 linear) {
  if (frame.sky_radiance.w != 1.0) return linear;
  vec3 exposed = max(linear, vec3(0.0)) * frame.sun_radiance.w;
  float luminance = max(dot(exposed, vec3(0.2126, 0.7152, 0.0722)), 1.0e-6);
  vec3 by_luminance = exposed * (tone_curve(vec3(luminance)).x / luminance);
  return srgb_encode(clamp(mix(tone_curve(exposed), by_luminance, 0.5), 0.0, 1.0));
}
