// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What a host brings along, for both examples: heights, a base map, the species that it wants; here all from formulas.
#include <sward/vegetation/landscape.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hello {

[[noreturn]] inline void give_up(const std::string& why) {
  std::fprintf(stderr, "hello: error: %s\n", why.c_str());
  std::exit(1);
}

/// Everything that can fail returns an Expected: a value, or an Error with one sentence.
template <class T>
T need(sward::Expected<T> result) {
  if (!result) give_up(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// 513 x 513 heights, 2 m apart: row by row from the north, metres.
inline std::vector<float> heights() {
  std::vector<float> heights;
  for (int row = 0; row < 513; ++row)
    for (int column = 0; column < 513; ++column)
      heights.push_back(
          float(8 * std::sin(column * 0.045) * std::cos(row * 0.037) + 2 * std::sin(column * 0.21 + row * 0.13)));
  return heights;
}

/// Ground colours, west to east and north to south; here one green texel. Plants grow where their own colour is, and
/// take it on.
inline sward::ColorMap colors(const sward::HeightField& field) {
  return {1, 1, {{96, 120, 48, 255}}, field.min_corner(), field.max_corner() - field.min_corner()};
}

inline sward::Layer grass() {
  sward::Species grass;
  grass.name = "grass";
  grass.reference_hsv = {0.22f, 0.6f, 0.47f};
  sward::Layer layer;
  layer.species = {grass};
  layer.horizon_m = 60;
  return layer;
}

/// The host's own state: sward draws into whatever is bound.
inline void begin_frame(glm::ivec2 size) {
  glViewport(0, 0, size.x, size.y);
  glClearColor(0.62f, 0.74f, 0.90f, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace hello
