// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_wind.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::host {

namespace {

constexpr double k_step_s = 1.0 / 30.0;
/// Air rests sooner: what movers did before does not count.
constexpr double k_memory_s = 10;

double end_of(const SceneWindMover& mover) {
  return mover.path.size() > 1 ? mover.path.back()[0] : std::numeric_limits<double>::infinity();
}

/// x, y, metres above the ground.
glm::dvec3 place_at(const SceneWindMover& mover, double time_s) {
  const auto& path = mover.path;
  const auto later = std::find_if(path.begin(), path.end(), [&](const glm::dvec4& p) { return p[0] > time_s; });
  if (later == path.begin()) return {path.front()[1], path.front()[2], path.front()[3]};
  if (later == path.end()) return {path.back()[1], path.back()[2], path.back()[3]};
  const glm::dvec4 before = *(later - 1);
  const glm::dvec4 place = glm::mix(before, *later, (time_s - before[0]) / ((*later)[0] - before[0]));
  return {place[1], place[2], place[3]};
}

}  // namespace

Expected<SceneWindReplay> SceneWindReplay::create(const SceneWind& scene, glm::dvec2 min, glm::dvec2 size_m) {
  auto painted = painted_wind(scene, min, size_m);
  if (!painted) return tl::unexpected(painted.error());
  SceneWindReplay replay;
  replay.scene_ = scene;
  replay.painted_ = std::move(*painted);
  if (auto started = replay.start(); !started) {
    if (scene.where.empty()) return tl::unexpected(started.error());
    return fail(scene.where + ": " + started.error().message);
  }
  return replay;
}

Expected<void> SceneWindReplay::start() {
  wind_ = Wind();
  movers_.assign(scene_.movers.size(), std::nullopt);
  if (auto set = wind_.set_weather(scene_.weather); !set) return set;
  if (auto set = wind_.set_painted(painted_); !set) return set;
  for (const WindSource& source : scene_.sources)
    if (auto added = wind_.add_source(source); !added) return tl::unexpected(added.error());
  return {};
}

Expected<void> SceneWindReplay::move_all(double from_s, double to_s) {
  for (size_t i = 0; i < movers_.size(); ++i) {
    const SceneWindMover& each = scene_.movers[i];
    const bool there = to_s > each.path.front()[0] && from_s < end_of(each);
    if (!there && movers_[i]) {
      wind_.remove_mover(*movers_[i]);
      movers_[i].reset();
    }
    if (!there) continue;
    if (!movers_[i]) {
      const glm::dvec3 at = place_at(each, from_s);
      WindMover mover = each.mover;
      mover.position = glm::dvec2(at);
      mover.above_ground_m = float(at.z);
      auto added = wind_.add_mover(mover);
      if (!added) return tl::unexpected(added.error());
      movers_[i] = *added;
    }
    const glm::dvec3 to = place_at(each, to_s);
    if (auto moved = wind_.move(*movers_[i], glm::dvec2(to), float(to.z)); !moved) return moved;
  }
  return {};
}

Expected<void> SceneWindReplay::follow(double time_s, glm::dvec3 eye) {
  const double to = std::max(time_s, 0.0);
  if (to < wind_.time())
    if (auto started = start(); !started) return started;
  if (to - wind_.time() > k_memory_s)
    if (auto skipped = wind_.advance(to - k_memory_s - wind_.time(), eye); !skipped) return skipped;
  const auto steps = std::max(1, int(std::ceil((to - wind_.time()) / k_step_s - 1e-6)));
  const double from = wind_.time();
  for (int i = 0; i < steps; ++i) {
    const double until = i + 1 == steps ? to : from + (to - from) * (i + 1) / steps;
    if (auto moved = move_all(wind_.time(), until); !moved) return moved;
    if (auto gone = wind_.advance(until - wind_.time(), eye); !gone) return gone;
  }
  return {};
}

}  // namespace sward::host
