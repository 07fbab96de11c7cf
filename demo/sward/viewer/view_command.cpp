// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <CLI/CLI.hpp>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "sward/arguments.h"
#include "sward/commands/commands.h"
#include "sward/scene_options.h"
#include "sward/viewer/file_watch.h"
#include "sward/viewer/panel.h"
#include "sward/viewer/play.h"
#include "sward/viewer/window.h"

namespace sward::tool {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int k_many_samples = 32;  // GLFW takes the nearest that the display has

struct ViewOptions {
  SceneOptions scene;
  std::string size = "1280x720", samples = "4";
  std::optional<int> frames;
  bool watch = false;
};

WalkCamera start_camera(const Scene& scene, const host::SceneTerrain& terrain) {
  WalkCamera camera;
  camera.position = host::scene_view(scene, terrain, {1, 1}).eye;
  camera.yaw = scene.camera_yaw;
  camera.pitch = scene.camera_pitch;
  camera.fov_y = scene.fov_y;
  camera.walking = scene.camera_above_ground && scene.camera.z < 10;
  if (camera.walking) camera.eye_height_m = scene.camera.z;
  return camera;
}

PanelState start_panel(const Scene& scene) {
  PanelState state;
  state.sun_azimuth_degrees = glm::degrees(scene.sun_azimuth);
  state.sun_elevation_degrees = glm::degrees(scene.sun_elevation);
  state.haze_distance_m = scene.haze_distance_m;
  state.season = scene.season;
  state.ground_seasons = scene.ground_seasons;
  state.has_mesh = scene.source == TerrainSource::roam;
  state.max_triangles = int(scene.max_triangles);
  state.target_px = scene.target_px;
  if (scene.wind)
    state.weather = scene.wind->weather;
  else
    state.weather.ambient_m_s = 0;
  state.layers = scene.layers;
  state.layer_changed.assign(scene.layers.size(), false);
  return state;
}

// Layers are applied when the mouse lets go: each change compiles programs.
void apply_panel(PanelState& state, host::SceneRenderer& renderer) {
  renderer.set_vegetation(state.vegetation);
  if (auto shown = renderer.set_wind_overlay(state.wind_arrows); !shown) state.message = shown.error().message;
  if (std::exchange(state.weather_changed, false)) {
    auto set = renderer.wind().set_weather(state.weather);
    state.message = set ? "" : set.error().message;
  }
  renderer.set_season(state.season);
  for (Layer& layer : state.layers) layer.season = state.season;
  if (state.budget_changed) {
    RoamOptions roam = renderer.mesh().options();
    roam.max_triangles = uint32_t(state.max_triangles);
    roam.target_px = state.target_px;
    auto set = renderer.mesh().set_options(roam);
    state.message = set ? "" : set.error().message;
    state.budget_changed = false;
  }
  if (ImGui::IsAnyItemActive()) return;
  for (size_t i = 0; i < state.layers.size(); ++i) {
    if (!state.layer_changed[i]) continue;
    auto set = renderer.set_layer(i, state.layers[i]);
    state.message = set ? "" : set.error().message;
    state.layer_changed[i] = false;
  }
}

gl::Lighting panel_lighting(const PanelState& state) {
  gl::Lighting lighting =
      gl::Lighting::clear_day(glm::radians(state.sun_azimuth_degrees), glm::radians(state.sun_elevation_degrees));
  lighting.haze_distance_m = state.haze_distance_m;
  lighting.ground_tint = ground_tint(state.ground_seasons, state.season);
  return lighting;
}

void begin_picture(glm::ivec2 size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size.x, size.y);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// What is on the screen. The renderer goes before the ground that it draws.
struct Shown {
  Scene scene;
  std::unique_ptr<host::SceneTerrain> terrain;
  std::optional<host::SceneRenderer> renderer;
  PanelState panel;
  Play play;
  Clock::time_point since = Clock::now();  // the scene's time 0
};

class ScenePlayground final : public Playground {
 public:
  explicit ScenePlayground(Shown& shown) : shown_(&shown) {}
  const Surface& ground() const override { return shown_->terrain->surface(); }
  Wind& wind() override { return shown_->renderer->wind(); }
  Disturbance& disturbance() override { return shown_->renderer->disturbance(); }

