// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/commands/flight_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <limits>

#include "sward/arguments.h"

namespace sward::tool {

namespace {

constexpr double k_still_s = 4;

}  // namespace

void add_path_options(CLI::App& app, PathOptions& options) {
  app.add_option(
         "--flight", options.flight,
         "Camera path: a built-in one, or a CSV file with one row a frame; still (fly alone): the scene's camera, 4 s")
      ->type_name("paper|still|FILE.csv")
      ->capture_default_str();
  app.add_option("--from", options.from_s, "Leave out so much of the path; the paper's flight is low from 10 to 20")
      ->type_name("SECONDS")
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Only so much of the path")->type_name("SECONDS");
  app.add_option("--fps", options.fps, "Frames a second of paths without times")->type_name("N")->capture_default_str();
}

Expected<void> check_path(const PathOptions& options) {
  if (!(options.fps > 0 && options.fps <= 10000)) return fail("--fps must be above 0 and at most 10000");
  if (options.seconds && !(*options.seconds > 0 && std::isfinite(*options.seconds)))
    return fail("--seconds must be a finite number above 0");
  if (!(options.from_s >= 0 && std::isfinite(options.from_s)))
    return fail("--from must be a finite number of 0 or more");
  if (options.flight == "paper" && (options.from_s >= host::k_paper_flight_s ||
                                    options.from_s + options.seconds.value_or(0) > host::k_paper_flight_s))
    return fail("the paper flight is 30 s long; --from and --seconds together must be at most 30");
  std::error_code ignored;
  if (options.flight == "still" && options.seconds.value_or(k_still_s) * options.fps > 1e6)
    return fail("--seconds times --fps must be at most a million frames");
  if (options.flight != "paper" && options.flight != "still" &&
      !std::filesystem::is_regular_file(options.flight, ignored))
    return fail(options.flight +
                ": there is no such flight; name a CSV file or one that is built in, \"paper\" or, for fly, \"still\"");
  auto size = parse_size(options.size);
  return size ? check_size(*size) : tl::unexpected(size.error());
}

Expected<std::vector<host::FlightFrame>> make_path(const PathOptions& options, const host::SceneTerrain& terrain) {
  if (options.flight == "still") return fail("--flight still is for fly; this command needs a camera that moves");
  if (options.flight == "paper" && terrain.world() != nullptr)
    return fail(
        "over a world the flight comes from a file (--flight FILE.csv): the built-in one follows ground that is "
        "all there");
  auto size = parse_size(options.size);
  if (!size) return tl::unexpected(size.error());
  host::FlightOptions path;
  path.fps = options.fps;
  path.viewport = *size;
  path.near_plane = host::k_near_plane_m;
  path.far_plane = host::far_plane_m(terrain.surface());
  auto frames = options.flight == "paper" ? host::paper_flight(terrain.surface(), host::k_paper_flight_s, path)
                                          : host::load_flight(options.flight, path);
  if (!frames) return frames;
  // Times of frames are sums of 1/fps: half a millisecond is no frame.
  const double begin = frames->front().time_s + options.from_s - 0.0005;
  const double end = options.seconds ? begin + *options.seconds : std::numeric_limits<double>::infinity();
  std::erase_if(*frames, [=](const host::FlightFrame& f) { return f.time_s < begin || f.time_s >= end; });
  if (frames->empty()) return fail("no frame of the flight is left; lower --from or raise --seconds");
  return frames;
}

Expected<std::vector<host::FlightFrame>> make_still(const PathOptions& options, const Scene& scene,
                                                    const host::SceneTerrain& terrain) {
  auto size = parse_size(options.size);
  if (!size) return tl::unexpected(size.error());
  const View view = host::scene_view(scene, terrain, *size);
  const int count = std::max(int(std::lround(options.seconds.value_or(k_still_s) * options.fps)), 1);
  std::vector<host::FlightFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back({options.from_s + i / options.fps, view});
  return frames;
}

Expected<void> check_frame(size_t at, const std::vector<host::FlightFrame>& path) {
  if (at < path.size()) return {};
  return fail("--at " + std::to_string(at) + ": the flight has frames 0 to " + std::to_string(path.size() - 1));
}

}  // namespace sward::tool
