// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/commands/mesh_world.h"

#include <sward/terrain/world.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "host/flight.h"
#include "host/scene_renderer.h"
#include "host/stopwatch.h"
#include "sward/output/figures.h"
#include "sward/output/files.h"
#include "sward/output/ply.h"
#include "sward/output/progress.h"

namespace sward::tool {

namespace {

struct Row {
  double poll_ms = 0, update_ms = 0;
  RoamStats roam;
  float bound_px = 0;
  WorldStats world;
};

void poll(World& world, RoamMesh& mesh) {
  for (const LatticeBox& box : world.poll()) mesh.residency_changed(box);
}

Expected<Row> run_frame(const host::FlightFrame& frame, bool morph, bool wait, World& world, RoamMesh& mesh) {
  Row row;
  const auto poll_begin = std::chrono::steady_clock::now();
  world.follow({&frame.view, 1});
  poll(world, mesh);
  while (wait && !world.settled()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    poll(world, mesh);
  }
  row.poll_ms = host::ms_since(poll_begin);
  const auto update_begin = std::chrono::steady_clock::now();
  auto stats = morph ? mesh.update(frame.view, frame.time_s) : mesh.update(frame.view);
  if (!stats) return tl::unexpected(stats.error());
  row.update_ms = host::ms_since(update_begin);
  row.roam = *stats;
  row.bound_px = mesh.bound_px();
  row.world = world.stats();
  return row;
}

std::string timings_csv(const std::vector<Row>& rows) {
  std::string csv =
      "frame,poll_ms,update_ms,visible,splits,merges,bound_px,"
      "resident,loads,drops,memory_mb\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    csv += std::to_string(i);
    for (const double value : {row.poll_ms, row.update_ms, double(row.roam.visible), double(row.roam.splits),
                               double(row.roam.merges), double(row.bound_px), double(row.world.resident),
                               double(row.world.loads), double(row.world.drops), double(row.world.bytes) / (1 << 20)})
      csv += "," + figure_text(value);
    csv += '\n';
  }
  return csv;
}

void print_result(const std::vector<Row>& rows) {
  std::vector<double> updates;
  size_t most_bytes = 0;
  for (const Row& row : rows) {
    updates.push_back(row.update_ms);
    most_bytes = std::max(most_bytes, row.world.bytes);
  }
  const Summary summary = summarise(std::move(updates));
  const WorldStats& last = rows.back().world;
  std::printf(
      "%zu frames: update median %.3f ms, p95 %.3f ms, max %.3f ms; "
      "%llu squares loaded, %llu dropped, at "
      "most %.1f MB\n",
      rows.size(), summary.median, summary.p95, summary.max, static_cast<unsigned long long>(last.loads),
      static_cast<unsigned long long>(last.drops), double(most_bytes) / (1 << 20));
  if (last.failures > 0)
    std::printf("%llu loads failed; the last: %s\n", static_cast<unsigned long long>(last.failures),
                last.last_error.c_str());
}

}  // namespace

Expected<void> mesh_over_world(const Scene& scene, const WorldMeshOptions& options) {
  // As the pictures' terrain, whose base map is not looked at here.
  auto terrain = host::load_terrain(scene, false);
  if (!terrain) return tl::unexpected(terrain.error());
  World& world = *(*terrain)->world();
  auto path = make_path(options.path, **terrain);
  if (!path) return tl::unexpected(path.error());
  if (options.at)
    if (auto checked = check_frame(*options.at, *path); !checked) return checked;
  RoamOptions roam;
  roam.max_triangles = options.triangles;
  roam.target_px = options.target_px;
  roam.plain = options.plain;
  if (options.plain) roam.hysteresis = 0;
  auto mesh = RoamMesh::create(world, roam);
  if (!mesh) return tl::unexpected(mesh.error());

  const size_t count = options.timings.empty() && options.at ? *options.at + 1 : path->size();
  std::vector<Row> rows;
  std::string ply;
  ProgressLine progress("mesh");
  for (size_t i = 0; i < count; ++i) {
    auto row = run_frame((*path)[i], !options.no_morph, options.wait, world, *mesh);
    if (!row) return fail("frame " + std::to_string(i) + ": " + row.error().message);
    rows.push_back(std::move(*row));
    if (options.at == i)
      ply = options.all ? make_ply(*mesh, mesh->all_indices()) : make_ply(*mesh, mesh->visible_indices());
    progress.show(float(i + 1) / float(count));
  }
  if (!options.timings.empty())
    if (auto written = write_file(options.timings, timings_csv(rows)); !written) return written;
  if (auto written = write_file(options.output, ply); !written) return written;
  print_result(rows);
  return {};
}

}  // namespace sward::tool
