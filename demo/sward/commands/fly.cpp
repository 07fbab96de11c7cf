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
#include "sward/commands/flight_options.h"
#include "sward/output/contact_sheet.h"
#include "sward/output/figures.h"
#include "sward/output/files.h"
#include "sward/output/paper_figures.h"
#include "sward/output/plot.h"
#include "sward/output/progress.h"
#include "sward/output/video.h"
#include "sward/scene_options.h"

namespace sward::tool {

namespace {

struct FlyOptions {
  SceneOptions scene;
  PathOptions path;
  std::string samples = "max", csv, summary, plots, video, sheet;
  int repeat = 1, sheet_frames = 12;
  bool no_plants = false, wait = false;
};

Expected<void> check(const FlyOptions& options) {
  auto samples = parse_samples(options.samples);
  if (!samples) return tl::unexpected(samples.error());
  if (*samples < 0) return fail("--samples must be 1 or more, or max");
  for (const std::string& path : {options.csv, options.summary, options.video})
    if (auto checked = check_output(path); !checked) return checked;
  if (!options.sheet.empty())
    if (auto checked = check_picture(options.sheet); !checked) return checked;
  if (!options.plots.empty())
    if (auto checked = check_output_folder(options.plots); !checked) return checked;
  if (!options.video.empty() && find_program("ffmpeg").empty())
    return fail("--video needs ffmpeg, which is not in PATH; install it or leave --video out");
  return check_path(options.path);
}

Expected<void> check_viewports(const std::vector<host::FlightFrame>& frames, glm::ivec2 size) {
  for (size_t i = 0; i < frames.size(); ++i) {
    const glm::ivec2 viewport = frames[i].view.viewport;
    if (viewport != size)
      return fail("frame " + std::to_string(i) + " of the flight has a viewport of " + std::to_string(viewport.x) +
                  "x" + std::to_string(viewport.y) + ", but pictures are " + std::to_string(size.x) + "x" +
                  std::to_string(size.y) + "; name that size with --size");
  }
  return {};
}

struct Flown {
  std::vector<FrameFigures> frames;
  glm::ivec2 size{0};
  int samples = 1;
};

// What one flight along the path is for.
struct Pass {
  std::string name = "flying";            // on the progress line
  bool pictures = false, plants = false;  // video and contact sheet
};

// What frames are shown in.
class Pictures {
 public:
  static Expected<Pictures> open(const FlyOptions& options, glm::ivec2 size, size_t frames) {
    Pictures pictures;
    pictures.sheet_path_ = options.sheet;
    if (!options.sheet.empty()) pictures.sheet_.emplace(size, frames, size_t(options.sheet_frames));
    if (options.video.empty()) return pictures;
    auto video = VideoPipe::open(options.video, size, options.path.fps);
    if (!video) return tl::unexpected(video.error());
    pictures.video_.emplace(std::move(*video));
    return pictures;
  }

  Expected<void> add(host::RenderTarget& target) {
    const bool shown = sheet_ && sheet_->wants_next();
    if (sheet_ && !shown) sheet_->skip();
    if (!shown && !video_) return {};
    const std::vector<uint8_t> rgb = target.read_rgb();
    if (shown) sheet_->add(rgb);
    return video_ ? video_->write(rgb) : Expected<void>();
  }

  Expected<void> finish() {
    if (sheet_)
      if (auto saved = sheet_->save(sheet_path_); !saved) return saved;
    return video_ ? video_->finish() : Expected<void>();
  }

