// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "host/scene_frame.h"
#include "host/stopwatch.h"
#include "sward/commands/commands.h"
#include "sward/commands/flight_options.h"
#include "sward/commands/mesh_world.h"
#include "sward/output/figures.h"
#include "sward/output/files.h"
#include "sward/output/ply.h"
#include "sward/output/progress.h"
#include "sward/scene_options.h"

namespace sward::tool {

namespace {

struct MeshOptions {
  SceneOptions scene;
  PathOptions path;
  std::string timings, output;
  std::optional<size_t> at;
  float target_px = 0;
  bool wait = false, all = false, no_morph = false, plain = false;
};

// The same options for a world in the place of a height field.
Expected<void> mesh_of_world(const MeshOptions& options, const Scene& scene) {
  WorldMeshOptions world;
  world.path = options.path;
  world.wait = options.wait;
  world.timings = options.timings;
  world.output = options.output;
  world.at = options.at;
  world.triangles = scene.max_triangles;
  world.target_px = options.target_px > 0 ? options.target_px : scene.target_px;
  world.all = options.all;
  world.no_morph = options.no_morph || options.plain;
  world.plain = options.plain;
  return mesh_over_world(scene, world);
}

struct MeshRow {
  double update_ms = 0, fixed_level_ms = 0;
  RoamStats roam;
  float bound_px = 0;
  uint32_t fixed_triangles = 0;
};

// Stands for a renderer's buffers: what an upload would write is written here.
class SlotBuffer {
 public:
  void write(const RoamMesh& mesh) {
    const std::span<const RoamVertex> slots = mesh.vertices();
    const bool whole = mesh.all_vertices_changed() || vertices_.size() < slots.size();
    if (vertices_.size() < slots.size()) vertices_.resize(slots.size() + slots.size() / 2);
    if (whole)
      std::copy(slots.begin(), slots.end(), vertices_.begin());
    else
      for (const uint32_t slot : mesh.changed_vertices()) vertices_[slot] = slots[slot];
    const std::span<const uint32_t> indices = mesh.visible_indices();
    const std::span<const uint32_t> changed = mesh.changed_triangles();
    if (indices_.size() < indices.size()) indices_.resize(indices.size() + indices.size() / 2);
    for (const uint32_t slot : changed)
      if (3 * size_t(slot) < indices.size()) std::copy_n(indices.begin() + 3 * slot, 3, indices_.begin() + 3 * slot);
    written_ += mesh.changed_vertices().size() + changed.size();
  }
  /// Vertices and triangles written so far.
  size_t written() const { return written_; }

