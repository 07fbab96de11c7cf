// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// A patch of level ground, seeded by hand-made triangles, on both sides: what the CPU twin needs and what GL needs.
#include <sward/vegetation/plants.h>
#include <sward/vegetation/vegetation_renderer.h>

#include <numbers>
#include <optional>

#include "gl/gl_fixture.h"
#include "unit/plant_fixtures.h"

namespace sward::test {

inline constexpr double k_side = 16;  ///< Of the patch, metres: x 0..16, y -16..0.
inline constexpr glm::u8vec4 k_green{90, 130, 50, 255};
inline constexpr glm::u8vec4 k_brown{120, 90, 60, 255};

/// A grass whose reference is `color`.
inline Species grass_of(const char* name, glm::u8vec4 color) {
  Species species;
  species.name = name;
  const glm::vec3 c = glm::vec3(color) / 255.0f;
  const float value = std::max({c.r, c.g, c.b}), chroma = value - std::min({c.r, c.g, c.b});
  float hue = 0;
  if (chroma > 0) {
    hue = value == c.r ? (c.g - c.b) / chroma : value == c.g ? 2 + (c.b - c.r) / chroma : 4 + (c.r - c.g) / chroma;
    hue = hue < 0 ? hue / 6 + 1 : hue / 6;
  }
  species.reference_hsv = {hue, chroma / std::max(value, 1e-6f), value};
  return species;
}

inline Species bare_of(const char* name, glm::u8vec4 color) {
  Species species = grass_of(name, color);
  species.kind = PlantKind::none;
  return species;
}

inline Layer grass_and_soil() {
  Layer layer;
  layer.species = {grass_of("grass", k_green), bare_of("soil", k_brown)};
  layer.density = 60;
  layer.full_distance_m = 4;
  layer.horizon_m = 14;
  return layer;
}

/// Paints texels from a function of their column and row.
template <class Paint>
ColorMap painted_map(int texels, Paint paint) {
  ColorMap map = plain_map(k_side, texels, k_green);
  for (int row = 0; row < texels; ++row)
    for (int column = 0; column < texels; ++column) map.texels[size_t(row * texels + column)] = paint(column, row);
  return map;
}

inline View eye_level_view(glm::dvec3 eye, glm::ivec2 viewport, double pitch_degrees = -12) {
  const double radians = std::numbers::pi / 180;
  return View::look(eye, 90 * radians, pitch_degrees * radians, 50 * radians, viewport, 0.05, 1000);
}

/// One layer over the patch: triangles and seeding for a view, ground textures, frame, renderer.
class Patch {
 public:
  Patch(Layer layer, ColorMap map, const gl::Bindings& bindings = {}, const gl::ShaderLibrary& shaders = {})
      : layer_(std::move(layer)), map_(std::move(map)) {
    HeightFieldDesc desc;
    desc.columns = desc.rows = 5;
    desc.spacing = glm::dvec2(k_side / 4);
    desc.origin = {k_side / 2, -k_side / 2, 0};
    desc.relief.enabled = false;
    auto field = HeightField::create(desc, std::vector<float>(25, 0.0f));
    EXPECT_TRUE(field) << field.error().message;
    auto ground = gl::GroundTextures::create(*field, map_);
    EXPECT_TRUE(ground) << ground.error().message;
    ground_.emplace(std::move(*ground));
    auto frame = gl::Frame::create(bindings);
    EXPECT_TRUE(frame) << frame.error().message;
    frame_ = std::move(*frame);
    auto renderer = VegetationRenderer::create(layer_, shaders, bindings);
    EXPECT_TRUE(renderer) << renderer.error().message;
    if (renderer) renderer_ = std::make_unique<VegetationRenderer>(std::move(*renderer));
  }

  /// Level ground around the eye.
  void look(const View& view) { look(view, level_ground(k_side, level, view.eye, layer_.horizon_m * view.zoom())); }
  void look(const View& view, FixedTriangles triangles) {
    view_ = view;
    triangles_ = std::move(triangles);
    measure_screen();
    seed(layer_, view_, map_, triangles_, seeding_, &exclusions);
    frame_.upload(view_, lighting, time_s, samples);
    const auto uploaded = renderer_->upload(seeding_, triangles_, view_);
    EXPECT_TRUE(uploaded) << uploaded.error().message;
  }
  void classify(GLuint restore_framebuffer = 0) { renderer_->classify(frame_, *ground_, restore_framebuffer); }
  void draw() { renderer_->draw(frame_, *ground_); }

  std::vector<Plant> plants_of_gpu() {
    auto plants = renderer_->read_back(frame_, *ground_, view_, seeding_, 0);
    EXPECT_TRUE(plants) << plants.error().message;
    return plants ? std::move(*plants) : std::vector<Plant>{};
  }
  std::vector<Plant> plants_of_cpu() const {
    return grow_plants(layer_, view_, map_, triangles_, seeding_, lighting.sun_azimuth, disturbance_);
  }

  VegetationRenderer& renderer() { return *renderer_; }
  const Seeding& seeding() const { return seeding_; }
  const gl::Frame& frame() const { return frame_; }
  const gl::GroundTextures& ground() const { return *ground_; }
  const Layer& layer() const { return layer_; }

  /// Of the twin and of the renderer.
  void set_season(float season) {
    layer_.season = season;
    renderer_->set_season(season);
  }

  /// Of the twin and of the renderer.
  void set_disturbance(const Disturbance* disturbance, const gl::DisturbedGround& textures) {
    disturbance_ = disturbance;
    ground_->set_disturbed(textures);
  }

  Exclusions exclusions;
  gl::Lighting lighting;
  int samples = 1;
  int level = 8;  ///< Of the triangles: 2 * 2^level of them.
  double time_s = 0;

 private:
  /// Projected areas, for the law that asks for them; everything here lies before the near plane or far off the screen.
  void measure_screen() {
    const glm::dmat4 clip = view_.clip_from_relative();
    const auto project = [&](glm::dvec3 world) {
      const glm::dvec4 p = clip * glm::dvec4(world - view_.eye, 1.0);
      return p.w > 0 ? glm::dvec3(glm::dvec2(p) / p.w, p.w) : glm::dvec3(0, 0, -1);
    };
    const double aspect = double(view_.viewport.x) / view_.viewport.y;
    for (size_t i = 0; i < triangles_.size(); ++i) {
      FixedTriangle t = triangles_[i];
      const glm::dvec3 a = project(t.apex), b = project(t.apex + glm::dvec3(t.to_left)),
                       c = project(t.apex + glm::dvec3(t.to_right));
      const bool behind = a.z < 0 || b.z < 0 || c.z < 0;
      const double area = 0.5 * aspect * std::abs(cross(glm::dvec2(b - a), glm::dvec2(c - a)));
      t.screen_area = behind ? std::numeric_limits<float>::infinity() : float(area);
      triangles_.set(i, t);
    }
  }

  Layer layer_;
  ColorMap map_;
  View view_;
  FixedTriangles triangles_;
  Seeding seeding_;
  gl::Frame frame_;
  std::optional<gl::GroundTextures> ground_;
  std::unique_ptr<VegetationRenderer> renderer_;
  const Disturbance* disturbance_ = nullptr;
};

}  // namespace sward::test
