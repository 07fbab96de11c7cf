// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// epoxy's GL header, which this brings in, must come before OpenSceneGraph's.
#include "host/scene_renderer.h"

#include <memory>
#include <mutex>
#include <osg/Camera>
#include <osg/GLObjects>
#include <osg/State>
#include <osg/observer_ptr>
#include <set>
#include <string>
#include <vector>

namespace sward::osg_host {

/// Renderers that are waiting for their context to be current, so that their GL objects can be deleted. One for each
/// contextID, among OpenSceneGraph's own managers (osg::get<DeadRenderers>): flushed when that context has drawn a
/// frame and when it is closed. Objects of a context that is gone are not deleted, for their names may be another
/// context's; memory is freed all the same.
class DeadRenderers : public osg::GraphicsObjectManager {
 public:
  explicit DeadRenderers(unsigned context_id) : osg::GraphicsObjectManager("sward::DeadRenderers", context_id) {}

  /// Any thread. `owner` is the state of the context that the renderer was made in.
  void add(std::unique_ptr<host::SceneRenderer> renderer, const osg::observer_ptr<osg::State>& owner);

  void flushDeletedGLObjects(double, double&) override { flush(); }
  void flushAllDeletedGLObjects() override { flush(); }
  void deleteAllGLObjects() override { flush(); }
  void discardAllGLObjects() override;

 private:
  struct Dead {
    std::unique_ptr<host::SceneRenderer> renderer;
    osg::observer_ptr<osg::State> owner;
  };
  ~DeadRenderers() override;
  void flush();

  std::mutex mutex_;
  std::vector<Dead> dead_;
};

/// What draws one scene: a renderer for each context and camera, made when they first meet. A camera has one of its own
/// because a mesh follows one view; contexts, because vertex arrays and feedback objects are not shared even where
/// buffers are. A camera that is gone takes its renderer with it.
///
/// All calls from any thread. A renderer is used by its context's draw thread alone.
class RendererPool {
 public:
  RendererPool(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain, bool sky);
  ~RendererPool() { release(nullptr); }

  const Scene& scene() const { return scene_; }
  const std::shared_ptr<const host::SceneTerrain>& terrain() const { return terrain_; }
  bool sky() const { return sky_; }

  /// In the draw thread, with the context current. Null where none can be made, which is told once.
  host::SceneRenderer* renderer_for(osg::State& state, osg::Camera* camera);
  /// Hands what this context has, or all contexts have, over to be deleted there.
  void release(const osg::State* state);
  /// Says an error through OpenSceneGraph's notification, each message once.
  void tell(const Error& error);

 private:
  struct Seat {
    osg::observer_ptr<osg::State> state;
    osg::observer_ptr<osg::Camera> camera;
    bool has_camera = false;
    osg::ref_ptr<DeadRenderers> grave;
    std::unique_ptr<host::SceneRenderer> renderer;  // empty: could not be made
    bool vacant() const { return !state.valid() || (has_camera && !camera.valid()); }
  };
  struct Place {
    host::SceneRenderer* renderer;
    bool is_new;   // The caller has to make its renderer.
    bool refused;  // A world's only seat is another camera's.
  };
  Place take_seat(osg::State& state, osg::Camera* camera);
  Seat* find(const osg::State& state, const osg::Camera* camera);
  void sweep();
  std::unique_ptr<host::SceneRenderer> make();

  const Scene scene_;
  const std::shared_ptr<const host::SceneTerrain> terrain_;
  const bool sky_;
  std::mutex mutex_;
  std::vector<Seat> seats_;
  std::set<std::string> told_;
};

}  // namespace sward::osg_host
