// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What ground that remembers costs: brushes, time, lookups, uploads. One line each, medians of many calls.
#include <sward/vegetation/disturbance.h>
#include <sward/vegetation/disturbance_textures.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "host/egl_context.h"

namespace {

using namespace sward;

/// Median microseconds of a call that is given its number.
double median_us(int calls, const std::function<void(int)>& call) {
  std::vector<double> all;
  for (int i = 0; i < calls; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    call(i);
    all.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  std::ranges::nth_element(all, all.begin() + calls / 2);
  return all[size_t(calls / 2)];
}

Disturbance made() {
  return std::move(*Disturbance::create());
}

glm::dvec2 on_a_walk(int i) {
  return {0.023 * i, 5 * std::sin(0.001 * i)};
}

void report(const char* what, double us) {
  std::printf("%-58s %9.2f us\n", what, us);
}

void brushes() {
  Disturbance d = made();
  report("a foot (press_capsule 0.25 m, radius 0.12 m)", median_us(20000, [&](int i) {
           (void)d.press_capsule(on_a_walk(i), on_a_walk(i) + glm::dvec2(0.25, 0), 0.12, 0.9f);
         }));
  report("advance a frame", median_us(20000, [&](int) { (void)d.advance(1.0 / 60); }));
  report("at (CPU lookup)", median_us(20000, [&](int i) { (void)d.at(on_a_walk(i)); }));
  report("explosion of 5 m", median_us(200, [&](int i) { (void)d.explode({100.0 + 20 * i, 0}, 5); }));
  report("strip of 2 m x 50 m, mown", median_us(50, [&](int i) {
           (void)d.cut_capsule({0, 90 + 3.0 * i}, {50, 90 + 3.0 * i}, 1, 0.05f);
         }));
  report("fire of 150 m", median_us(5, [&](int i) { (void)d.burn_disc({-1000.0 - 500 * i, 0}, 150, 1); }));
}

void uploads() {
  Disturbance d = made();
  auto t = DisturbanceTextures::create();
  if (!t) return;
  report("upload, nothing there", median_us(2000, [&](int) { t->upload(d, {0, 0}); }));
  for (int i = 0; i < 2000; ++i) (void)d.press_capsule(on_a_walk(i), on_a_walk(i), 0.2, 1);
  t->upload(d, {0, 0});
  report("upload, nothing changed", median_us(2000, [&](int) { t->upload(d, {0, 0}); }));
  size_t bytes = 0;
  report("upload of a walker's frame", median_us(4000, [&](int i) {
           (void)d.press_capsule(on_a_walk(2000 + i), on_a_walk(2000 + i), 0.2, 1);
           bytes += t->upload(d, on_a_walk(2000 + i)).bytes;
         }));
  std::printf("  with its brush; %.1f KB a frame\n", double(bytes) / 4000 / 1e3);
  report("upload of all",
         median_us(50, [&](int i) { t->upload(d, i % 2 == 0 ? glm::dvec2(1e5, 0) : on_a_walk(3000)); }));
}

}  // namespace

int main() {
  brushes();
  auto context = host::EglContext::create(false);
  if (!context) {
    std::printf("no uploads: %s\n", context.error().message.c_str());
    return 0;
  }
  uploads();
  return 0;
}