 private:
  Shown* shown_;
};

PlayInput play_input(Window& window) {
  const bool typing = ImGui::GetIO().WantCaptureKeyboard;
  const auto pressed = [&](int key) { return window.pressed_once(key) && !typing; };
  PlayInput input;
  input.cut = pressed(GLFW_KEY_C);
  input.burn = pressed(GLFW_KEY_X);
  input.explode = pressed(GLFW_KEY_Z);
  input.regrow = pressed(GLFW_KEY_T);
  input.gust = pressed(GLFW_KEY_G);
  input.whirlwind = pressed(GLFW_KEY_H);
  input.rotor = pressed(GLFW_KEY_R);
  input.ball = pressed(GLFW_KEY_B);
  return input;
}

std::vector<std::string> watched_files(const ViewOptions& options) {
  if (!options.watch) return {};
  return {options.scene.scene, options.scene.shaders};
}

Expected<host::SceneSource> read_source(const SceneOptions& options) {
  auto scene = make_scene(options);
  if (!scene) return tl::unexpected(scene.error());
  auto terrain = make_terrain(*scene, options);
  if (!terrain) return tl::unexpected(terrain.error());
  return host::SceneSource{std::move(*scene), std::move(*terrain)};
}

// Scene and shaders as their files are now, made ready beside the drawing. What is wrong with them is told, and the
// picture stays.
class Reloader {
 public:
  Reloader(const ViewOptions& options, host::SceneLoader::Context context)
      : options_(options), loader_(std::move(context)), watch_(watched_files(options)) {}

  // Once a frame; `asked`: by a key.
  void follow(bool asked, Shown& shown) {
    const bool changed = watch_.changed();
    wanted_ = wanted_ || asked || changed;
    if (wanted_ && !loader_.busy()) start(shown);
    if (auto loaded = loader_.take()) finish(std::move(*loaded), shown);
  }

 private:
  void tell(const std::string& text, Shown& shown) {
    shown.panel.message = text;
    std::fprintf(stderr, "sward: %s\n", text.c_str());
  }

  void start(Shown& shown) {
    wanted_ = false;
    shown.panel.message = "reloading";
    begun_ = Clock::now();
    loader_.start([scene = options_.scene] { return read_source(scene); }, gl::ShaderLibrary(options_.scene.shaders));
  }

  void finish(Expected<host::LoadedScene> loaded, Shown& shown) {
    if (!loaded) return tell("not reloaded: " + loaded.error().message, shown);
    const Clock::time_point taken = Clock::now();
    auto renderer = host::SceneRenderer::create(loaded->source.scene, *loaded->source.terrain,
                                                std::move(loaded->ground), loaded->shaders);
    if (!renderer) return tell("not reloaded: " + renderer.error().message, shown);
    shown.renderer = std::move(*renderer);
    shown.terrain = std::move(loaded->source.terrain);
    shown.scene = std::move(loaded->source.scene);
    shown.panel = start_panel(shown.scene);
    shown.play = Play();
    shown.since = Clock::now();
    const auto ms = [](Clock::time_point from, Clock::time_point to) {
      return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(to - from).count()) + " ms";
    };
    tell("reloaded: " + ms(begun_, taken) + " beside the drawing, " + ms(taken, Clock::now()) + " between two frames",
         shown);
  }

  ViewOptions options_;
  host::SceneLoader loader_;
  FileWatch watch_;
  bool wanted_ = false;
  Clock::time_point begun_;
};