 private:
  std::vector<RoamVertex> vertices_;
  std::vector<uint32_t> indices_;
  size_t written_ = 0;
};

Expected<MeshRow> run_frame(const host::FlightFrame& at, host::SceneFrame& frame, SlotBuffer& buffer) {
  const View& view = at.view;
  MeshRow row;
  const auto update_begin = std::chrono::steady_clock::now();
  auto stats = frame.mesh().update(view, at.time_s);
  if (!stats) return tl::unexpected(stats.error());
  buffer.write(frame.mesh());
  row.update_ms = host::ms_since(update_begin);
  row.roam = *stats;
  const auto cut_begin = std::chrono::steady_clock::now();
  row.fixed_triangles = frame.cut_triangles(view);
  row.fixed_level_ms = host::ms_since(cut_begin);
  row.bound_px = frame.mesh().bound_px();
  return row;
}

std::string timings_csv(const std::vector<MeshRow>& rows) {
  std::string csv = "frame,update_ms,fixed_level_ms,visible,splits,merges,bound_px,fixed_triangles\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    const MeshRow& row = rows[i];
    csv += std::to_string(i);
    for (const double value : {row.update_ms, row.fixed_level_ms, double(row.roam.visible), double(row.roam.splits),
                               double(row.roam.merges), double(row.bound_px), double(row.fixed_triangles)})
      csv += "," + figure_text(value);
    csv += '\n';
  }
  return csv;
}

void print_result(const std::vector<MeshRow>& rows) {
  std::vector<double> updates;
  uint32_t visible = 0;
  for (const MeshRow& row : rows) {
    updates.push_back(row.update_ms);
    visible = std::max(visible, row.roam.visible);
  }
  const Summary summary = summarise(std::move(updates));
  std::printf("%zu frames: update median %.3f ms, p95 %.3f ms, max %.3f ms; at most %u triangles visible\n",
              rows.size(), summary.median, summary.p95, summary.max, visible);
}

Expected<void> mesh(const MeshOptions& options) {
  if (auto checked = check_output(options.timings); !checked) return checked;
  if (auto checked = check_output(options.output); !checked) return checked;
  if (auto checked = check_path(options.path); !checked) return checked;
  auto scene = make_scene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  if (auto checked = check_wait(*scene, options.wait); !checked) return checked;
  if (!scene->world_path.empty()) return mesh_of_world(options, *scene);
  auto terrain = make_terrain(*scene, options.scene);
  if (!terrain) return tl::unexpected(terrain.error());
  auto path = make_path(options.path, **terrain);
  if (!path) return tl::unexpected(path.error());
  if (options.at)
    if (auto checked = check_frame(*options.at, *path); !checked) return checked;

  RoamOptions roam;
  roam.max_triangles = scene->max_triangles;
  roam.target_px = options.target_px > 0 ? options.target_px : scene->target_px;
  roam.plain = options.plain;
  if (options.plain) roam.hysteresis = 0;
  if (options.no_morph) roam.morph_s = 0;
  auto frame = host::SceneFrame::create(scene->layers, **terrain, roam);
  if (!frame) return tl::unexpected(frame.error());
  // Timings want the whole flight; a mesh alone only what leads to its frame.
  const size_t count = options.timings.empty() && options.at ? *options.at + 1 : path->size();
  SlotBuffer buffer;
  std::vector<MeshRow> rows;
  std::string ply;
  ProgressLine progress("mesh");
  for (size_t i = 0; i < count; ++i) {
    auto row = run_frame((*path)[i], *frame, buffer);
    if (!row) return fail("frame " + std::to_string(i) + ": " + row.error().message);
    rows.push_back(*row);
    if (options.at == i) {
      const RoamMesh& roam_mesh = frame->mesh();
      ply =
          options.all ? make_ply(roam_mesh, roam_mesh.all_indices()) : make_ply(roam_mesh, roam_mesh.visible_indices());
    }
    progress.show(float(i + 1) / float(count));
  }
  if (!options.timings.empty())
    if (auto written = write_file(options.timings, timings_csv(rows)); !written) return written;
  if (auto written = write_file(options.output, ply); !written) return written;
  print_result(rows);
  return {};
}

}  // namespace

Command add_mesh(CLI::App& parent) {
  auto options = std::make_shared<MeshOptions>();
  // Of the mesh, whatever draws the scene's ground.
  options->scene.source = "roam";
  CLI::App* app = parent.add_subcommand("mesh", "Run the terrain mesh alone over a camera path, without GL");
  add_scene_options(*app, options->scene, false);
  add_wait_option(*app, options->wait);
  add_path_options(*app, options->path);
  app->add_option("--target-px", options->target_px, "Stop refining when the bound is this small; 0: use the budget")
      ->type_name("PX");
  app->add_option("--timings", options->timings, "One row a frame (CSV)")->type_name("FILE");
  CLI::Option* at = app->add_option("--at", options->at, "Frame whose mesh is written")->type_name("FRAME");
  CLI::Option* output = app->add_option("-o,--output", options->output, "Mesh (PLY)")->type_name("FILE");
  at->needs(output);
  output->needs(at);
  app->add_flag("--all", options->all, "All leaves, not only the visible ones")->needs(output);
  app->add_flag("--no-morph", options->no_morph, "Vertices stand at their final height at once");
  app->add_flag("--plain", options->plain, "As published in 1997: no hysteresis, no morph");
  return {app, [options] { return mesh(*options); }};
}

}  // namespace sward::tool
