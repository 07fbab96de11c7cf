// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/figures.h"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace sward::tool {

namespace {

constexpr FigureColumn k_columns[] = {
    {"plants", &FrameFigures::plants},
    {"clusters_submitted", &FrameFigures::clusters_submitted},
    {"clusters_fertile", &FrameFigures::clusters_fertile},
    {"fixed_triangles", &FrameFigures::fixed_triangles},
    {"triangles_visible", &FrameFigures::triangles_visible},
    {"triangles_drawn", &FrameFigures::triangles_drawn},
    {"grow_fragments", &FrameFigures::grow_fragments},
    {"splits", &FrameFigures::splits},
    {"merges", &FrameFigures::merges},
    {"bound_px", &FrameFigures::bound_px},
    {"cpu_roam_ms", &FrameFigures::cpu_roam_ms},
    {"cpu_seeding_ms", &FrameFigures::cpu_seeding_ms},
    {"gpu_terrain_ms", &FrameFigures::gpu_terrain_ms},
    {"gpu_classify_ms", &FrameFigures::gpu_classify_ms},
    {"gpu_grow_ms", &FrameFigures::gpu_grow_ms},
    {"frame_ms", &FrameFigures::frame_ms},
    {"peak_rss_mb", &FrameFigures::peak_rss_mb},
    {"squares_resident", &FrameFigures::squares_resident},
    {"squares_wanted", &FrameFigures::squares_wanted},
    {"squares_failing", &FrameFigures::squares_failing},
    {"world_mb", &FrameFigures::world_mb},
    {"cpu_stream_ms", &FrameFigures::cpu_stream_ms},
    {"clipmap_blocks", &FrameFigures::clipmap_blocks},
    {"clipmap_finest", &FrameFigures::clipmap_finest},
    {"clipmap_points", &FrameFigures::clipmap_points},
    {"clipmap_bytes", &FrameFigures::clipmap_bytes},
};

double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size() - 1);
  const size_t below = size_t(place), above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - double(below));
}

}  // namespace

std::span<const FigureColumn> figure_columns() {
  return k_columns;
}

FrameFigures make_figures(const host::SceneFrameStats& stats, double time_s, double frame_ms, size_t plants) {
  FrameFigures figures;
  figures.time_s = time_s;
  figures.plants = double(plants);
  figures.clusters_submitted = stats.vegetation.clusters_submitted;
  figures.clusters_fertile = stats.vegetation.clusters_fertile;
  figures.fixed_triangles = stats.fixed_triangles;
  figures.triangles_visible = stats.roam.visible;
  figures.triangles_drawn = double(stats.vegetation.primitives) + stats.roam.visible;
  if (stats.vegetation.fragments) figures.grow_fragments = double(*stats.vegetation.fragments);
  figures.splits = stats.roam.splits;
  figures.merges = stats.roam.merges;
  if (!stats.clipmap) figures.bound_px = double(stats.bound_px);
  figures.cpu_roam_ms = stats.cpu_roam_ms;
  figures.cpu_seeding_ms = stats.cpu_seeding_ms;
  figures.gpu_terrain_ms = stats.gpu_terrain_ms;
  figures.gpu_classify_ms = stats.gpu_classify_ms;
  figures.gpu_grow_ms = stats.gpu_grow_ms;
  figures.frame_ms = frame_ms;
  figures.peak_rss_mb = peak_rss_mb();
  if (stats.clipmap) {
    figures.clipmap_blocks = stats.clipmap->blocks;
    figures.clipmap_finest = stats.clipmap->finest;
    figures.clipmap_points = double(stats.clipmap->upload.points);
    figures.clipmap_bytes = double(stats.clipmap->upload.bytes);
  }
  if (!stats.world) return figures;
  figures.squares_resident = stats.world->resident;
  figures.squares_wanted = stats.world->wanted;
  figures.squares_failing = stats.world->failing;
  figures.world_mb = double(stats.world->bytes) / (1 << 20);
  figures.cpu_stream_ms = stats.cpu_stream_ms;
  return figures;
}

FrameFigures median_figures(std::span<const FrameFigures> frames) {
  SWARD_ASSERT(!frames.empty(), "median_figures: no frames");
  FrameFigures middle = frames.front();
  for (const FigureColumn& column : k_columns) {
    std::vector<double> values;
    for (const FrameFigures& frame : frames)
      if (const Figure& figure = frame.*column.member) values.push_back(*figure);
    if (!values.empty()) middle.*column.member = summarise(std::move(values)).median;
  }
  return middle;
}

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024e-6;
}

Summary summarise(std::vector<double> values) {
  SWARD_ASSERT(!values.empty(), "summarise: no values");
  std::sort(values.begin(), values.end());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  return {percentile(values, 0.5), mean, percentile(values, 0.95), percentile(values, 0.99), values.back()};
}

nlohmann::ordered_json figure_json(Figure figure) {
  if (!figure || !std::isfinite(*figure)) return nullptr;
  if (*figure == std::floor(*figure) && std::abs(*figure) < 1e15) return int64_t(*figure);
  return *figure;
}

nlohmann::ordered_json summary_json(std::span<const FrameFigures> frames, const FigureColumn& column) {
  std::vector<double> values;
  for (const FrameFigures& frame : frames)
    if (const Figure& figure = frame.*column.member) values.push_back(*figure);
  if (values.empty() || values.size() != frames.size()) return nullptr;
  const Summary summary = summarise(std::move(values));
  return {{"median", figure_json(summary.median)},
          {"mean", figure_json(summary.mean)},
          {"p95", figure_json(summary.p95)},
          {"p99", figure_json(summary.p99)},
          {"max", figure_json(summary.max)}};
}

std::string figure_text(Figure figure) {
  if (!figure) return {};
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, *figure);
  return std::string(text, end);
}

std::string figures_csv(std::span<const FrameFigures> frames) {
  std::string csv = "frame,time_s";
  for (const FigureColumn& column : k_columns) csv.append(",").append(column.name);
  csv += '\n';
  for (size_t i = 0; i < frames.size(); ++i) {
    csv += std::to_string(i) + "," + figure_text(frames[i].time_s);
    for (const FigureColumn& column : k_columns) csv += "," + figure_text(frames[i].*column.member);
    csv += '\n';
  }
  return csv;
}

}  // namespace sward::tool
