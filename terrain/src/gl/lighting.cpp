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
    {-12.0f, {0, 0, 0}, {0.010f, 0.016f, 0.034f}, {0.030f, 0.032f, 0.048f}, {0.004f, 0.004f, 0.005f}, 12000, 2.6f},
    {-4.0f, {0.5f, 0.18f, 0.06f}, {0.060f, 0.090f, 0.190f}, {0.34f, 0.22f, 0.20f}, {0.02f, 0.02f, 0.02f}, 12000, 1.9f},
    {0.0f, {1.0f, 0.42f, 0.14f}, {0.105f, 0.155f, 0.300f}, {0.62f, 0.42f, 0.32f}, {0.04f, 0.035f, 0.03f}, 11000, 1.35f},
    {8.0f, {2.3f, 1.50f, 0.78f}, {0.190f, 0.290f, 0.520f}, {0.80f, 0.70f, 0.58f}, {0.09f, 0.075f, 0.05f}, 11000, 0.86f},
    {25.0f,
     {3.0f, 2.62f, 2.05f},
     {0.250f, 0.400f, 0.740f},
     {0.86f, 0.92f, 0.98f},
     {0.14f, 0.13f, 0.085f},
     13000,
     0.68f},
    {50.0f, {3.3f, 3.08f, 2.70f}, {0.260f, 0.430f, 0.840f}, {0.84f, 0.96f, 1.10f}, {0.17f, 0.16f, 0.10f}, 16000, 0.62f},
    {90.0f, {3.4f, 3.25f, 2.95f}, {0.250f, 0.430f, 0.860f}, {0.82f, 0.96f, 1.13f}, {0.18f, 0.17f, 0.11f}, 18000, 0.60f},
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
