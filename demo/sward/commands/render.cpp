// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/egl_context.h"
#include "host/render_target.h"
#include "sward/arguments.h"
#include "sward/commands/commands.h"
#include "sward/output/figures.h"
#include "sward/output/files.h"
#include "sward/output/progress.h"
#include "sward/scene_options.h"

namespace sward::tool {

namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string size = "1280x720", samples = "4", output, stats;
  double time_s = 0;
  bool no_plants = false, wind_overlay = false;
};

std::string stats_json(const FrameFigures& figures) {
  nlohmann::ordered_json json;
  for (const FigureColumn& column : figure_columns())
    json[std::string(column.name)] = figure_json(figures.*column.member);
  json["gl_renderer"] = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return json.dump(2) + "\n";
}

// A picture is of all that its view wants.
Expected<void> load_squares(const Scene& scene, const host::SceneTerrain& terrain, glm::ivec2 size) {
  ProgressLine line("world");
  return host::load_first_view(scene, terrain, size, line.callback());
}

Expected<void> render(const RenderOptions& options) {
  auto size = parse_size(options.size);
  auto samples = parse_samples(options.samples);
  if (!size) return tl::unexpected(size.error());
  if (!samples) return tl::unexpected(samples.error());
  if (auto checked = check_size(*size); !checked) return checked;
  if (*samples < 0) return fail("--samples must be 1 or more, or max");
  if (!std::isfinite(options.time_s)) return fail("--time must be a finite number of seconds");
  if (auto checked = check_picture(options.output); !checked) return checked;
  if (auto checked = check_output(options.stats); !checked) return checked;
  auto scene = make_scene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  if (options.wind_overlay && !scene->wind) return fail("--wind-overlay needs a scene with [wind]; add the table");
  auto shaders = make_shaders(options.scene);
  if (!shaders) return tl::unexpected(shaders.error());

  auto context = host::EglContext::create(false);
  if (!context) return tl::unexpected(context.error());
  auto target = host::RenderTarget::create(*size, *samples);
  if (!target) return tl::unexpected(target.error());
  auto terrain = make_terrain(*scene, options.scene);
  if (!terrain) return tl::unexpected(terrain.error());
  if (auto loaded = load_squares(*scene, **terrain, *size); !loaded) return loaded;
  auto renderer = host::SceneRenderer::create(*scene, **terrain, *shaders);
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->set_vegetation(!options.no_plants);
  renderer->set_streaming(host::Streaming::wait);
  if (auto set = renderer->set_wind_overlay(options.wind_overlay); !set) return set;

  const View view = host::scene_view(*scene, **terrain, *size);
  const auto begin = std::chrono::steady_clock::now();
  target->begin();
  auto drawn =
      renderer->draw(view, make_lighting(*scene), options.time_s, target->framebuffer(), target->samples(), true);
  if (!drawn) return tl::unexpected(drawn.error());
  glFinish();
  const double frame_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (auto saved = save_picture(options.output, size->x, size->y, target->read_rgb()); !saved) return saved;
  if (options.stats.empty()) return {};
  const size_t plants = options.no_plants ? 0 : renderer->plants_cpu(view).size();
  return write_file(options.stats, stats_json(make_figures(*drawn, options.time_s, frame_ms, plants)));
}

}  // namespace

Command add_render(CLI::App& parent) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* app = parent.add_subcommand("render", "Draw one picture, without a display");
  add_scene_options(*app, options->scene, true);
  add_camera_option(*app, options->scene);
  add_sun_option(*app, options->scene);
  add_shaders_option(*app, options->scene);
  add_season_option(*app, options->scene);
  add_source_option(*app, options->scene);
  app->add_option("--size", options->size, "Pixels")
      ->type_name("WxH")
      ->check(as_check(parse_size))
      ->capture_default_str();
  app->add_option("--samples", options->samples, "Samples a pixel, or max")
      ->type_name("N|max")
      ->check(as_check(parse_samples))
      ->capture_default_str();
  app->add_option("--time", options->time_s, "Time of what moves")->type_name("SECONDS")->capture_default_str();
  app->add_flag("--no-plants", options->no_plants, "Terrain and sky alone");
  app->add_flag("--wind-overlay", options->wind_overlay, "Arrows of the wind over the ground");
  app->add_option("-o,--output", options->output, "Picture: .png, .ppm, ...")->type_name("FILE")->required();
  app->add_option("--stats", options->stats, "Figures of the frame as JSON")->type_name("FILE");
  return {app, [options] { return render(*options); }};
}

}  // namespace sward::tool
