// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How far pictures are from those with everything at full detail: FLIP on three paths of 300 frames at 1.5 m/s,
// 1280 x 720, wind still, as level of detail is and plain. Every tenth frame is compared. Needs a fast GPU.
//   bench_images [FRAMES BETWEEN] [FOLDER for the worst frames' pictures, PPM]
#include <sward/scene/scene.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "flip.h"
#include "host/egl_context.h"
#include "host/render_target.h"
#include "host/scene_renderer.h"
#include "popping.h"

namespace sward {
namespace {

constexpr glm::ivec2 k_size = popping::k_viewport;
constexpr int k_frames = 300;

const char* const k_scene = R"(
name = "full detail"
[terrain]
generator = "meadow"
samples = 257
size_m = 1024.0
[[layer]]
name = "grass"
horizon_m = 60.0
density = 300.0
[[layer.species]]
name = "meadow_grass"
hsv = [77.0, 0.46, 0.43]
weights = [3.0, 1.0, 0.3]
height_m = [0.16, 0.38]
width_m = [0.004, 0.008]
[[layer.species]]
name = "straw_grass"
hsv = [48.0, 0.42, 0.58]
weights = [3.0, 1.0, 0.5]
height_m = [0.25, 0.55]
width_m = [0.003, 0.006]
)";

template <class T>
T need(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "bench_images: %s\n", value.error().message.c_str());
  std::exit(1);
}

Scene scene_of(const std::function<void(Layer&)>& change) {
  Scene scene = need(parse_scene(k_scene, "full detail"));
  for (Layer& layer : scene.layers) change(layer);
  return scene;
}

struct Way {
  host::SceneRenderer renderer;
  std::vector<uint8_t> picture;
  flip::Seen seen;
};

void save(const std::string& path, std::span<const uint8_t> rgb) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << k_size.x << " " << k_size.y << "\n255\n";
  file.write(reinterpret_cast<const char*>(rgb.data()), std::streamsize(rgb.size()));
}

struct Summary {
  double mean, p99, worst;
};
Summary summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  const double place = 0.99 * double(values.size() - 1);
  const size_t below = size_t(place), above = std::min(below + 1, values.size() - 1);
  return {sum / double(values.size()), std::lerp(values[below], values[above], place - double(below)), values.back()};
}

int run(int between, const std::string& folder) {
  auto context = need(host::EglContext::create(false));
  const Scene scene = scene_of([](Layer&) {});
  const Scene plain = scene_of([](Layer& layer) { layer.plain = true; });
  const Scene full = scene_of([](Layer& layer) {
    layer.full_distance_m = 10 * layer.horizon_m;
    layer.full_segments_m = 10 * layer.horizon_m;
  });
  const auto terrain = need(host::load_terrain(scene, true));
  const gl::ShaderLibrary shaders;
  std::array<Way, 3> ways{{{need(host::SceneRenderer::create(scene, *terrain, shaders)), {}, {}},
                           {need(host::SceneRenderer::create(plain, *terrain, shaders)), {}, {}},
                           {need(host::SceneRenderer::create(full, *terrain, shaders)), {}, {}}}};
  auto target = need(host::RenderTarget::create(k_size, std::min(8, host::RenderTarget::max_samples())));
  const gl::Lighting lighting = gl::Lighting::clear_day(scene.sun_azimuth, scene.sun_elevation);
  std::printf("FLIP against full detail, every %d. of %d frames, %d samples, %s\n", between, k_frames, target.samples(),
              reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  std::puts("| path | mean | p99 | worst | plain, mean | p99 | worst | ratio of means | of p99 |");
  std::puts("|---|---|---|---|---|---|---|---|---|");
  for (int path = 0; path < 3; ++path) {
    std::array<std::vector<double>, 2> differences;
    double worst = 0;
    for (int at = 0; at < k_frames; at += between) {
      const View view =
          popping::walk_over([&](glm::dvec2 at_xy) { return terrain->surface().height(at_xy); }, path, at);
      for (Way& way : ways) {
        target.begin();
        // Twice: the mesh of the first picture may still be moving to its place.
        for (int i = 0; i < 2; ++i) {
          target.begin();
          need(way.renderer.draw(view, lighting, 1000.0 * path + at + i, target.framebuffer(), target.samples(), true));
        }
        way.picture = target.read_rgb();
      }
      {
        std::vector<std::jthread> threads;
        for (Way& way : ways) threads.emplace_back([&way] { way.seen = flip::see(way.picture, k_size); });
      }
      for (size_t i = 0; i < 2; ++i) differences[i].push_back(flip::difference(ways[i].seen, ways[2].seen));
      if (folder.empty() || differences[0].back() <= worst) continue;
      worst = differences[0].back();
      for (size_t i = 0; i < 3; ++i)
        save(folder + "/path" + std::to_string(path) + "_" + std::array{"ours", "plain", "full"}[i] + ".ppm",
             ways[i].picture);
    }
    const Summary ours = summarise(differences[0]), theirs = summarise(differences[1]);
    std::printf("| %d | %.4f | %.4f | %.4f | %.4f | %.4f | %.4f | %.2f | %.2f |\n", path, ours.mean, ours.p99,
                ours.worst, theirs.mean, theirs.p99, theirs.worst, theirs.mean / ours.mean, theirs.p99 / ours.p99);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace sward

int main(int argc, char** argv) {
  return sward::run(argc > 1 ? std::max(std::atoi(argv[1]), 1) : 10, argc > 2 ? argv[2] : "");
}
