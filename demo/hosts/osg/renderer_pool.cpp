// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "renderer_pool.h"

#include <algorithm>
#include <osg/ContextData>
#include <osg/GraphicsContext>
#include <osg/Notify>
#include <thread>
#include <utility>

namespace sward::osg_host {

namespace {

constexpr const char* k_one_view =
    "a world follows one view, and another camera has this scene's already; read the file once for each view";

// Contexts that share objects have one contextID, so that it does not say which of them is current.
bool is_current(const osg::observer_ptr<osg::State>& owner) {
  osg::ref_ptr<osg::State> state;
  if (!owner.lock(state)) return false;
  const osg::GraphicsContext* context = state->getGraphicsContext();
  return context == nullptr || context->isCurrent();
}

// Frees what a renderer holds outside of GL. Its context is gone, and its objects with it: on a thread of its own there
// is no context, so that none of their names is deleted in another one.
void bury(std::unique_ptr<host::SceneRenderer> renderer) {
  std::thread([&renderer] { renderer.reset(); }).join();
}

}  // namespace

void DeadRenderers::add(std::unique_ptr<host::SceneRenderer> renderer, const osg::observer_ptr<osg::State>& owner) {
  if (!renderer) return;
  const std::lock_guard lock(mutex_);
  dead_.push_back({std::move(renderer), owner});
}

void DeadRenderers::flush() {
  const std::lock_guard lock(mutex_);
  std::erase_if(dead_, [](Dead& dead) {
    if (!dead.owner.valid()) bury(std::move(dead.renderer));
    return !dead.renderer || is_current(dead.owner);
  });
}

void DeadRenderers::discardAllGLObjects() {
  const std::lock_guard lock(mutex_);
  for (Dead& dead : dead_) bury(std::move(dead.renderer));
  dead_.clear();
}

DeadRenderers::~DeadRenderers() {
  discardAllGLObjects();
}

RendererPool::RendererPool(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain, bool sky)
    : scene_(std::move(scene)), terrain_(std::move(terrain)), sky_(sky) {}

RendererPool::Seat* RendererPool::find(const osg::State& state, const osg::Camera* camera) {
  const auto found = std::find_if(seats_.begin(), seats_.end(), [&](const Seat& seat) {
    return seat.state.get() == &state && seat.camera.get() == camera;
  });
  return found == seats_.end() ? nullptr : &*found;
}

void RendererPool::sweep() {
  for (Seat& seat : seats_)
    if (seat.vacant()) seat.grave->add(std::move(seat.renderer), seat.state);
  std::erase_if(seats_, [](const Seat& seat) { return seat.vacant(); });
}

std::unique_ptr<host::SceneRenderer> RendererPool::make() {
  auto made = host::SceneRenderer::create(scene_, *terrain_, gl::ShaderLibrary());
  if (!made) {
    tell(made.error());
    return nullptr;
  }
  made->set_sky(sky_);
  return std::make_unique<host::SceneRenderer>(std::move(*made));
}

RendererPool::Place RendererPool::take_seat(osg::State& state, osg::Camera* camera) {
  const std::lock_guard lock(mutex_);
  sweep();
  if (const Seat* seat = find(state, camera)) return {seat->renderer.get(), false, false};
  if (terrain_->world() != nullptr && !seats_.empty()) return {nullptr, false, true};
  seats_.push_back({&state, camera, camera != nullptr, osg::get<DeadRenderers>(state.getContextID()), nullptr});
  return {nullptr, true, false};
}

host::SceneRenderer* RendererPool::renderer_for(osg::State& state, osg::Camera* camera) {
  const Place place = take_seat(state, camera);
  if (place.refused) tell(Error{k_one_view});
  if (!place.is_new) return place.renderer;
  // Outside of the lock: other contexts go on drawing while programs compile here.
  auto made = make();
  const std::lock_guard lock(mutex_);
  Seat* seat = find(state, camera);
  if (seat == nullptr) {  // Released in the meantime.
    osg::get<DeadRenderers>(state.getContextID())->add(std::move(made), &state);
    return nullptr;
  }
  seat->renderer = std::move(made);
  return seat->renderer.get();
}

void RendererPool::release(const osg::State* state) {
  const std::lock_guard lock(mutex_);
  std::erase_if(seats_, [state](Seat& seat) {
    if (state != nullptr && seat.state.get() != state) return false;
    seat.grave->add(std::move(seat.renderer), seat.state);
    return true;
  });
}

void RendererPool::tell(const Error& error) {
  const std::lock_guard lock(mutex_);
  if (told_.insert(error.message).second) OSG_WARN << "sward: error: " << error.message << std::endl;
}

}  // namespace sward::osg_host
