// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene_renderer.h"

namespace sward::tool {

using Figure = std::optional<double>;  ///< Empty: the driver cannot measure it.

/// What is known of one drawn frame. Units are in the names.
struct FrameFigures {
  double time_s = 0;
  Figure plants, clusters_submitted, clusters_fertile;
  Figure fixed_triangles;
  Figure triangles_visible;  ///< Terrain leaves drawn.
  Figure triangles_drawn;    ///< All that were rasterised: terrain, plants, shadows.
  Figure grow_fragments;     ///< Runs of growth's fragment shaders.
  Figure splits, merges;
  Figure bound_px;
  Figure squares_resident, squares_wanted, squares_failing, world_mb;  ///< Empty where the ground is no world.
  Figure cpu_stream_ms;                                                ///< The same.
  Figure clipmap_blocks, clipmap_finest;  ///< Drawn; the finest ring drawn. Empty where the terrain's source is a mesh.
  Figure clipmap_points, clipmap_bytes;   ///< Read and sent in the frame.
  Figure cpu_roam_ms, cpu_seeding_ms;
  Figure gpu_terrain_ms, gpu_classify_ms, gpu_grow_ms;
  Figure frame_ms;  ///< From the first call to the GPU's last.
  Figure peak_rss_mb;
};

struct FigureColumn {
  std::string_view name;
  Figure FrameFigures::*member;
};
/// Every figure, in the order of the files.
std::span<const FigureColumn> figure_columns();

FrameFigures make_figures(const host::SceneFrameStats& stats, double time_s, double frame_ms, size_t plants);
/// The median of each figure, of drawings of one frame (not empty); time_s is the first's.
FrameFigures median_figures(std::span<const FrameFigures> frames);

/// Largest memory the process has held so far, in 10^6 bytes.
double peak_rss_mb();

struct Summary {
  double median = 0, mean = 0, p95 = 0, p99 = 0, max = 0;
};
/// Percentiles interpolate linearly between the nearest ranks. Takes at least one number.
Summary summarise(std::vector<double> values);

/// {"median":..., ...} of one figure over the frames; null when any frame lacks it.
nlohmann::ordered_json summary_json(std::span<const FrameFigures> frames, const FigureColumn& column);
/// A number, whole ones without a fraction; null when empty.
nlohmann::ordered_json figure_json(Figure figure);
/// Shortest text that reads back as the same number; empty when there is none.
std::string figure_text(Figure figure);

/// "frame,time_s,..." and one row a frame.
std::string figures_csv(std::span<const FrameFigures> frames);

}  // namespace sward::tool
