// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/disturbance_replay.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::host {

namespace {

constexpr double k_steps_a_second = 25;
/// Later is this, seconds.
constexpr double k_last_time = 1e9;
/// Share of a step in which a foot comes down: plants are laid down, not switched.
constexpr double k_footfall = 0.3;

/// A place of a path: where, which way, how far along.
struct Stand {
  glm::dvec2 place{0}, way{1, 0};
  double along = 0;
};

/// Where a walker is; none before its first and after its last time.
std::optional<Stand> stand_at(const SceneWalker& walker, double time) {
  double along = 0;
  if (time < walker.path.front().x) return std::nullopt;
  for (size_t i = 1; i < walker.path.size(); ++i) {
    const glm::dvec3 &a = walker.path[i - 1], &b = walker.path[i];
    const glm::dvec2 from(a.y, a.z), leg(b.y - a.y, b.z - a.z);
    const double length = glm::length(leg);
    if (time <= b.x) {
      const double t = (time - a.x) / (b.x - a.x);
      return Stand{from + leg * t, length > 0 ? leg / length : glm::dvec2(1, 0), along + length * t};
    }
    along += length;
  }
  return std::nullopt;
}

/// The place at a length along the path.
Stand stand_along(const SceneWalker& walker, double along) {
  Stand stand;
  double begin = 0;
  for (size_t i = 1; i < walker.path.size(); ++i) {
    const glm::dvec2 from(walker.path[i - 1].y, walker.path[i - 1].z), to(walker.path[i].y, walker.path[i].z);
    const double length = glm::length(to - from);
    if (length <= 0) continue;
    stand = {from + (to - from) * std::clamp((along - begin) / length, 0.0, 1.0), (to - from) / length, along};
    begin += length;
    if (along <= begin) break;
  }
  return stand;
}

glm::dvec2 aside(const Stand& stand, double metres) {
  return stand.place + glm::dvec2(-stand.way.y, stand.way.x) * metres;
}

Expected<void> press_foot(const SceneWalker& walker, double foot, double down, Disturbance& to) {
  if (down <= 0) return {};
  const Stand stand = stand_along(walker, foot * double(walker.step_m));
  const double side = (std::fmod(foot, 2) < 0.5 ? 0.5 : -0.5) * double(walker.track_m);
  const glm::dvec2 heel = aside(stand, side);
  const double length = 1.2 * double(walker.radius_m);
  return to.press_capsule(heel - stand.way * (0.5 * length), heel + stand.way * (0.5 * length), double(walker.radius_m),
                          walker.weight * float(std::min(down, 1.0)));
}

Expected<void> walk(const SceneWalker& walker, double before, double now, Disturbance& to) {
  const double step = double(walker.step_m);
  const double last = std::floor(now / step);
  // Feet that came down between two looks stand.
  for (double foot = std::max(std::floor(before / step), 0.0); foot < last; ++foot)
    if (auto pressed = press_foot(walker, foot, 1, to); !pressed) return pressed;
  return press_foot(walker, last, (now - last * step) / (k_footfall * step), to);
}

Expected<void> roll(const SceneWalker& walker, const Stand& before, const Stand& now, Disturbance& to) {
  for (const double side : {-0.5, 0.5}) {
    const double out = side * double(walker.track_m);
    auto pressed = to.press_capsule(aside(before, out), aside(now, out), double(walker.radius_m), walker.weight);
    if (!pressed || walker.track_m <= 0) return pressed;
  }
  return {};
}

Expected<void> move(const SceneWalker& walker, double before, double now, Disturbance& to) {
  const double first = walker.path.front().x, last = walker.path.back().x;
  if (now < first || before > last) return {};
  const auto a = stand_at(walker, std::clamp(before, first, last)), b = stand_at(walker, std::clamp(now, first, last));
  if (!a || !b) return {};
  return walker.wheels ? roll(walker, *a, *b, to) : walk(walker, a->along, b->along, to);
}

Expected<void> happen(const SceneEvent& event, Disturbance& to) {
  using Kind = SceneEvent::Kind;
  if (event.kind == Kind::explosion) return to.explode(event.position, event.radius_m);
  if (event.kind == Kind::rotor) return to.rotor_wash(event.position, event.radius_m, event.amount);
  DisturbanceTouch touch;
  DisturbanceBrush brush{event.position, event.to.value_or(event.position), event.radius_m, 0.4f};
  if (event.kind == Kind::cut) {
    touch.cut_m = event.height_m;
    brush.soft = 0;
  }
  if (event.kind == Kind::burn) touch.burn = event.amount;
  if (event.kind == Kind::wet) touch.wet = event.amount;
  if (event.kind == Kind::paint) touch.paint = glm::vec4(event.color, event.amount);
  return to.touch(brush, touch);
}

}  // namespace

Expected<DisturbanceReplay> DisturbanceReplay::create(const Scene& scene) {
  DisturbanceReplay replay;
  replay.scene_ = scene.disturbance;
  replay.path_ = scene.resolve(scene.disturbance.file);
  for (const SceneEvent& event : scene.disturbance.events) replay.end_ = std::max(replay.end_, event.time_s + 1);
  for (const SceneWalker& walker : scene.disturbance.walkers)
    replay.end_ = std::max(replay.end_, walker.path.back().x + 1);
  auto made = Disturbance::create({scene.disturbance.press_half_life_s, scene.disturbance.wet_half_life_s,
                                   size_t(scene.disturbance.memory_mb * double(1u << 20))});
  if (!made) return tl::unexpected(made.error());
  replay.disturbance_ = std::make_unique<Disturbance>(std::move(*made));
  if (auto begun = replay.begin(); !begun) return tl::unexpected(begun.error());
  return replay;
}

Expected<void> DisturbanceReplay::begin() {
  time_ = 0;
  steps_ = -1;
  disturbance_->clear();
  return path_.empty() ? Expected<void>() : disturbance_->load(path_);
}

/// The step numbered steps_ + 1: what lies after the one before, up to its own time.
Expected<void> DisturbanceReplay::step() {
  ++steps_;
  const double now = double(steps_) / k_steps_a_second, before = double(steps_ - 1) / k_steps_a_second;
  if (auto advanced = disturbance_->advance(std::max(now - time_, 0.0)); !advanced) return advanced;
  time_ = std::max(time_, now);
  for (const SceneEvent& event : scene_.events)
    if (event.time_s > before && event.time_s <= now)
      if (auto done = happen(event, *disturbance_); !done) return done;
  for (const SceneWalker& walker : scene_.walkers)
    if (auto done = move(walker, std::max(before, 0.0), now, *disturbance_); !done) return done;
  return {};
}

Expected<void> DisturbanceReplay::advance_to(double time_s) {
  const double target = std::clamp(time_s, 0.0, k_last_time);
  const bool replays = !scene_.walkers.empty() || !scene_.events.empty();
  if (target < time_) {
    if (!replays) return {};
    if (auto begun = begin(); !begun) return begun;
  }
  if (replays)
    while (double(steps_ + 1) / k_steps_a_second <= std::min(target, end_))
      if (auto stepped = step(); !stepped) return stepped;
  while (time_ < target) {
    const double pass = std::min(target - time_, 1e6);
    if (auto advanced = disturbance_->advance(pass); !advanced) return advanced;
    time_ = target - time_ <= pass ? target : time_ + pass;
  }
  return {};
}

}  // namespace sward::host
