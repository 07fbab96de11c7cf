// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/world_stream.h"

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace sward::host {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds k_patience{60};
constexpr size_t k_most_named = 4;  // squares in an error
constexpr int k_most_steps_down = 8;

std::string name_of(glm::ivec2 square) {
  return "square (" + std::to_string(square.x) + ", " + std::to_string(square.y) + ")";
}

tl::unexpected<Error> fail_with(const std::vector<WorldFailure>& failures) {
  std::string text = std::to_string(failures.size()) +
                     (failures.size() == 1 ? " square of the world cannot" : " squares of the world cannot") +
                     " be loaded: ";
  for (size_t i = 0; i < std::min(failures.size(), k_most_named); ++i)
    text += (i == 0 ? "" : "; ") + name_of(failures[i].square) + ": " + failures[i].message;
  if (failures.size() > k_most_named) text += "; and others";
  return fail(text);
}

}  // namespace

void WorldStream::report_failures() {
  const uint64_t failures = world_->stats().failures;
  if (failures == failures_seen_) return;
  failures_seen_ = failures;
  for (const WorldFailure& failure : world_->failures()) {
    std::string& reported = reported_[{failure.square.x, failure.square.y}];
    if (reported == failure.message) continue;
    reported = failure.message;
    std::fprintf(stderr, "sward: warning: %s: %s; it is tried again later\n", name_of(failure.square).c_str(),
                 failure.message.c_str());
  }
}

std::vector<LatticeBox> WorldStream::step(const View& view) {
  world_->follow({&view, 1});
  std::vector<LatticeBox> boxes = world_->poll();
  report_failures();
  return boxes;
}

Expected<std::vector<LatticeBox>> WorldStream::wait(const View& view, const Progress& progress) {
  world_->follow({&view, 1});
  std::vector<LatticeBox> all;
  Clock::time_point last_news = Clock::now();
  for (;;) {
    const std::vector<LatticeBox> boxes = world_->poll();
    all.insert(all.end(), boxes.begin(), boxes.end());
    if (const auto failures = world_->failures(); !failures.empty()) return fail_with(failures);
    if (world_->settled()) return all;
    const WorldStats stats = world_->stats();
    if (progress && stats.wanted > 0) progress(std::min(float(stats.resident) / float(stats.wanted), 1.0f));
    if (!boxes.empty()) last_news = Clock::now();
    if (Clock::now() - last_news > k_patience)
      return fail("no square of the world has come for " + std::to_string(k_patience.count()) + " seconds; " +
                  std::to_string(stats.in_flight) + " are being loaded");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Expected<void> load_first_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport,
                               const Progress& progress) {
  if (terrain.world() == nullptr) return {};
  WorldStream stream(*terrain.world());
  // What is loaded may lift the camera, and what it sees from there may want more.
  for (int i = 0; i < k_most_steps_down; ++i) {
    const View view = scene_view(scene, terrain, viewport);
    if (auto waited = stream.wait(view, progress); !waited) return tl::unexpected(waited.error());
    if (scene_view(scene, terrain, viewport).eye == view.eye) return {};
  }
  return {};
}

}  // namespace sward::host
