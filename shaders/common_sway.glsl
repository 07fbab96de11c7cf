// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How plants answer the wind, without a state. Read by GLSL and C++. Winds are m/s east and north (on meshes: in the
// surface's frame), times seconds.
//
// Lee, "Realistic Real-Time Grass Rendering" (2010), "Wind Force": upright blades sway more, in a zone of their own, each out of phase.
// Departures: the zone is a share of the wind, not of the angle, and ends where the static curve is that of
// k_gust_factor times the wind, so that no gust bends a plant farther than wind could; cycles have no common rate.

// Swaying takes a plant no farther than this factor on the wind would.
const float k_gust_factor = 1.3f;

// Share of the wind at 10 m that reaches a plant of this height: the logarithmic profile over a roughness of 3 cm.
SWARD_FN float wind_exposure(float height) { return min(0.17204f * log(1.0f + max(height, 0.0f) * 33.33333f), 1.0f); }

// A plant's own numbers for swaying. They never change, whatever season, cutting or treading make of it: a cycle's rate
// times the time must not jump.
struct SwayTraits {
  float hertz;  // of its natural frequency: a whole multiple of 1/512, so that time may wrap at 4096 s
  float mass;   // against its species' mean
  float phase;  // 0..1
};

// `heights`: the species' range all year, metres. Drawn as make_traits draws.
SWARD_FN SwayTraits sway_traits(SpeciesParams species, vec2 heights, uvec2 id, uint rank, float phase) {
  uint state = random_pair(rank | k_sequence_space, id).x;
  float height = heights.x + (heights.y - heights.x) * uniform_float(state);
  state = lcg_next(state);
  float width = species.size.z + (species.size.w - species.size.z) * uniform_float(state);
  state = lcg_next(state);
  float stiffness = species.posture.x + (species.posture.y - species.posture.x) * uniform_float(state);
  // A chain that nearly buckles under its weight has the rate of a pendulum of its length, stiffer ones more.
  float hertz = 0.15915f * sqrt(9.81f / max(height, 0.02f)) * (0.8f + 1.6f * stiffness);
  SwayTraits t;
  t.hertz = floor(min(hertz, 6.0f) * 512.0f + 0.5f) / 512.0f;
  t.mass = 2.0f * width / max(species.size.z + species.size.w, 1.0e-6f);
  t.phase = phase;
  return t;
}

// The air around a plant.
struct PlantAir {
  vec2 wind;    // that it stands in, on the mean of its swaying
  float sway;   // share of that by which it sways
  float cycle;  // place in its cycle, 0..1
  float slow;   // place in one of five eighths of its rate
};

SWARD_FN PlantAir still_air() {
  PlantAir air;
  air.wind = vec2(0.0f);
  air.sway = 0.0f;
  air.cycle = 0.0f;
  air.slow = 0.0f;
  return air;
}

SWARD_FN float sway_cycle(float hertz, float time, float start) {
  float turns = hertz * time + start;
  return turns - floor(turns);
}

// Noise turned by a plant's own number: neighbours feel the same noise each in a direction of its own. Plants are too slow
// for all of the quick noise that strong wind carries past them.
SWARD_FN vec2 own_noise(vec2 ambient, float phase) {
  ambient = ambient / (1.0f + 0.6f * sqrt(ambient.x * ambient.x + ambient.y * ambient.y));
  float angle = 6.2831853f * 7.0f * phase;
  float c = cos(angle);
  float s = sin(angle);
  return vec2(c * ambient.x - s * ambient.y, s * ambient.x + c * ambient.y);
}

// `velocity`, `ambient`, `gust` as wind_here() has them (common_wind.glsl); `lean` of the root; `share` 0..1: how much of
// its motion is seen at its distance.
SWARD_FN PlantAir plant_air(SwayTraits t, float height, float lean, vec2 velocity, vec2 ambient, float gust, float time,
                            float share) {
  // What lies offers the wind little.
  float upright = max(cos(lean), 0.0f);
  // Drag against weight: heavier plants feel less wind.
  float felt = share * upright * wind_exposure(height) / sqrt(clamp(t.mass, 0.5f, 2.0f));
  PlantAir air;
  air.wind = felt * (velocity + own_noise(ambient, t.phase));
  air.sway = (0.16f + 0.12f * gust) * upright;
  air.cycle = sway_cycle(t.hertz, time, t.phase);
  air.slow = sway_cycle(0.625f * t.hertz, time, 3.0f * t.phase);
  return air;
}

// The wind that bends a part of a plant (its shoots sway out of step): at most k_gust_factor times that it stands in.
SWARD_FN vec2 swaying_wind(PlantAir air, int part) {
  float turn = 6.2831853f * (air.cycle + 0.381966f * float(part));
  float slow = 6.2831853f * air.slow;
  float along = 1.0f + air.sway * (0.62f * sin(turn) + 0.38f * sin(slow));
  float aside = 0.5f * air.sway * sin(turn + slow + 1.7f);
  return vec2(air.wind.x * along - air.wind.y * aside, air.wind.y * along + air.wind.x * aside);
}

// How far a leaf is turned now, radians: most where the wind is strong, at rates above the plant's own. `own`: the leaf's
// number, 0..1.
SWARD_FN float fluttering(PlantAir air, float wind, float own) {
  float quick = 6.2831853f * (3.0f * air.cycle + own);
  float quicker = 6.2831853f * (5.0f * air.cycle + air.slow + 3.0f * own);
  return 0.45f * wind / (wind + 5.0f) * (0.6f * sin(quick) + 0.4f * sin(quicker));
}
