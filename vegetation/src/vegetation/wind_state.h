// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/vegetation/wind.h>
#include <array>
#include <memory>
#include <vector>

#include "vegetation/wind_grid.h"
#include "vegetation/wind_params.h"
#include "vegetation/wind_slots.h"

namespace sward {

/// Cells a side of a movers' grid.
inline constexpr int k_wind_grid_side = 128;

/// A square map laid over the world: turned, scaled, and moved along.
struct WindMapLayer {
  double turn = 0;      ///< Radians.
  double tile_m = 1;    ///< Its side.
  glm::dvec2 moved{0};  ///< How far it has been carried, in tiles, each [0, 1).

  glm::dvec2 place(glm::dvec2 world) const;  ///< In tiles.
  void carry(glm::dvec2 metres);
  /// Another side, about a place that stays where it is.
  void scale(double to_tile_m, glm::dvec2 about);
};

struct MovingMover {
  WindMover mover;
  glm::dvec2 from{0};  ///< Where it was at Wind::time(); mover.position is where it goes.
};

/// All that a Wind is.
struct WindState {
  uint64_t identity = 0;  ///< Another for each Wind of the process.
  Weather weather;
  glm::dvec2 mean{0};  ///< m/s
  double time = 0;
  int64_t steps = 0;  ///< Of the grids.
  glm::dvec3 eye{0};
  std::array<WindMapLayer, 2> gusts, noise;
  std::array<double, 2> noise_turn{};  ///< Of the noise's vectors, radians.
  WindSlots<WindSource, WindSourceId> sources;
  WindSlots<MovingMover, WindMoverId> movers;
  std::vector<WindSource> blowing;  ///< The sources that count now, at most k_wind_sources_at_once.
  WindGrid fine{k_wind_grid_side, 0.5}, coarse{k_wind_grid_side, 2.0};
  std::shared_ptr<const PaintedWind> painted;
  uint64_t painting = 0;           ///< Counts set_painted().
  wind_shared::WindParams params;  ///< For `eye`.
};

/// Moves the gusts and the noise on by `seconds`.
void carry_wind_maps(WindState& state, double seconds);
/// Steps the grids from WindState::time on by `seconds`; movers arrive.
void step_wind_grids(WindState& state, double seconds);
/// Drops the sources that are over and chooses those that blow.
void choose_wind_sources(WindState& state);
/// What the shaders get for a view from `eye`.
wind_shared::WindParams make_wind_params(const WindState& state, glm::dvec3 eye);
/// common_wind_field.glsl on the CPU. `point` relative to the eye of `params`.
WindHere wind_here(const WindState& state, const wind_shared::WindParams& params, glm::vec2 point);

Expected<void> validate(const PaintedWind& painted);

}  // namespace sward
