// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The wind at a place. Read by GLSL (common_wind.glsl) and by C++ (vegetation/src/vegetation/wind_twin.cpp), each of
// which defines `sward_wind`, a WindParams, and four lookups, all bilinear:
//   vec2 wind_gust_map(vec2 uv)              two grey maps of gusts, repeating
//   vec2 wind_noise_map(vec2 uv)             a normal map's x and y, -1..1, repeating
//   vec2 wind_grid_map(vec2 uv, int level)   what movers do, m/s, repeating: 0 the fine grid, 1 the coarse
//   vec2 wind_painted_map(vec2 uv)           factor along the wind and to its left, ending at the edge
//
// Knowles and Fryazinov, "Increasing realism of animated grass in real-time game environments" (2015), section 2: wind
// is a vector times a scrolling grey map, plus noise from scrolling, rotating normal maps whose strength follows. Here
// the noise's vectors rotate, not its map: over an unlimited world a rotating map would race at a distance.
// Bakay, Lalonde and Heidrich, "Real-Time Animated Grass" (2002), section 4: sources, whose wind comes the later the
// farther the place, with waves and attenuation; and an artist's map. Their vector points at the source, ours away.
// Lee, "Realistic Real-Time Grass Rendering" (2010), "Wind Simulation" and "Wind Force": the movers' grid, interpolated
// between cells.

SWARD_FN vec2 wind_map_place(vec4 place, vec2 p) {
  return vec2(place.x + place.z * p.x + place.w * p.y, place.y - place.w * p.x + place.z * p.y);
}

SWARD_FN vec2 wind_turned(vec2 v, float cosine, float sine) {
  return vec2(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y);
}

// The gust map: a large and a small pattern that the wind carries along, 0..1, mean one half.
SWARD_FN float wind_gust(vec2 p) {
  float large = wind_gust_map(wind_map_place(sward_wind.gust_place[0], p)).x;
  float small_one = wind_gust_map(wind_map_place(sward_wind.gust_place[1], p)).y;
  float both = clamp((0.62f * large + 0.38f * small_one - 0.5f) * 1.5f + 0.5f, 0.0f, 1.0f);
  return both * both * (3.0f - 2.0f * both);
}

// Noise of about unit strength.
SWARD_FN vec2 wind_noise(vec2 p) {
  vec4 turn = sward_wind.ambient_turn;
  vec2 first = wind_noise_map(wind_map_place(sward_wind.ambient_place[0], p));
  vec2 second = wind_noise_map(wind_map_place(sward_wind.ambient_place[1], p));
  return wind_turned(first, turn.x, turn.y) + wind_turned(second, turn.z, turn.w);
}

// Eases from 0 at 0 to 1 at 1.
SWARD_FN float wind_ease(float x) {
  float t = clamp(x, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// How strong a source is that started `since` seconds ago, 0..1.
SWARD_FN float wind_source_strength(WindSourceParams source, float since) {
  float again = source.shape.w;
  float t = again > 0.0f && since > 0.0f ? since - again * floor(since / again) : since;
  float rise = source.course.w;
  float envelope = wind_ease(t / rise) * wind_ease((source.course.z - t) / rise);
  return envelope * (1.0f - source.wave.y * (0.5f + 0.5f * cos(source.wave.x * t)));
}

SWARD_FN vec2 wind_of_source(WindSourceParams source, vec2 p) {
  vec2 from = p - vec2(source.place.x, source.place.y);
  float d = sqrt(from.x * from.x + from.y * from.y);
  float left = 1.0f - d * source.shape.y * d * source.shape.y;
  if (left <= 0.0f) return vec2(0.0f);
  float ratio = d * source.shape.x;
  float speed = min(ratio, 1.0f) * pow(max(ratio, 1.0f), -source.shape.z) * left * left;
  speed *= wind_source_strength(source, source.course.x - d * source.course.y);
  vec2 away = from / max(d, 1e-6f);
  return speed * (source.place.z * away + source.place.w * vec2(-away.y, away.x));
}

SWARD_FN vec2 wind_of_sources(vec2 p) {
  vec2 sum = vec2(0.0f);
  int count = int(sward_wind.ambient.z);
  for (int i = 0; i < count; ++i) sum += wind_of_source(sward_wind.sources[i], p);
  return sum;
}

// 1 around the eye, easing to 0 over the last fifth of the reach.
SWARD_FN float wind_grid_share(vec2 p, float reach) {
  vec2 from = p - vec2(sward_wind.grid_reach.x, sward_wind.grid_reach.y);
  float d = max(abs(from.x), abs(from.y));
  return wind_ease((reach - d) / (0.2f * reach));
}

SWARD_FN vec2 wind_in_grid(vec4 place, int level, vec2 p) {
  return wind_grid_map(vec2(place.x + place.z * p.x, place.y + place.z * p.y), level);
}

// The fine grid around the eye, the coarse one beyond.
SWARD_FN vec2 wind_of_movers(vec2 p) {
  vec4 fine = sward_wind.grid_place[0];
  vec4 coarse = sward_wind.grid_place[1];
  float share = wind_grid_share(p, sward_wind.grid_reach.z);
  vec2 sum = vec2(0.0f);
  if (fine.w > 0.0f && share > 0.0f) sum += share * wind_in_grid(fine, 0, p);
  if (coarse.w > 0.0f && share < 1.0f)
    sum += (1.0f - share) * wind_grid_share(p, sward_wind.grid_reach.w) * wind_in_grid(coarse, 1, p);
  return sum;
}

SWARD_FN WindHere wind_at_place(vec2 p) {
  vec4 mean = sward_wind.mean;
  vec2 painted = vec2(1.0f, 0.0f);
  float factor = 1.0f;
  if (sward_wind.ambient.w > 0.0f) {
    vec4 map = sward_wind.painted;
    painted = wind_painted_map(vec2(map.x + map.z * p.x, map.y + map.w * p.y));
    factor = sqrt(painted.x * painted.x + painted.y * painted.y);
  }
  WindHere here;
  vec2 directional = vec2(0.0f);
  here.gust = 0.0f;
  if (mean.w > 0.0f) {
    here.gust = wind_gust(p);
    float strength = 1.0f + mean.z * (2.0f * here.gust - 1.0f);
    directional = strength * wind_turned(vec2(mean.x, mean.y), painted.x, painted.y);
  }
  here.velocity = directional + factor * (wind_of_sources(p) + wind_of_movers(p));
  float blowing = sqrt(here.velocity.x * here.velocity.x + here.velocity.y * here.velocity.y);
  float rough = factor * sward_wind.ambient.x + sward_wind.ambient.y * blowing;
  here.ambient = vec2(0.0f);
  if (rough > 0.0f) here.ambient = rough * wind_noise(p);
  return here;
}
