// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward_drawable.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <osg/GraphicsContext>
#include <osg/Notify>
#include <osg/RenderInfo>
#include <osg/State>
#include <osgUtil/CullVisitor>

namespace sward::osg_host {

namespace {

constexpr double k_near_far_ratio = 2e-5;

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

/// What a frame of sward needs of the fixed state, and everything that it changes, put back afterwards.
class StateGuard {
 public:
  StateGuard() {
    for (size_t i = 0; i < k_modes.size(); ++i) enabled_[i] = glIsEnabled(k_modes[i]);
    program_ = integer(GL_CURRENT_PROGRAM);
    vertex_array_ = integer(GL_VERTEX_ARRAY_BINDING);
    depth_function_ = integer(GL_DEPTH_FUNC);
    depth_mask_ = integer(GL_DEPTH_WRITEMASK);
    patch_vertices_ = integer(GL_PATCH_VERTICES);
    for (const GLenum mode : k_modes) glDisable(mode);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
  }
  ~StateGuard() {
    for (size_t i = 0; i < k_modes.size(); ++i) (enabled_[i] != 0 ? glEnable : glDisable)(k_modes[i]);
    glUseProgram(GLuint(program_));
    glBindVertexArray(GLuint(vertex_array_));
    glDepthFunc(GLenum(depth_function_));
    glDepthMask(GLboolean(depth_mask_));
    glPatchParameteri(GL_PATCH_VERTICES, patch_vertices_);
  }
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  // GL_ALPHA_TEST exists in compatibility contexts alone, which are OpenSceneGraph's.
  static constexpr std::array<GLenum, 8> k_modes{GL_DEPTH_TEST,  GL_CULL_FACE,         GL_BLEND,
                                                 GL_ALPHA_TEST,  GL_STENCIL_TEST,      GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                 GL_SAMPLE_MASK, GL_RASTERIZER_DISCARD};
  std::array<GLboolean, k_modes.size()> enabled_{};
  GLint program_, vertex_array_, depth_function_, depth_mask_, patch_vertices_;
};

/// Deletes a renderer on the thread and in the context that it belongs to.
struct DeleteRenderer : osg::GraphicsOperation {
  explicit DeleteRenderer(std::unique_ptr<host::SceneRenderer> dead)
      : osg::Referenced(true), osg::GraphicsOperation("sward: delete renderer", false), renderer(std::move(dead)) {}
  void operator()(osg::GraphicsContext*) override { renderer.reset(); }
  // Never run means that the context is gone, and its objects with it: they must not be deleted again.
  ~DeleteRenderer() override { (void)renderer.release(); }
  std::unique_ptr<host::SceneRenderer> renderer;
};

Expected<View> view_of(const osg::State& state) {
  const osg::Viewport* viewport = state.getCurrentViewport();
  if (viewport == nullptr) return fail("OpenSceneGraph has set no viewport");
  const glm::dmat4 eye_from_world = glm::make_mat4(state.getModelViewMatrix().ptr());
  const glm::dmat4 clip_from_eye = glm::make_mat4(state.getProjectionMatrix().ptr());
  const glm::dvec3 eye(glm::inverse(eye_from_world)[3]);
  return View::from_matrices(eye, eye_from_world, clip_from_eye, {int(viewport->width()), int(viewport->height())});
}

}  // namespace

SwardDrawable::SwardDrawable() {
  setUseDisplayList(false);
}

SwardDrawable::SwardDrawable(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain)
    : scene_(std::move(scene)), terrain_(std::move(terrain)) {
  setUseDisplayList(false);
  setSupportsDisplayList(false);
}

SwardDrawable::SwardDrawable(const SwardDrawable& other, const osg::CopyOp& copy)
    : osg::Drawable(other, copy), scene_(other.scene_), terrain_(other.terrain_) {}

SwardDrawable::~SwardDrawable() {
  releaseGLObjects(nullptr);
}

osg::BoundingBox SwardDrawable::computeBoundingBox() const {
  if (!terrain_) return {};
  const Lattice& lattice = terrain_->surface().lattice();
  const glm::dvec2 low = lattice.min_corner(), high = lattice.max_corner();
  const glm::dvec2 heights = terrain_->surface().height_range();
  float canopy = 0;
  for (const Layer& layer : scene_.layers) canopy = std::max(canopy, canopy_height(layer));
  return {osg::Vec3d(low.x, low.y, heights.x), osg::Vec3d(high.x, high.y, heights.y + canopy)};
}

host::SceneRenderer* SwardDrawable::renderer_for(unsigned context) const {
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = contexts_.try_emplace(context);
  if (is_new) {
    auto created = host::SceneRenderer::create(scene_, *terrain_, gl::ShaderLibrary());
    if (created)
      place->second.renderer = std::make_unique<host::SceneRenderer>(std::move(*created));
    else
      OSG_WARN << "sward: error: " << created.error().message << std::endl;
  }
  return place->second.renderer.get();
}

void SwardDrawable::draw(osg::State& state, host::SceneRenderer& renderer, double time_s) const {
  auto view = view_of(state);
  if (!view) {
    OSG_WARN << "sward: error: " << view.error().message << std::endl;
    return;
  }
  gl::Lighting lighting = gl::Lighting::clear_day(scene_.sun_azimuth, scene_.sun_elevation);
  lighting.haze_distance_m = scene_.haze_distance_m;
  lighting.ground_tint = ground_tint(scene_.ground_seasons, scene_.season);
  const auto framebuffer = GLuint(integer(GL_DRAW_FRAMEBUFFER_BINDING));
  const int samples = std::max(integer(GL_SAMPLES), 1);
  const StateGuard guard;
  if (auto drawn = renderer.draw(*view, lighting, time_s, framebuffer, samples, false); !drawn)
    OSG_WARN << "sward: error: " << drawn.error().message << std::endl;
}

void SwardDrawable::drawImplementation(osg::RenderInfo& info) const {
  osg::State& state = *info.getState();
  if (!terrain_) return;
  host::SceneRenderer* renderer = renderer_for(state.getContextID());
  if (renderer == nullptr) return;
  const osg::FrameStamp* stamp = state.getFrameStamp();
  draw(state, *renderer, stamp != nullptr ? stamp->getSimulationTime() : 0);
  // OpenSceneGraph remembers what it last set; textures and buffers of ours have been bound in between.
  state.dirtyAllModes();
  state.dirtyAllAttributes();
  state.dirtyAllVertexArrays();
}

void SwardDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  const std::lock_guard lock(mutex_);
  for (auto& [id, held] : contexts_) {
    if (!held.renderer || (state != nullptr && state->getContextID() != id)) continue;
    osg::GraphicsContext* context = state != nullptr ? state->getGraphicsContext() : nullptr;
    if (context != nullptr && context->isCurrent()) {
      held.renderer.reset();
      continue;
    }
    const osg::ref_ptr<DeleteRenderer> later(new DeleteRenderer(std::move(held.renderer)));
    for (osg::GraphicsContext* owner : osg::GraphicsContext::getRegisteredGraphicsContexts(id)) owner->add(later.get());
  }
  if (state != nullptr)
    contexts_.erase(state->getContextID());
  else
    contexts_.clear();
}

void NearGround::operator()(osg::Node* node, osg::NodeVisitor* visitor) {
  if (auto* cull = visitor->asCullVisitor()) cull->setNearFarRatio(std::min(cull->getNearFarRatio(), k_near_far_ratio));
  traverse(node, visitor);
}

}  // namespace sward::osg_host
