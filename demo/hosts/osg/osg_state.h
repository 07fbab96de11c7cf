// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// epoxy's GL header comes before OpenSceneGraph's.
#include <epoxy/gl.h>

#include <sward/terrain/view.h>
#include <osg/State>
#include <osg/StateSet>

namespace sward::osg_host {

/// What a frame of sward leaves to its host (VegetationRenderer::draw), whatever the nodes above say. The caller owns
/// it.
osg::StateSet* make_state_set();

/// The view that OpenSceneGraph draws with now. Fails without a viewport and under transforms that scale.
Expected<View> view_of(const osg::State& state);

/// The frame stamp's simulation time, seconds.
double time_of(const osg::State& state);

/// Which framebuffer a camera renders to, and how many samples it has: OpenSceneGraph does not tell, GL does. GL
/// thread.
struct Target {
  GLuint framebuffer = 0;
  int samples = 1;
};
Target current_target();

/// After a frame of sward: programs, vertex arrays, textures and uniform buffers are unbound now. osg::State binds what
/// it remembers again. GL thread.
void tell_state(osg::State& state);

}  // namespace sward::osg_host