Expected<void> run_window(Window& window, const ViewOptions& options, Reloader& reloader, Shown& shown) {
  WalkCamera camera = start_camera(shown.scene, *shown.terrain);
  host::SceneFrameStats stats;
  Clock::time_point last = shown.since;
  for (int frame = 0; !window.closing() && frame < options.frames.value_or(frame + 1); ++frame) {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    window.begin_frame();
    reloader.follow(window.pressed_once(GLFW_KEY_F5), shown);
    if (window.pressed_once(GLFW_KEY_F) && !ImGui::GetIO().WantCaptureKeyboard) camera.walking = !camera.walking;
    camera.move(window.camera_input(), std::min(seconds, 0.1), shown.terrain->surface());
    if (window.pressed_once(GLFW_KEY_V) && !ImGui::GetIO().WantCaptureKeyboard)
      shown.panel.wind_arrows = !shown.panel.wind_arrows;
    draw_panel(shown.panel, camera, stats, seconds * 1000);
    apply_panel(shown.panel, *shown.renderer);
    ScenePlayground place(shown);
    auto played = shown.play.follow(play_input(window), camera, std::min(seconds, 0.1), place);
    if (!played) shown.panel.message = played.error().message;
    if (auto set = shown.renderer->set_balls(shown.play.balls()); !set) shown.panel.message = set.error().message;

    const glm::ivec2 size = window.framebuffer_size();
    if (size.x > 0 && size.y > 0) {
      begin_picture(size);
      const double time_s = std::max(std::chrono::duration<double>(now - shown.since).count(), 0.0);
      auto drawn = shown.renderer->draw(camera.view(size, shown.terrain->surface()), panel_lighting(shown.panel),
                                        time_s, 0, window.samples(), false);
      if (!drawn) return tl::unexpected(drawn.error());
      stats = *drawn;
    }
    window.end_frame();
  }
  return {};
}

Expected<void> view(const ViewOptions& options) {
  auto size = parse_size(options.size);
  auto samples = parse_samples(options.samples);
  if (auto checked = check_size(*size); !checked) return checked;
  if (*samples < 0) return fail("--samples must be 1 or more, or max");
  auto scene = make_scene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  auto shaders = make_shaders(options.scene);
  if (!shaders) return tl::unexpected(shaders.error());
  std::error_code ignored;
  if (options.watch && options.scene.shaders.empty() && !std::filesystem::is_regular_file(options.scene.scene, ignored))
    return fail("--watch needs a file to watch: name a scene file, or a folder of shaders with --shaders");
  auto window = Window::open("sward - " + scene->name, *size, *samples == 0 ? k_many_samples : *samples);
  if (!window) return tl::unexpected(window.error());
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  if (*samples > most)
    return fail("--samples " + std::to_string(*samples) + ": this device has at most " + std::to_string(most));
  auto context = window->make_loader_context();
  if (!context) return tl::unexpected(context.error());
  auto terrain = make_terrain(*scene, options.scene);
  if (!terrain) return tl::unexpected(terrain.error());
  auto renderer = host::SceneRenderer::create(*scene, **terrain, *shaders);
  if (!renderer) return tl::unexpected(renderer.error());
  PanelState panel = start_panel(*scene);
  Shown shown{std::move(*scene), std::move(*terrain), std::move(*renderer), std::move(panel), {}, Clock::now()};
  Reloader reloader(options, std::move(*context));
  return run_window(*window, options, reloader, shown);
}

}  // namespace

Command add_view(CLI::App& parent) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* app = parent.add_subcommand("view", "Walk and fly through a scene in a window");
  add_scene_options(*app, options->scene, true);
  add_source_option(*app, options->scene);
  add_camera_option(*app, options->scene);
  add_sun_option(*app, options->scene);
  add_shaders_option(*app, options->scene);
  add_season_option(*app, options->scene);
  app->add_option("--size", options->size, "Pixels")
      ->type_name("WxH")
      ->check(as_check(parse_size))
      ->capture_default_str();
  app->add_option("--samples", options->samples, "Samples a pixel")
      ->type_name("N|max")
      ->check(as_check(parse_samples))
      ->capture_default_str();
  app->add_flag(
      "--watch", options->watch,
      "Reload when the scene's file or one in --shaders is written, as F5 does: all but the camera begins anew");
  app->add_option("--frames", options->frames, "Close after so many frames")->type_name("N");
  return {app, [options] { return view(*options); }};
}

}  // namespace sward::tool