 private:
  std::string sheet_path_;
  std::optional<ContactSheet> sheet_;
  std::optional<VideoPipe> video_;
};

// The first frame is drawn once before the clock runs: it builds the mesh from its roots and makes the driver compile,
// which no later frame does.
Expected<Flown> fly_frames(const FlyOptions& options, const Scene& scene, const std::vector<host::FlightFrame>& path,
                           host::RenderTarget& target, host::SceneRenderer& renderer, const Pass& pass) {
  Flown flown{{}, target.size(), target.samples()};
  std::optional<Pictures> pictures;
  if (pass.pictures) {
    auto opened = Pictures::open(options, target.size(), path.size());
    if (!opened) return tl::unexpected(opened.error());
    pictures.emplace(std::move(*opened));
  }
  const gl::Lighting lighting = make_lighting(scene);
  ProgressLine progress(pass.name);
  const auto draw = [&](const host::FlightFrame& frame) {
    target.begin();
    auto stats = renderer.draw(frame.view, lighting, frame.time_s, target.framebuffer(), target.samples(), true);
    glFinish();
    return stats;
  };
  if (auto warmed = draw(path.front()); !warmed) return tl::unexpected(warmed.error());
  for (const host::FlightFrame& frame : path) {
    std::vector<FrameFigures> drawn;
    size_t plants = 0;
    for (int i = 0; i < options.repeat; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      auto stats = draw(frame);
      const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
      if (!stats) return tl::unexpected(stats.error());
      if (pass.plants && i == 0) plants = renderer.plants_cpu(frame.view).size();
      drawn.push_back(make_figures(*stats, frame.time_s, spent.count(), plants));
    }
    flown.frames.push_back(median_figures(drawn));
    if (pictures)
      if (auto added = pictures->add(target); !added) return tl::unexpected(added.error());
    progress.show(float(flown.frames.size()) / float(path.size()));
  }
  if (pictures)
    if (auto finished = pictures->finish(); !finished) return tl::unexpected(finished.error());
  return flown;
}

// The further runs behind the paper's figures: without vegetation; with clusters of several sizes, not rasterised.
Expected<PaperRuns> fly_paper(const FlyOptions& options, const Scene& scene, const std::vector<host::FlightFrame>& path,
                              host::RenderTarget& target, host::SceneRenderer& renderer,
                              std::vector<FrameFigures> with) {
  PaperRuns runs{std::move(with), {}, {}};
  renderer.set_vegetation(false);
  auto without = fly_frames(options, scene, path, target, renderer,
                            {.name = "figure 7, without vegetation", .pictures = false, .plants = false});
  if (!without) return tl::unexpected(without.error());
  runs.without = std::move(without->frames);
  renderer.set_vegetation(true);
  if (!host::gpu_can_time()) {
    std::fprintf(stderr, "sward: warning: this driver cannot time the GPU; figure 9 is left out\n");
    return runs;
  }
  renderer.set_rasterisation(false);
  for (const int size : {1, 2, 4, 8, 16}) {
    for (size_t i = 0; i < scene.layers.size(); ++i) {
      Layer layer = scene.layers[i];
      layer.cluster_size = size;
      if (auto set = renderer.set_layer(i, layer); !set) return tl::unexpected(set.error());
    }
    auto flown =
        fly_frames(options, scene, path, target, renderer,
                   {.name = "figure 9, clusters of " + std::to_string(size), .pictures = false, .plants = false});
    if (!flown) return tl::unexpected(flown.error());
    runs.clusters.push_back({size, std::move(flown->frames)});
  }
  return runs;
}

std::string summary_text(const Flown& flown) {
  nlohmann::ordered_json json;
  json["frames"] = flown.frames.size();
  json["width"] = flown.size.x;
  json["height"] = flown.size.y;
  json["samples"] = flown.samples;
  json["gl_renderer"] = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  for (const FigureColumn& column : figure_columns())
    json[std::string(column.name)] = summary_json(flown.frames, column);
  return json.dump(2) + "\n";
}

void print_result(const Flown& flown) {
  std::vector<double> times;
  for (const FrameFigures& frame : flown.frames) times.push_back(*frame.frame_ms);
  const Summary summary = summarise(std::move(times));
  std::printf("%zu frames of %dx%d at %d samples: median %.2f ms, p95 %.2f ms, max %.2f ms\n", flown.frames.size(),
              flown.size.x, flown.size.y, flown.samples, summary.median, summary.p95, summary.max);
}

Expected<void> fly(FlyOptions options, bool size_given) {
  if (auto checked = check(options); !checked) return checked;
  auto scene = make_scene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  auto shaders = make_shaders(options.scene);
  if (!shaders) return tl::unexpected(shaders.error());
  if (auto checked = check_wait(*scene, options.wait); !checked) return checked;
  auto context = host::EglContext::create(false);
  if (!context) return tl::unexpected(context.error());
  auto samples = parse_samples(options.samples);
  auto size = parse_size(options.path.size);
  // Refuses more samples than the device has before the terrain is made.
  if (auto tried = host::RenderTarget::create({1, 1}, *samples); !tried) return tl::unexpected(tried.error());
  auto terrain = make_terrain(*scene, options.scene);
  if (!terrain) return tl::unexpected(terrain.error());
  if (!options.scene.camera.empty() && options.path.flight != "still")
    return fail("--camera is for --flight still; other flights have their own");
  auto path =
      options.path.flight == "still" ? make_still(options.path, *scene, **terrain) : make_path(options.path, **terrain);
  if (!path) return tl::unexpected(path.error());
  if (!size_given) *size = path->front().view.viewport;
  if (auto checked = check_viewports(*path, *size); !checked) return checked;
  auto target = host::RenderTarget::create(*size, *samples);
  if (!target) return tl::unexpected(target.error());
  auto renderer = host::SceneRenderer::create(*scene, **terrain, *shaders);
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->set_vegetation(!options.no_plants);
  if (options.wait) renderer->set_streaming(host::Streaming::wait);

  const Pass first{.name = "flying", .pictures = true, .plants = !options.no_plants};
  auto flown = fly_frames(options, *scene, *path, *target, *renderer, first);
  if (!flown) return tl::unexpected(flown.error());
  if (!options.csv.empty())
    if (auto written = write_file(options.csv, figures_csv(flown->frames)); !written) return written;
  if (!options.summary.empty())
    if (auto written = write_file(options.summary, summary_text(*flown)); !written) return written;
  if (!options.plots.empty())
    if (auto written = write_plots(options.plots, flown->frames); !written) return written;
  if (!options.plots.empty() && options.path.flight == "paper" && !options.no_plants) {
    auto runs = fly_paper(options, *scene, *path, *target, *renderer, flown->frames);
    if (!runs) return tl::unexpected(runs.error());
    if (auto written = write_paper_figures(options.plots, *runs); !written) return written;
  }
  print_result(*flown);
  return {};
}

}  // namespace

Command add_fly(CLI::App& parent) {
  auto options = std::make_shared<FlyOptions>();
  CLI::App* app = parent.add_subcommand("fly", "Fly a camera path without a display and measure every frame");
  app->footer(
      "frame_ms runs from the first call to the GPU's last, with nothing of the next frame overlapped. The first\n"
      "frame is drawn once before the clock runs. plants are counted outside of the clock.");
  add_scene_options(*app, options->scene, true);
  add_source_option(*app, options->scene);
  add_camera_option(*app, options->scene);
  add_sun_option(*app, options->scene);
  add_shaders_option(*app, options->scene);
  add_path_options(*app, options->path);
  CLI::Option* size = app->add_option("--size", options->path.size, "Pixels")
                          ->type_name("WxH")
                          ->check(as_check(parse_size))
                          ->capture_default_str();
  app->add_option("--samples", options->samples, "Samples a pixel, or max")
      ->type_name("N|max")
      ->check(as_check(parse_samples))
      ->capture_default_str();
  app->add_option("--repeat", options->repeat,
                  "Draw every frame so many times and take each figure's median: steadier where a GPU lowers its clock "
                  "between frames")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_wait_option(*app, options->wait);
  app->add_flag("--no-plants", options->no_plants, "Terrain and sky alone");
  app->add_option("--csv", options->csv, "One row of figures a frame")->type_name("FILE");
  app->add_option("--summary", options->summary, "Median, mean, p95, p99, max of every figure as JSON")
      ->type_name("FILE");
  app->add_option(
         "--plots", options->plots,
         "Folder for line plots (SVG); of the paper flight also its figures 7 to 9, which take six more flights")
      ->type_name("DIR");
  app->add_option("--video", options->video, "Video through ffmpeg")->type_name("FILE.mp4");
  app->add_option("--sheet", options->sheet, "Contact sheet: some of the frames side by side")->type_name("FILE");
  app->add_option("--sheet-frames", options->sheet_frames, "How many")
      ->type_name("N")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  return {app, [options, size] { return fly(*options, size->count() > 0); }};
}

}  // namespace sward::tool
