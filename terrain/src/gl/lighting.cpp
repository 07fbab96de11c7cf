// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/frame.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::gl {

namespace {

/// Colours of a clear day at one elevation of the sun. Radiances are relative: white paper in the noon sun is about 3.
struct DayKey {
  float elevation_deg;
  glm::vec3 sun, sky, horizon, ground;
  float haze_distance_m, exposure;
};

constexpr std::array<DayKey, 7> k_day{{
    {-12.0f, {0, 0, 0}, {0.008f, 0.014f, 0.036f}, {0.030f, 0.034f, 0.055f}, {0.004f, 0.004f, 0.005f}, 12000, 2.8f},
    {-4.0f, {0.6f, 0.20f, 0.06f}, {0.055f, 0.095f, 0.220f}, {0.42f, 0.25f, 0.21f}, {0.02f, 0.02f, 0.02f}, 12000, 2.1f},
    {0.0f, {1.3f, 0.52f, 0.15f}, {0.095f, 0.170f, 0.380f}, {0.78f, 0.50f, 0.36f}, {0.05f, 0.04f, 0.03f}, 12000, 1.6f},
    {8.0f,
     {2.9f, 1.75f, 0.80f},
     {0.150f, 0.290f, 0.640f},
     {1.00f, 0.84f, 0.68f},
     {0.12f, 0.095f, 0.055f},
     14000,
     1.00f},
    {25.0f,
     {3.2f, 2.72f, 2.08f},
     {0.160f, 0.360f, 0.900f},
     {1.02f, 1.14f, 1.24f},
     {0.16f, 0.145f, 0.09f},
     18000,
     0.74f},
    {50.0f, {3.4f, 3.12f, 2.70f}, {0.155f, 0.370f, 1.000f}, {1.00f, 1.22f, 1.44f}, {0.18f, 0.17f, 0.10f}, 22000, 0.66f},
    {90.0f, {3.5f, 3.30f, 2.95f}, {0.150f, 0.365f, 1.020f}, {0.98f, 1.22f, 1.48f}, {0.19f, 0.18f, 0.11f}, 24000, 0.64f},
}};

}  // namespace

Lighting Lighting::clear_day(float sun_azimuth, float sun_elevation) {
  const float degrees =
      std::clamp(glm::degrees(sun_elevation), k_day.front().elevation_deg, k_day.back().elevation_deg);
  size_t i = 0;
  while (i + 2 < k_day.size() && k_day[i + 1].elevation_deg < degrees) ++i;
  const DayKey& a = k_day[i];
  const DayKey& b = k_day[i + 1];
  const float t = (degrees - a.elevation_deg) / (b.elevation_deg - a.elevation_deg);

  Lighting light;
  light.sun_azimuth = sun_azimuth;
  light.sun_elevation = sun_elevation;
  light.sun_radiance = glm::mix(a.sun, b.sun, t);
  light.sky_radiance = glm::mix(a.sky, b.sky, t);
  light.horizon_radiance = glm::mix(a.horizon, b.horizon, t);
  light.ground_radiance = glm::mix(a.ground, b.ground, t);
  light.haze_distance_m = glm::mix(a.haze_distance_m, b.haze_distance_m, t);
  light.exposure = glm::mix(a.exposure, b.exposure, t);
  return light;
}

}  // namespace sward::gl
