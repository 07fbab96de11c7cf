// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// One table about the mesh: plain against deferred in one process, a still camera, sizes of the data, many triangles,
// slots written, bounds on threads, several views at once, objects named by the host. An update includes copying
// changed vertices and triangles into arrays, as for an upload. Frames are the minimum of three runs, in CPU time of
// the thread.
//   bench_mesh [plain] [sizes] [million] [bounds] [views] [named]      (nothing: all; sizes needs 3 GB)
#include <sward/terrain/many_views.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "flight.h"

namespace {

constexpr int k_runs = 3, k_warm = 10;

// Copies what changed into place, as a renderer's buffers get it.
struct Slots {
  std::vector<sward::RoamVertex> vertices;
  std::vector<uint32_t> indices;

  size_t write(const sward::RoamMesh& mesh) {
    vertices.resize(mesh.vertices().size());
    indices.resize(mesh.visible_indices().size());
    for (const uint32_t slot : mesh.changed_vertices()) vertices[slot] = mesh.vertices()[slot];
    for (const uint32_t triangle : mesh.changed_triangles())
      if (3 * size_t(triangle) < indices.size())
        std::copy_n(mesh.visible_indices().begin() + 3 * size_t(triangle), 3, indices.begin() + 3 * size_t(triangle));
    return mesh.changed_triangles().size();
  }
};

struct Flown {
  std::vector<double> ms;  // by frame
  double changes = 0, written = 0, still_ms = 0;
  uint32_t still_changes = 0, visible = 0;
};

Flown fly(const roam_support::Terrain& terrain, const sward::RoamOptions& options, int frames, int runs) {
  Flown flown;
  flown.ms.assign(size_t(frames), 1e9);
  for (int run = 0; run < runs; ++run) {
    auto mesh = sward::RoamMesh::create(*terrain.bounds, options);
    Slots slots;
    flown.changes = flown.written = 0;
    for (int frame = -k_warm; frame < frames; ++frame) {
      const sward::View view = flight::low_view(frame + k_warm, *terrain.field);
      const double start = flight::thread_ms();
      const auto stats = mesh->update(view, frame / 60.0);
      const size_t written = slots.write(*mesh);
      const double took = flight::thread_ms() - start;
      if (frame < 0) continue;
      flown.ms[size_t(frame)] = std::min(flown.ms[size_t(frame)], took);
      flown.changes += (stats->splits + stats->merges) / double(frames);
      flown.written += double(written) / double(stats->visible) / frames;
      flown.visible = stats->visible;
    }
    const sward::View last = flight::low_view(frames + k_warm - 1, *terrain.field);
    for (int k = 0; k < 60; ++k) (void)mesh->update(last, (frames + k) / 60.0);
    const double start = flight::thread_ms();
    flown.still_changes = 0;
    for (int k = 60; k < 160; ++k) {
      const auto stats = mesh->update(last, (frames + k) / 60.0);
      slots.write(*mesh);
      flown.still_changes += stats->splits + stats->merges;
    }
    flown.still_ms = (flight::thread_ms() - start) / 100;
  }
  return flown;
}

void print(const char* name, const Flown& flown) {
  std::vector<double> sorted = flown.ms;
  std::sort(sorted.begin(), sorted.end());
  const double mean = flight::mean(sorted), high = sorted[size_t(0.995 * double(sorted.size() - 1))];
  std::printf("| %-28s | %8u | %8.3f | %5.2f | %8.1f | %8.0f | %7.4f | %8.5f | %3u |\n", name, flown.visible, mean,
              high / mean, flown.changes, 1e6 * mean / flown.changes, flown.written, flown.still_ms / mean,
              flown.still_changes);
  std::fflush(stdout);
}

roam_support::Terrain generated(int side, double spacing) {
  roam_support::TerrainOptions options;
  options.columns = options.rows = side;
  options.spacing = spacing;
  options.relief_m = 350;
  options.octaves = 10;
  options.wavelength = 3500 / spacing;
  return roam_support::make_terrain(options);
}

sward::RoamOptions budget(uint32_t triangles, bool plain = false) {
  sward::RoamOptions options;
  options.max_triangles = triangles;
  options.plain = plain;
  return options;
}

void plain_and_deferred() {
  const Flown plain = fly(flight::terrain(), budget(50000, true), 300, k_runs);
  const Flown deferred = fly(flight::terrain(), budget(50000), 300, k_runs);
  print("plain, 50 000", plain);
  print("deferred, 50 000", deferred);
  std::printf("plain / deferred: %.1f\n", flight::mean(plain.ms) / flight::mean(deferred.ms));
}

// More data in two ways: more ground at the same spacing, and finer data over the same ground, which is more to show
// near the eye, so that more changes.
void sizes() {
  constexpr int k_small = 1025, k_large = 16385;
  const Flown small = fly(generated(k_small, 5), budget(50000), 300, k_runs);
  const Flown wide = fly(generated(k_large, 5), budget(50000), 300, k_runs);
  print("1025 x 1025 at 5 m", small);
  print("16385 x 16385 at 5 m", wide);
  const Flown coarse = fly(generated(k_small, 20), budget(50000), 300, k_runs);
  const Flown fine = fly(generated(k_large, 1.25), budget(50000), 300, k_runs);
  print("1025 x 1025 at 20 m", coarse);
  print("16385 x 16385 at 1.25 m", fine);
  std::printf("16385 / 1025: %.2f at the same spacing, %.2f over the same ground\n",
              flight::mean(wide.ms) / flight::mean(small.ms), flight::mean(fine.ms) / flight::mean(coarse.ms));
}

void bounds_on_threads() {
  double best[2] = {1e9, 1e9};
  for (int run = 0; run < k_runs; ++run) {
    for (const int threads : {1, 2}) {
      const auto start = std::chrono::steady_clock::now();
      (void)sward::Bounds::create(*flight::terrain().field, threads);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best[threads - 1] = std::min(best[threads - 1], took.count());
    }
  }
  std::printf("bounds of 4097 x 4097: one thread %.3f s, two %.3f s, ratio %.2f\n", best[0], best[1],
              best[0] / best[1]);
}

// Eight cameras of 20 000 triangles each, seconds of the wall.
void several_views() {
  double ms[2] = {1e9, 1e9};
  for (int run = 0; run < k_runs; ++run) {
    for (const int threads : {1, 2}) {
      std::vector<sward::RoamMesh> meshes;
      for (int i = 0; i < 8; ++i)
        meshes.push_back(sward::RoamMesh::create(*flight::terrain().bounds, budget(20000)).value());
      std::vector<sward::MeshUpdate> updates(8);
      double spent = 0;
      for (int frame = 0; frame < 100; ++frame) {
        for (size_t i = 0; i < 8; ++i) {
          updates[i].mesh = &meshes[i];
          updates[i].view = flight::low_view(frame + 60 * int(i));
          updates[i].time_s = frame / 60.0;
        }
        const auto start = std::chrono::steady_clock::now();
        sward::update_all(updates, threads);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        if (frame >= k_warm) spent += took.count() / (100 - k_warm);
      }
      ms[threads - 1] = std::min(ms[threads - 1], spent);
    }
  }
  std::printf("eight views of 20 000: one thread %.2f ms, two %.2f ms, ratio %.2f\n", ms[0], ms[1], ms[0] / ms[1]);
}

struct Object {
  glm::dvec2 start, velocity;
};

// From 50 m to 4 km ahead of where the flight begins, driving about at 20 m/s.
std::vector<Object> objects(size_t count) {
  std::vector<Object> all;
  roam_support::Random random(1);
  const sward::View view = flight::low_view(0);
  const glm::dvec2 ahead = glm::normalize(glm::dvec2(glm::transpose(view.eye_from_world)[2])) * -1.0;
  for (size_t i = 0; i < count; ++i) {
    const double distance = 50 * std::pow(80.0, random.uniform(0, 1)), side = distance * random.uniform(-0.5, 0.5);
    const double heading = random.uniform(0, 6.3);
    all.push_back({glm::dvec2(view.eye) + distance * ahead + side * glm::dvec2(ahead.y, -ahead.x),
                   20.0 * glm::dvec2(std::cos(heading), std::sin(heading))});
  }
  return all;
}

sward::NamedPoint object_at(const Object& object, uint64_t id, double seconds) {
  return {id, object.start + seconds * object.velocity};
}

// From 2 m above one object to 2 m above another.
sward::NamedLine line_at(const Object& from, const Object& to, uint64_t id, double seconds) {
  const auto end = [&](const Object& object) {
    const glm::dvec2 xy = object.start + seconds * object.velocity;
    return glm::dvec3(xy, flight::terrain().field->height(xy) + 2);
  };
  return {id, end(from), end(to)};
}

struct Named {
  size_t objects = 0, lines = 0;
  bool drive = false;
};

struct NamedCost {
  double ms = 0;  // mean of an update
  uint32_t unmet = 0;
};

// Over the low flight.
NamedCost fly_with(const Named& what) {
  constexpr int k_frames = 300;
  const std::vector<Object> all = objects(2 * std::max(what.objects, what.lines));
  std::vector<double> ms(k_frames, 1e9);
  NamedCost cost;
  for (int run = 0; run < k_runs; ++run) {
    sward::HostPriorities named(flight::terrain().field->lattice());
    auto mesh = sward::RoamMesh::create(*flight::terrain().bounds, budget(50000));
    (void)mesh->set_priorities(&named);
    for (int frame = -k_warm; frame < k_frames; ++frame) {
      const sward::View view = flight::low_view(frame + k_warm);
      const bool first = frame == -k_warm;
      const double start = flight::thread_ms(), seconds = what.drive ? (frame + k_warm) / 60.0 : 0;
      for (size_t i = 0; (first || what.drive) && i < what.objects; ++i) {
        const sward::NamedPoint point = object_at(all[i], i, seconds);
        (void)(first ? named.add(point) : named.move(point));
      }
      for (size_t i = 0; (first || what.drive) && i < what.lines; ++i) {
        const sward::NamedLine line = line_at(all[2 * i], all[2 * i + 1], i, seconds);
        (void)(first ? named.add(line) : named.move(line));
      }
      const auto stats = mesh->update(view, frame / 60.0);
      cost.unmet = std::max(cost.unmet, stats->unmet);
      if (frame >= 0) ms[size_t(frame)] = std::min(ms[size_t(frame)], flight::thread_ms() - start);
    }
  }
  cost.ms = flight::mean(ms);
  return cost;
}

void named_things() {
  const double none = fly_with({}).ms;
  std::printf("50 000 triangles, nothing named: %.3f ms\n", none);
  for (const Named what : {Named{100, 0}, Named{1000, 0}, Named{0, 20}}) {
    const NamedCost still = fly_with({what.objects, what.lines, false}),
                    driven = fly_with({what.objects, what.lines, true});
    std::printf("%zu objects, %zu lines of sight: standing %+.3f ms, moving in each frame %+.3f ms, unmet %u\n",
                what.objects, what.lines, still.ms - none, driven.ms - none, std::max(still.unmet, driven.unmet));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto wanted = [&](const char* name) {
    return argc == 1 ||
           std::any_of(argv + 1, argv + argc, [&](const char* given) { return std::string(given) == name; });
  };
  std::printf(
      "| flight                       |  visible |  mean ms | p99.5 | changes  | ns/change| written | still    |   "
      "|\n");
  if (wanted("plain")) plain_and_deferred();
  if (wanted("sizes")) sizes();
  if (wanted("million")) print("deferred, 1 000 000", fly(flight::terrain(), budget(1000000), 100, 1));
  if (wanted("bounds")) bounds_on_threads();
  if (wanted("views")) several_views();
  if (wanted("named")) named_things();
}
