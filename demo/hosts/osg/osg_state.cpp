// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "osg_state.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <osg/Depth>
#include <osg/FrameStamp>
#include <osg/Viewport>

namespace sward::osg_host {

namespace {

// Binding points of gl::Bindings: its numbers count from 0 to these.
constexpr unsigned k_texture_units = 18, k_uniform_buffers = 8, k_storage_buffers = 5;

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

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

double time_of(const osg::State& state) {
  const osg::FrameStamp* stamp = state.getFrameStamp();
  return stamp != nullptr ? stamp->getSimulationTime() : 0;
}

Target current_target() {
  return {GLuint(integer(GL_DRAW_FRAMEBUFFER_BINDING)), std::max(integer(GL_SAMPLES), 1)};
}

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

}  // namespace sward::osg_host
