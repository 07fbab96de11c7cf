// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/wind_params.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vegetation/wind_state.h"

namespace sward {

namespace {

using wind_shared::vec2;
using wind_shared::vec4;

vec4 layer_place(const WindMapLayer& layer, glm::dvec2 eye) {
  const glm::dvec2 place = layer.place(eye);
  return {vec2(place - glm::floor(place)), std::cos(layer.turn) / layer.tile_m, std::sin(layer.turn) / layer.tile_m};
}

vec4 grid_place(const WindGrid& grid, glm::dvec2 eye) {
  const double size = grid.side() * grid.cell_m();
  const glm::dvec2 place = eye / size;
  return {vec2(place - glm::floor(place)), 1.0 / size, grid.at_rest() ? 0 : 1};
}

/// Of a source that repeats, the same moment of an early turn: floats are precise there.
double early_age(const WindSource& source, double age) {
  if (source.repeat_s <= 0) return age;
  const double farthest = double(source.reach_m / source.travel_m_s);
  const double turns = std::floor((age - farthest) / source.repeat_s) - 1;
  return turns > 0 ? age - turns * source.repeat_s : age;
}

wind_shared::WindSourceParams source_params(const WindSource& source, double time, glm::dvec2 eye) {
  const double age = time - source.start_s;
  const glm::dvec2 place = source.position + source.velocity_m_s * age - eye;
  wind_shared::WindSourceParams params;
  params.place = {vec2(place), source.outward_m_s, source.around_m_s};
  params.course = {early_age(source, age), 1.0f / source.travel_m_s, source.duration_s, source.rise_s};
  params.shape = {1.0f / source.radius_m, 1.0f / source.reach_m, source.falloff, source.repeat_s};
  params.wave = {2.0f * std::numbers::pi_v<float> / source.wave_period_s, source.wave_share, 0, 0};
  return params;
}

}  // namespace

wind_shared::WindParams make_wind_params(const WindState& state, glm::dvec3 eye) {
  const glm::dvec2 at(eye);
  const Weather& weather = state.weather;
  wind_shared::WindParams params{};
  params.mean = {vec2(state.mean), weather.gustiness, weather.speed_m_s > 0 ? 1 : 0};
  params.ambient = {weather.ambient_m_s, weather.turbulence, state.blowing.size(), state.painted ? 1 : 0};
  for (size_t i = 0; i < 2; ++i) {
    params.gust_place[i] = layer_place(state.gusts[i], at);
    params.ambient_place[i] = layer_place(state.noise[i], at);
  }
  params.ambient_turn = {std::cos(state.noise_turn[0]), std::sin(state.noise_turn[0]), std::cos(state.noise_turn[1]),
                         std::sin(state.noise_turn[1])};
  params.grid_place[0] = grid_place(state.fine, at);
  params.grid_place[1] = grid_place(state.coarse, at);
  params.grid_reach = {vec2(glm::dvec2(state.eye) - at), state.fine.reach_m(), state.coarse.reach_m()};
  if (state.painted) {
    const glm::dvec2 size = state.painted->size_m;
    params.painted = {vec2((at - state.painted->min) / size), vec2(1.0 / size)};
  }
  for (size_t i = 0; i < state.blowing.size(); ++i) params.sources[i] = source_params(state.blowing[i], state.time, at);
  return params;
}

}  // namespace sward
