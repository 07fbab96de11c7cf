// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/wind.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "vegetation/wind_maps.h"
#include "vegetation/wind_state.h"

namespace sward {

static_assert(k_wind_sources_at_once == wind_shared::k_wind_sources);

namespace {

// Turned against each other, and of sides of no common measure, so that no two places are alike.
constexpr double k_gust_turns[2] = {0.0, 0.93}, k_noise_turns[2] = {0.4, 1.3};
constexpr double k_noise_tiles_m[2] = {59.0, 36.7};
constexpr double k_small_gusts = 0.31;  // length of the second map's against the first's

constexpr double k_farthest_m = 4e9;  // from the eye: floats do not hold everything

double gust_tile(const Weather& weather, size_t map) {
  const double length = double(weather.gust_length_m) * (map == 0 ? 1.0 : k_small_gusts);
  return length * WindMaps::k_gusts[map];
}

void refresh(WindState& state) {
  choose_wind_sources(state);
  state.params = make_wind_params(state, state.eye);
}

}  // namespace

float beaufort_speed(float force) {
  if (!(force > 0)) return 0;
  const float clamped = std::min(force, 12.0f);
  return 0.836f * clamped * std::sqrt(clamped);
}

WindSource whirlwind(glm::dvec2 position, float radius_m, float speed_m_s, double start_s) {
  WindSource source;
  source.position = position;
  source.start_s = start_s;
  source.duration_s = 30;
  source.rise_s = 3;
  source.outward_m_s = -0.3f * speed_m_s;
  source.around_m_s = speed_m_s;
  source.radius_m = radius_m;
  source.falloff = 1;
  source.reach_m = 12 * radius_m;
  source.travel_m_s = 300;
  source.wave_share = 0.2f;
  return source;
}

Wind::Wind() : state_(std::make_unique<WindState>()) {
  static std::atomic<uint64_t> next = 1;
  state_->identity = next++;
  for (size_t i = 0; i < 2; ++i) {
    state_->gusts[i] = {k_gust_turns[i], gust_tile(state_->weather, i)};
    state_->noise[i] = {k_noise_turns[i], k_noise_tiles_m[i]};
  }
  refresh(*state_);
}
Wind::Wind(Wind&&) noexcept = default;
Wind& Wind::operator=(Wind&&) noexcept = default;
Wind::~Wind() = default;

Expected<void> Wind::set_weather(const Weather& weather) {
  if (auto valid = validate(weather); !valid) return tl::unexpected(valid.error());
  WindState& state = *state_;
  state.weather = weather;
  // It comes from there, so it blows the other way.
  const auto azimuth = double(weather.from_azimuth);
  state.mean = -double(weather.speed_m_s) * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
  for (size_t i = 0; i < 2; ++i) {
    const double tile = gust_tile(weather, i);
    if (tile != state.gusts[i].tile_m) state.gusts[i].scale(tile, glm::dvec2(state.eye));
  }
  refresh(state);
  return {};
}

const Weather& Wind::weather() const {
  return state_->weather;
}

Expected<WindSourceId> Wind::add_source(const WindSource& source) {
  if (auto valid = validate(source); !valid) return tl::unexpected(valid.error());
  if (state_->sources.size() >= k_most_wind_sources)
    return fail("there are " + std::to_string(k_most_wind_sources) + " wind sources already; remove one first");
  const WindSourceId id = state_->sources.add(source);
  refresh(*state_);
  return id;
}

bool Wind::remove_source(WindSourceId id) {
  const bool removed = state_->sources.remove(id);
  if (removed) refresh(*state_);
  return removed;
}

uint32_t Wind::sources() const {
  return state_->sources.size();
}

Expected<WindMoverId> Wind::add_mover(const WindMover& mover) {
  if (auto valid = validate(mover); !valid) return tl::unexpected(valid.error());
  if (state_->movers.size() >= k_most_wind_movers)
    return fail("there are " + std::to_string(k_most_wind_movers) + " wind movers already; remove one first");
  return state_->movers.add({mover, mover.position});
}

Expected<void> Wind::move(WindMoverId id, glm::dvec2 position, float above_ground_m) {
  MovingMover* found = state_->movers.find(id);
  if (found == nullptr) return fail("there is no such wind mover (any more); add one with add_mover()");
  WindMover moved = found->mover;
  moved.position = position;
  moved.above_ground_m = above_ground_m;
  if (auto valid = validate(moved); !valid) return tl::unexpected(valid.error());
  found->mover = moved;
  return {};
}

bool Wind::remove_mover(WindMoverId id) {
  return state_->movers.remove(id);
}

uint32_t Wind::movers() const {
  return state_->movers.size();
}

Expected<void> Wind::set_painted(std::shared_ptr<const PaintedWind> painted) {
  if (painted)
    if (auto valid = validate(*painted); !valid) return tl::unexpected(valid.error());
  state_->painted = std::move(painted);
  ++state_->painting;
  refresh(*state_);
  return {};
}

Expected<void> Wind::advance(double seconds, glm::dvec3 eye) {
  if (!(seconds >= 0 && seconds <= 1e9))
    return fail("the wind cannot advance by " + std::to_string(seconds) + " s; give 0 to 1e9");
  const glm::dvec3 size = glm::abs(eye);
  if (!(size.x <= 1e9 && size.y <= 1e9 && size.z <= 1e9))
    return fail("the wind cannot follow an eye that is not within 1e9 m of the origin; give a finite place");
  WindState& state = *state_;
  state.eye = eye;
  carry_wind_maps(state, seconds);
  step_wind_grids(state, seconds);
  state.time += seconds;
  refresh(state);
  return {};
}

double Wind::time() const {
  return state_->time;
}

WindHere Wind::at(glm::dvec3 world) const {
  const glm::dvec2 from = glm::dvec2(world) - glm::dvec2(state_->eye);
  if (!(std::abs(from.x) <= k_farthest_m && std::abs(from.y) <= k_farthest_m)) return {};
  return wind_here(*state_, state_->params, glm::vec2(from));
}

}  // namespace sward
