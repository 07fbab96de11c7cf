// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/egl_context.h"
#include "host/render_target.h"
#include "host/scene_frame.h"
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
  size_t at = 0;
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
  for (size_t i = 0; i <= at; ++i) {
    if (auto streamed = frame->stream(path[i].view, host::Streaming::wait); !streamed)
      return tl::unexpected(streamed.error());
    if (auto updated = frame->mesh().update(path[i].view, path[i].time_s); !updated)
      return tl::unexpected(updated.error());
  }
  frame->cut_triangles(path[at].view);
  frame->seed_triangles(path[at].view, terrain.colors());
  return frame->plants(path[at].view, terrain.colors(), scene.sun_azimuth);
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

Expected<void> plants(const PlantsOptions& options) {
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
  auto path = make_path(options.path, **terrain);
  if (!path) return tl::unexpected(path.error());
  if (auto checked = check_frame(options.at, *path); !checked) return checked;
  auto grown = options.gpu ? plants_by_gpu(*scene, **terrain, *path, options.at)
                           : plants_by_cpu(*scene, **terrain, *path, options.at);
  if (!grown) return tl::unexpected(grown.error());
  if (auto written = write_file(options.output, plants_csv(*grown)); !written) return written;
  std::printf("%zu plants\n", grown->size());
  return {};
}

}  // namespace

Command add_plants(CLI::App& parent) {
  auto options = std::make_shared<PlantsOptions>();
  CLI::App* app = parent.add_subcommand("plants", "List the plants of one frame of a camera path");
  app->footer("species counts through the layers in the scene's order, bare ground included; angles in radians.");
  add_scene_options(*app, options->scene, true);
  add_path_options(*app, options->path);
  app->add_option("--at", options->at, "Frame of the flight")->type_name("FRAME")->required();
  app->add_flag("--gpu", options->gpu, "As the GPU grows them, read back; without: the CPU twin, no GL");
  app->add_option("-o,--output", options->output, "CSV file")->type_name("FILE")->required();
  return {app, [options] { return plants(*options); }};
}

}  // namespace sward::tool
