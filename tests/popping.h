// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// How far plants' projected heights move from one frame to the next because of level of detail alone, by the CPU twin:
// wind still, no plant moves otherwise. For tests and benchmarks.
#include <sward/terrain/terrain.h>
#include <sward/vegetation/plants.h>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "roam_support.h"

namespace popping {

constexpr double k_frame_s = 1.0 / 60, k_speed = 1.5;  // metres a second
constexpr glm::ivec2 k_viewport(1280, 720);

/// A walk over ground of height(xy): 0 straight on at eye level; 1 in a circle, turning the head as well; 2 up and down
/// between 1.5 and 10 m above the ground, nodding.
template <class Height>
sward::View walk_over(Height&& height, int path, int frame) {
  const double t = frame * k_frame_s, s = k_speed * t;
  glm::dvec2 xy(0);
  double above = 1.7, yaw = 0.4, pitch = -0.1;
  if (path == 0) xy = s * glm::dvec2(std::cos(0.4), std::sin(0.4));
  if (path == 1) {
    xy = 6.0 * glm::dvec2(std::sin(s / 6.0), 1.0 - std::cos(s / 6.0));
    yaw = s / 6.0 + 0.5 * std::sin(1.3 * t);
  }
  if (path == 2) {
    above = 1.5 + 8.5 * (0.5 - 0.5 * std::cos(0.35 * t));
    xy = {0.2 * s, 0.1 * s};
    pitch = -0.35 + 0.25 * std::sin(0.9 * t);
  }
  const glm::dvec2 start(-30.0 + 15.0 * path, 20.0);
  const glm::dvec2 at = start + xy;
  return sward::View::look({at, height(at) + above}, yaw, pitch, 0.87, k_viewport, 0.1, 2000);
}

inline sward::View walk(const roam_support::Terrain& terrain, int path, int frame) {
  return walk_over([&](glm::dvec2 at) { return terrain.field->height(at); }, path, frame);
}

inline roam_support::Terrain hills() {
  roam_support::TerrainOptions options;
  options.spacing = 4;
  options.relief_m = 6;
  return roam_support::make_terrain(options);
}

inline sward::ColorMap green(const sward::HeightField& field) {
  return {1, 1, {{110, 130, 60, 255}}, field.min_corner(), field.max_corner() - field.min_corner()};
}

/// Grass that the green ground carries everywhere.
inline sward::Layer meadow(sward::DensityLaw law, float horizon_m) {
  sward::Layer layer;
  sward::Species grass;
  grass.reference_hsv = {77 / 360.0f, 0.54f, 0.51f};
  layer.species = {grass};
  layer.law = law;
  layer.horizon_m = horizon_m;
  layer.density = law == sward::DensityLaw::distance ? 60.0f : 8000.0f;
  layer.ceiling = 200;
  return layer;
}

using Plants = std::unordered_map<uint64_t, sward::Plant>;

struct Frame {
  sward::View view;
  Plants plants;
};

/// Well inside of the picture: culling may not have left it out.
inline bool in_sight(const sward::View& view, glm::dvec3 p) {
  const glm::dvec4 clip = view.clip_from_relative() * glm::dvec4(p - view.eye, 1);
  return clip.w > 0.3 && std::abs(clip.x) < 0.95 * clip.w && std::abs(clip.y) < 0.95 * clip.w;
}

/// A layer over a mesh with morph.
class Stage {
 public:
  Stage(const roam_support::Terrain& terrain, const sward::Layer& layer)
      : layer_(layer), mesh_(sward::RoamMesh::create(*terrain.bounds, {.max_triangles = 6000}).value()) {
    cut_.level = sward::level_for_area(terrain.field->lattice(), layer.triangle_area_m2);
    cut_.canopy_m = sward::canopy_height(layer);
    cut_.horizon_m = layer.horizon_m;
    cut_.skip_back_faces = layer.plain;
  }

  Frame show(const sward::View& view, const sward::ColorMap& map, double time_s) {
    (void)mesh_.update(view, time_s).value();
    mesh_.fixed_level_triangles(cut_, triangles_);
    sward::seed(layer_, view, map, triangles_, seeding_);
    Frame frame{view, {}};
    for (const sward::Plant& p : sward::grow_plants(layer_, view, map, triangles_, seeding_))
      frame.plants.emplace(p.triangle.bits * 0x9E3779B97F4A7C15u ^ uint64_t(p.rank) * 0xC2B2AE3D27D4EB4Fu, p);
    return frame;
  }

 private:
  sward::Layer layer_;
  sward::RoamMesh mesh_;
  sward::FixedLevelOptions cut_;
  sward::FixedTriangles triangles_;
  sward::Seeding seeding_;
};

struct Jumps {
  double worst_px = 0;        ///< Largest change of a projected height between two frames.
  size_t beyond_a_pixel = 0;  ///< Plants and frames with more than a pixel.
  size_t compared = 0;
};

/// Adds what changed from one frame to the next.
inline void add_jumps(const Frame& before, const Frame& now, Jumps& jumps) {
  const double focal = now.view.clip_from_eye[1][1] * 0.5 * now.view.viewport.y;
  const auto note = [&](glm::dvec3 root, double change) {
    if (!in_sight(now.view, root) || !in_sight(before.view, root)) return;
    const double px = std::abs(change) * focal / glm::distance(root, now.view.eye);
    jumps.worst_px = std::max(jumps.worst_px, px);
    jumps.beyond_a_pixel += px > 1;
    ++jumps.compared;
  };
  const auto shown = [](const sward::Plant& p) { return double(p.height) * double(p.fade); };
  for (const auto& [name, plant] : now.plants) {
    const auto was = before.plants.find(name);
    note(plant.position, shown(plant) - (was == before.plants.end() ? 0.0 : shown(was->second)));
  }
  for (const auto& [name, plant] : before.plants)
    if (!now.plants.contains(name)) note(plant.position, shown(plant));
}

/// Walks `frames` frames of a path.
inline Jumps follow_walk(const roam_support::Terrain& terrain, const sward::ColorMap& map, const sward::Layer& layer,
                         int path, int frames) {
  Stage stage(terrain, layer);
  Jumps jumps;
  Frame before = stage.show(walk(terrain, path, 0), map, 0);
  for (int frame = 1; frame < frames; ++frame) {
    Frame now = stage.show(walk(terrain, path, frame), map, frame * k_frame_s);
    add_jumps(before, now, jumps);
    before = std::move(now);
  }
  return jumps;
}

}  // namespace popping
