// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward_drawable.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <osg/Depth>
#include <osg/RenderInfo>
#include <osg/State>

#include "near_plane.h"

namespace sward::osg_host {

namespace {

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

double canopy_of(const Scene& scene) {
  float canopy = 0;
  for (const Layer& layer : scene.layers) canopy = std::max(canopy, canopy_height(layer));
  return canopy;
}

// What a frame of sward leaves to its host (VegetationRenderer::draw), whatever the nodes above say.
osg::StateSet* make_state_set() {
  osg::ref_ptr<osg::StateSet> set(new osg::StateSet);
  constexpr unsigned mine = osg::StateAttribute::PROTECTED;
  for (const GLenum mode :
       {GL_CULL_FACE, GL_BLEND, GL_ALPHA_TEST, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_FRAMEBUFFER_SRGB, GL_CLIP_PLANE0,
        GL_CLIP_PLANE1, GL_CLIP_PLANE2, GL_CLIP_PLANE3, GL_CLIP_PLANE4, GL_CLIP_PLANE5})
    set->setMode(mode, osg::StateAttribute::OFF | mine);
  set->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), osg::StateAttribute::ON | mine);
  return set.release();
}

Expected<View> view_of(const osg::State& state) {
  const osg::Viewport* viewport = state.getCurrentViewport();
  if (viewport == nullptr) return fail("OpenSceneGraph has set no viewport; give the camera one");
  const glm::dmat4 eye_from_world = glm::make_mat4(state.getModelViewMatrix().ptr());
  const glm::dmat4 clip_from_eye = glm::make_mat4(state.getProjectionMatrix().ptr());
  const glm::dvec3 eye(glm::inverse(eye_from_world)[3]);
  return View::from_matrices(eye, eye_from_world, clip_from_eye, {int(viewport->width()), int(viewport->height())});
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
  const osg::FrameStamp* stamp = state.getFrameStamp();
  const double time_s = stamp != nullptr ? stamp->getSimulationTime() : 0;
  // Which framebuffer a camera renders to, and how many samples it has, OpenSceneGraph does not tell.
  const auto framebuffer = GLuint(integer(GL_DRAW_FRAMEBUFFER_BINDING));
  const int samples = std::max(integer(GL_SAMPLES), 1);
  const auto drawn = renderer.draw(*view, lighting_of(scene), time_s, framebuffer, samples, false);
  if (!drawn) return tl::unexpected(drawn.error());
  return {};
}

// Binding points of gl::Bindings: its numbers count from 0 to these.
constexpr unsigned k_texture_units = 18, k_uniform_buffers = 8, k_storage_buffers = 5;

// What sward leaves unbound, osg::State shall bind again where it remembers something else. Only that: after
// State::dirtyAllAttributes() lights would be placed again, below other matrices, and State::dirtyAllModes() inverts
// what State remembers, so that a mode which the next drawable changes is taken for one that is set already.
void tell_state(osg::State& state) {
  using Type = osg::StateAttribute;
  glPatchParameteri(GL_PATCH_VERTICES, 3);  // GL's default; sward leaves 1.
  state.haveAppliedAttribute(Type::PATCH_PARAMETER);
  state.haveAppliedAttribute(Type::PROGRAM);
  state.setLastAppliedProgramObject(nullptr);
  for (unsigned unit = 0; unit < k_texture_units; ++unit) {
    state.haveAppliedTextureAttribute(unit, Type::TEXTURE);
    state.haveAppliedTextureAttribute(unit, Type::SAMPLER);
  }
  for (unsigned i = 0; i < k_uniform_buffers; ++i) state.haveAppliedAttribute(Type::UNIFORMBUFFERBINDING, i);
  for (unsigned i = 0; i < k_storage_buffers; ++i) state.haveAppliedAttribute(Type::SHADERSTORAGEBUFFERBINDING, i);
  state.haveAppliedAttribute(Type::INDIRECTDRAWBUFFERBINDING);
  state.dirtyAllVertexArrays();
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
