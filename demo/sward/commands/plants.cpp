// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "host/disturbance_replay.h"
#include "host/egl_context.h"
#include "host/render_target.h"
#include "host/scene_frame.h"
#include "sward/arguments.h"
#include "sward/commands/commands.h"
#include "sward/commands/flight_options.h"
#include "sward/output/figures.h"
#include "sward/output/files.h"
#include "sward/scene_options.h"

namespace sward::tool {

namespace {

struct PlantsOptions {
  SceneOptions scene;
  PathOptions path;
  std::optional<size_t> at;
  std::string region;  ///< "x0,y0,x1,y1"
  size_t most = 1000000;
  bool gpu = false;
  std::string output;
};

std::string plants_csv(const std::vector<Plant>& plants) {
  std::string csv = "triangle,rank,species,x,y,z,height,width,stiffness,azimuth,score,fade\n";
  for (const Plant& plant : plants) {
    csv += std::to_string(plant.triangle.bits) + "," + std::to_string(plant.rank) + "," + std::to_string(plant.species);
    for (int axis = 0; axis < 3; ++axis) csv += "," + figure_text(plant.position[axis]);
    for (const float value : {plant.height, plant.width, plant.stiffness, plant.azimuth, plant.score, plant.fade})
      csv += "," + figure_text(double(value));
    csv += '\n';
  }
  return csv;
}

using Path = std::vector<host::FlightFrame>;

// The mesh of a frame depends on the way to it, so every frame up to it is run, as `fly` does.
Expected<std::vector<Plant>> plants_by_cpu(const Scene& scene, const host::SceneTerrain& terrain, const Path& path,
                                           size_t at) {
  RoamOptions roam;
  roam.max_triangles = scene.max_triangles;
  roam.target_px = scene.target_px;
  auto frame = host::SceneFrame::create(scene.layers, terrain, roam);
  if (!frame) return tl::unexpected(frame.error());
  if (auto excluded = frame->exclude(scene.exclusions); !excluded) return tl::unexpected(excluded.error());
  for (size_t i = 0; i <= at; ++i) {
    if (auto streamed = frame->stream(path[i].view, host::Streaming::wait); !streamed)
      return tl::unexpected(streamed.error());
    if (auto updated = frame->mesh().update(path[i].view, path[i].time_s); !updated)
      return tl::unexpected(updated.error());
  }
  frame->cut_triangles(path[at].view);
  frame->seed_triangles(path[at].view, terrain.colors());
  auto replay = host::DisturbanceReplay::create(scene);
  if (!replay) return tl::unexpected(replay.error());
  if (auto replayed = replay->advance_to(path[at].time_s); !replayed) return tl::unexpected(replayed.error());
  return frame->plants(path[at].view, terrain.colors(), scene.sun_azimuth, &replay->disturbance());
}

Expected<std::vector<Plant>> plants_by_gpu(const Scene& scene, const host::SceneTerrain& terrain, const Path& path,
                                           size_t at) {
  auto target = host::RenderTarget::create({16, 16}, 1);
  if (!target) return tl::unexpected(target.error());
  auto renderer = host::SceneRenderer::create(scene, terrain, gl::ShaderLibrary());
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->set_streaming(host::Streaming::wait);
  for (size_t i = 0; i < at; ++i)
    if (auto updated = renderer->update(path[i].view, path[i].time_s); !updated) return tl::unexpected(updated.error());
  target->begin();
  auto drawn = renderer->draw(path[at].view, make_lighting(scene), path[at].time_s, target->framebuffer(), 1, true);
  if (!drawn) return tl::unexpected(drawn.error());
  return renderer->plants_gpu(path[at].view, target->framebuffer());
}

Expected<void> check_choice(const PlantsOptions& options) {
  if (options.region.empty()) return {};
  if (options.gpu) return fail("--region lists a place and not a frame: it goes without --gpu");
  return {};
}

// As drawn near by, whatever view.
Expected<std::vector<Plant>> plants_in_region(const Scene& scene, const host::SceneTerrain& terrain,
                                              const PlantsOptions& options) {
  if (terrain.world() != nullptr)
    return fail("--region needs ground that is all there, and this is a world; take a frame over it (--flight, --at)");
  auto ends = parse_numbers(options.region, 4, 4);
  if (!ends) return tl::unexpected(ends.error());
  const std::vector<double>& e = *ends;
  const PlantRegion region = PlantRegion::rectangle({e[0], e[1]}, {e[2], e[3]});
  Exclusions exclusions;
  for (const ExclusionShape& shape : scene.exclusions)
    if (auto added = exclusions.add(shape); !added) return tl::unexpected(added.error());
  // As the scene begins.
  auto replay = host::DisturbanceReplay::create(scene);
  if (!replay) return tl::unexpected(replay.error());
  if (auto replayed = replay->advance_to(0); !replayed) return tl::unexpected(replayed.error());
  std::vector<Plant> all;
  uint32_t first_species = 0;
  for (const Layer& layer : scene.layers) {
    const PlantQueryOptions query{options.most - std::min(options.most, all.size()), &exclusions, scene.sun_azimuth,
                                  &replay->disturbance()};
    const auto mesh = terrain.mesh_of(layer.name);
    auto grown = mesh ? query_plants(layer, *mesh, region, query)
                      : query_plants(layer, terrain.surface(), terrain.colors(), region, query);
    if (!grown) return tl::unexpected(grown.error());
    for (Plant& plant : *grown) plant.species += first_species;
    first_species += uint32_t(layer.species.size());
    all.insert(all.end(), grown->begin(), grown->end());
  }
  return all;
}

Expected<void> write_plants(const PlantsOptions& options, const Expected<std::vector<Plant>>& grown) {
  if (!grown) return tl::unexpected(grown.error());
  if (auto written = write_file(options.output, plants_csv(*grown)); !written) return written;
  std::printf("%zu plants\n", grown->size());
  return {};
}

Expected<void> plants(const PlantsOptions& options) {
  if (auto checked = check_choice(options); !checked) return checked;
  if (auto checked = check_output(options.output); !checked) return checked;
  if (auto checked = check_path(options.path); !checked) return checked;
  auto scene = make_scene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  std::optional<host::EglContext> context;
  if (options.gpu) {
    auto created = host::EglContext::create(false);
    if (!created) return tl::unexpected(created.error());
    context.emplace(std::move(*created));
  }
  auto terrain = make_terrain(*scene, options.scene);
  if (!terrain) return tl::unexpected(terrain.error());
  if (!options.region.empty()) return write_plants(options, plants_in_region(*scene, **terrain, options));
  auto path = make_path(options.path, **terrain);
  if (!path) return tl::unexpected(path.error());
  if (auto checked = check_frame(*options.at, *path); !checked) return checked;
  auto grown = options.gpu ? plants_by_gpu(*scene, **terrain, *path, *options.at)
                           : plants_by_cpu(*scene, **terrain, *path, *options.at);
  return write_plants(options, grown);
}

}  // namespace

Command add_plants(CLI::App& parent) {
  auto options = std::make_shared<PlantsOptions>();
  CLI::App* app = parent.add_subcommand("plants", "List the plants of one frame of a camera path, or of a place");
  app->footer("species counts through the layers in the scene's order, bare ground included; angles in radians.");
  add_scene_options(*app, options->scene, true);
  add_path_options(*app, options->path);
  add_season_option(*app, options->scene);
  add_source_option(*app, options->scene);
  CLI::App* what = app->add_option_group("Frame or place");
  what->require_option(1);
  what->add_option("--at", options->at, "Frame of the flight")->type_name("FRAME");
  what->add_option("--region", options->region,
                   "All plants of a rectangle, at full density, instead of a frame's; metres")
      ->type_name("x0,y0,x1,y1")
      ->check(as_check([](const std::string& text) { return parse_numbers(text, 4, 4); }));
  app->add_option("--most", options->most, "More plants in a region are an error")
      ->type_name("N")
      ->capture_default_str();
  app->add_flag("--gpu", options->gpu, "As the GPU grows them, read back; without: the CPU twin, no GL");
  app->add_option("-o,--output", options->output, "CSV file")->type_name("FILE")->required();
  return {app, [options] { return plants(*options); }};
}

}  // namespace sward::tool
