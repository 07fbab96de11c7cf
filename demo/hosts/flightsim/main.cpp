// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// A flight simulator over sward's ground, as a host of its own: a light aeroplane takes off from a grass strip, flies a
// circuit over a streamed world and lands again. Its wheels stand on the ground that sward answers with; what the pilot
// saw is recorded as a flight that `sward fly` replays, and drawn at some moments.

#include <sward/image_io/image_io.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "flightsim/place.h"
#include "flightsim/simulation.h"
#include "host/egl_context.h"
#include "host/render_target.h"
#include "host/scene_renderer.h"

namespace {

using flightsim::Flight;
using flightsim::Pilot;
using sward::Expected;

struct Options {
  std::string folder;
  bool pictures = false;
  int fps = 60;
  glm::ivec2 size{960, 540};
  double seconds = 400;
};

sward::Progress progress_of(const char* what) {
  return [what](float done) {
    std::fprintf(stderr, "\rflightsim: %s %3.0f %%", what, double(100 * done));
    if (done >= 1) std::fputc('\n', stderr);
  };
}

void print(const flightsim::Report& report, const flightsim::Strip& strip) {
  std::printf("took off after %.1f s\n", report.take_off_s);
  std::printf("circuit: at least %.0f m above the ground\n", report.lowest_m);
  std::printf("touched down after %.1f s, %.0f m along the strip, %.1f m beside its middle, sinking %.2f m/s\n",
              report.landing_s, report.touch_down.x, report.touch_down.y, report.touch_down_m_s);
  std::printf("stands after %.1f s, %.0f m of %.0f m along, %.1f m beside the middle\n", report.stopped_s,
              report.stopped.x, strip.length_m, report.stopped.y);
  std::printf("deepest press of a wheel: %.2f m\n", report.deepest_wheel_m);
}

// A second into each phase, and where it stands in the end.
std::vector<size_t> moments(const Flight& flight, int fps) {
  std::vector<size_t> all;
  for (size_t i = 1; i < flight.frames.size(); ++i)
    if (i == 1 || flight.frames[i].phase != flight.frames[i - 1].phase)
      all.push_back(std::min(i + size_t(fps), flight.frames.size() - 1));
  all.push_back(flight.frames.size() - 1);
  return all;
}

Expected<void> draw(const sward::Scene& scene, const sward::host::SceneTerrain& terrain, const Flight& flight,
                    const Options& options) {
  auto context = sward::host::EglContext::create(false);
  if (!context) return tl::unexpected(context.error());
  auto target = sward::host::RenderTarget::create(options.size, 4);
  if (!target) return tl::unexpected(target.error());
  auto renderer = sward::host::SceneRenderer::create(scene, terrain, sward::gl::ShaderLibrary());
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->set_streaming(sward::host::Streaming::wait);
  const auto light = sward::gl::Lighting::clear_day(scene.sun_azimuth, scene.sun_elevation);
  for (const size_t i : moments(flight, options.fps)) {
    target->begin();
    const flightsim::Frame& frame = flight.frames[i];
    auto drawn = renderer->draw(frame.view, light, frame.time_s, target->framebuffer(), target->samples(), false);
    if (!drawn) return tl::unexpected(drawn.error());
    char name[64];
    std::snprintf(name, sizeof name, "/frame_%05zu.jpg", i);
    auto saved = sward::save_image(options.folder + name, options.size.x, options.size.y, target->read_rgb());
    if (!saved) return saved;
  }
  return {};
}

Expected<int> run(const Options& options) {
  if (auto made = flightsim::make_place(options.folder, progress_of("making the place")); !made)
    return tl::unexpected(made.error());
  auto scene = sward::load_scene(options.folder + "/strip.toml");
  if (!scene) return tl::unexpected(scene.error());
  auto terrain = sward::host::load_terrain(*scene, true);
  if (!terrain) return tl::unexpected(terrain.error());
  if (auto there = sward::host::load_first_view(*scene, **terrain, options.size); !there)
    return tl::unexpected(there.error());
  const flightsim::Strip strip = flightsim::strip_of((*terrain)->surface());
  auto flight =
      flightsim::fly_circuit(**terrain, strip, options.fps, options.size, options.seconds, progress_of("flying"));
  if (!flight) return tl::unexpected(flight.error());
  std::fputc('\n', stderr);
  if (auto saved = flightsim::save_flight(options.folder + "/flight.csv", flight->frames); !saved)
    return tl::unexpected(saved.error());
  print(flight->report, strip);
  if (options.pictures)
    if (auto drawn = draw(*scene, **terrain, *flight, options); !drawn) return tl::unexpected(drawn.error());
  if (flight->report.crashed) return sward::fail("the aircraft has crashed");
  if (!flight->report.arrived) return sward::fail("the aircraft does not stand yet; give it more --seconds");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Takes off from a grass strip, flies a circuit over a streamed world and lands; writes flight.csv");
  app.add_option("folder", options.folder, "Where the place, the flight and the pictures are written")->required();
  app.add_flag("--pictures", options.pictures, "A picture of each phase, from the pilot's eye");
  app.add_option("--fps", options.fps, "Frames a second of the flight")
      ->check(CLI::IsMember({30, 60, 120, 240}))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Longest flight")->check(CLI::Range(1.0, 3600.0))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  auto done = run(options);
  if (done) return 0;
  std::fprintf(stderr, "flightsim: error: %s\n", done.error().message.c_str());
  return 1;
}
