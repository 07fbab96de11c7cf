// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward_drawable.h"

#include <algorithm>
#include <cmath>
#include <osg/RenderInfo>
#include <osg/State>

#include "near_plane.h"
#include "osg_state.h"

namespace sward::osg_host {

namespace {

double canopy_of(const Scene& scene) {
  float canopy = 0;
  for (const Layer& layer : scene.layers) canopy = std::max(canopy, canopy_height(layer));
  return canopy;
}

gl::Lighting lighting_of(const Scene& scene) {
  gl::Lighting lighting = gl::Lighting::clear_day(scene.sun_azimuth, scene.sun_elevation);
  lighting.haze_distance_m = scene.haze_distance_m;
  lighting.ground_tint = ground_tint(scene.ground_seasons, scene.season);
  return lighting;
}

Expected<void> draw_scene(const osg::State& state, const Scene& scene, host::SceneRenderer& renderer) {
  const auto view = view_of(state);
  if (!view) return tl::unexpected(view.error());
  const Target target = current_target();
  const auto drawn =
      renderer.draw(*view, lighting_of(scene), time_of(state), target.framebuffer, target.samples, false);
  if (!drawn) return tl::unexpected(drawn.error());
  return {};
}

}  // namespace

SwardDrawable::SwardDrawable(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain,
                             const DrawableOptions& options)
    : pool_(std::make_shared<RendererPool>(std::move(scene), std::move(terrain), options.sky)) {
  setUseDisplayList(false);
  setSupportsDisplayList(false);
  setStateSet(make_state_set());
  setCullCallback(new NearPlane(pool_->terrain(), canopy_of(pool_->scene())));
  // The sky is in every direction.
  if (options.sky) setCullingActive(false);
}

SwardDrawable::SwardDrawable(const SwardDrawable& other, const osg::CopyOp& copy)
    : osg::Drawable(other, copy), pool_(other.pool_) {}

osg::BoundingBox SwardDrawable::computeBoundingBox() const {
  if (!pool_) return {};
  const Surface& surface = terrain().surface();
  const glm::dvec2 low = surface.lattice().min_corner(), high = surface.lattice().max_corner();
  const glm::dvec2 heights = surface.height_range();
  return {osg::Vec3d(low.x, low.y, heights.x), osg::Vec3d(high.x, high.y, heights.y + canopy_of(scene()))};
}

void SwardDrawable::drawImplementation(osg::RenderInfo& info) const {
  osg::State& state = *info.getState();
  if (!pool_) return;
  host::SceneRenderer* renderer = pool_->renderer_for(state, info.getCurrentCamera());
  state.unbindVertexArrayObject();
  if (renderer != nullptr)
    if (auto drawn = draw_scene(state, scene(), *renderer); !drawn) pool_->tell(drawn.error());
  tell_state(state);
}

void SwardDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (pool_) pool_->release(state);
}

}  // namespace sward::osg_host
