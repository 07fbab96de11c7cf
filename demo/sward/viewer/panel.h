// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/vegetation/species.h>
#include <sward/vegetation/wind.h>
#include <string>
#include <vector>

#include "host/scene_renderer.h"
#include "sward/viewer/camera.h"

namespace sward::tool {

/// What the panel shows and changes.
struct PanelState {
  float sun_azimuth_degrees = 0, sun_elevation_degrees = 30;
  float haze_distance_m = 12000;
  float season = 0;  ///< Time of the year, 0..1.
  std::vector<GroundSeason> ground_seasons;
  bool has_mesh = true;  ///< The ground is a mesh with a budget, no clipmap.
  int max_triangles = 20000;
  float target_px = 0;
  bool vegetation = true;
  Weather weather;           ///< The wind everywhere.
  bool wind_arrows = false;  ///< Shown over the ground.
  std::vector<Layer> layers;
  std::string message;  ///< The last error, or what was reloaded.

  // Set by the panel when something is to be applied.
  bool budget_changed = false;
  bool weather_changed = false;
  std::vector<bool> layer_changed;
};

/// Draws the panel into the current Dear ImGui frame.
void draw_panel(PanelState& state, WalkCamera& camera, const host::SceneFrameStats& stats, double frame_ms);

}  // namespace sward::tool
