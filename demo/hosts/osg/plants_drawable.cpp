// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "plants_drawable.h"

#include <sward/vegetation/vegetation_renderer.h>
#include <algorithm>
#include <osg/Notify>
#include <osg/RenderInfo>

namespace sward::osg_host {

namespace {

/// A layer with what it keeps from frame to frame.
struct LayerDrawing {
  VegetationRenderer vegetation;
  FixedLevelOptions cut;
  FixedTriangles triangles;
  Seeding seeding;
};

FixedLevelOptions cut_of(const Layer& layer, const Lattice& lattice) {
  FixedLevelOptions cut;
  cut.level = level_for_area(lattice, double(layer.triangle_area_m2));
  cut.canopy_m = canopy_height(layer);
  cut.spread_m = canopy_spread(layer);
  cut.altitudes = needs_altitudes(layer);
  return cut;
}

}  // namespace

struct PlantsDrawable::Renderer {
  const osg::State* state;
  gl::Frame frame;
  gl::GroundTextures ground;
  std::vector<LayerDrawing> layers;

  static Expected<std::unique_ptr<Renderer>> create(const Content& content, const osg::State& state) {
    auto frame = gl::Frame::create();
    if (!frame) return tl::unexpected(frame.error());
    auto ground = gl::GroundTextures::create(content.colors);
    if (!ground) return tl::unexpected(ground.error());
    std::unique_ptr<Renderer> made(new Renderer{&state, std::move(*frame), std::move(*ground), {}});
    const gl::ShaderLibrary shaders;
    for (const Layer& layer : content.layers) {
      auto vegetation = VegetationRenderer::create(layer, shaders);
      if (!vegetation) return tl::unexpected(vegetation.error());
      made->layers.push_back({std::move(*vegetation), cut_of(layer, content.terrain->lattice()), {}, {}});
    }
    return made;
  }

  Expected<void> draw(const Content& content, LayerDrawing& drawing, const View& view, GLuint framebuffer) {
    const Layer& layer = drawing.vegetation.layer();
    drawing.cut.horizon_m = layer.horizon_m * float(view.zoom());
    auto cut = content.terrain->fixed_level_triangles(view, drawing.cut, drawing.triangles);
    if (!cut) return cut;
    seed(layer, view, content.colors, drawing.triangles, drawing.seeding);
    auto uploaded = drawing.vegetation.upload(drawing.seeding, drawing.triangles, view);
    if (!uploaded) return uploaded;
    drawing.vegetation.classify(frame, ground, framebuffer);
    drawing.vegetation.draw(frame, ground);
    return {};
  }
};

PlantsDrawable::PlantsDrawable() = default;

PlantsDrawable::PlantsDrawable(Content content) : content_(std::make_shared<const Content>(std::move(content))) {
  setUseDisplayList(false);
  setSupportsDisplayList(false);
  setStateSet(make_state_set());
}

PlantsDrawable::PlantsDrawable(const PlantsDrawable& other, const osg::CopyOp& copy)
    : osg::Drawable(other, copy), content_(other.content_) {}

PlantsDrawable::~PlantsDrawable() {
  (void)renderer_.release();  // its context is gone, and with it what it held
}

osg::BoundingBox PlantsDrawable::computeBoundingBox() const {
  if (!content_) return {};
  osg::BoundingBox box = content_->box;
  float canopy = 0;
  for (const Layer& layer : content_->layers) canopy = std::max(canopy, canopy_height(layer));
  box.zMax() += canopy;
  return box;
}

Expected<void> PlantsDrawable::draw(osg::State& state) const {
  const auto view = view_of(state);
  if (!view) return tl::unexpected(view.error());
  if (!renderer_) {
    auto made = Renderer::create(*content_, state);
    if (!made) return tl::unexpected(made.error());
    renderer_ = std::move(*made);
  }
  if (renderer_->state != &state) return fail("these plants are drawn in another context; make a drawable for each");
  const Target target = current_target();
  renderer_->frame.upload(*view, content_->lighting, time_of(state), target.samples);
  size_t seeded = 0;
  for (LayerDrawing& drawing : renderer_->layers) {
    auto drawn = renderer_->draw(*content_, drawing, *view, target.framebuffer);
    if (!drawn) return drawn;
    seeded += drawing.seeding.records.size();
  }
  seeded_ = seeded;
  return {};
}

void PlantsDrawable::drawImplementation(osg::RenderInfo& info) const {
  if (!content_) return;
  info.getState()->unbindVertexArrayObject();
  if (auto drawn = draw(*info.getState()); !drawn) OSG_WARN << "sward: error: " << drawn.error().message << std::endl;
  tell_state(*info.getState());
}

void PlantsDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (renderer_ && state == renderer_->state) renderer_.reset();
}

}  // namespace sward::osg_host
