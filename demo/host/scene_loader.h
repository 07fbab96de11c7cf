// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/shader_library.h>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "host/scene_renderer.h"
#include "host/scene_terrain.h"

namespace sward::host {

/// A scene and the ground that it was loaded with.
struct SceneSource {
  Scene scene;
  std::unique_ptr<SceneTerrain> terrain;
};

/// A scene of which nothing is left to be read, compiled or uploaded that takes long: SceneRenderer::create() makes a
/// renderer of it between two frames.
struct LoadedScene {
  SceneSource source;
  gl::GroundTextures ground;
  gl::ShaderLibrary shaders;  ///< With its programs' binaries.
};

/// Loads a scene in a thread with a GL context of its own, while another thread goes on drawing the one before.
class SceneLoader {
 public:
  /// A context that shares objects with the drawing one; both functions are called in the loader's thread, at the
  /// beginning and the end of a load.
  struct Context {
    std::function<bool()> make_current;
    std::function<void()> release;
  };

  explicit SceneLoader(Context context) : context_(std::move(context)) {}
  /// Waits for a load that is under way.
  ~SceneLoader() = default;

  /// `read` is called in the loader's thread, and must not touch what this thread draws. One load at a time (asserted).
  void start(std::function<Expected<SceneSource>()> read, gl::ShaderLibrary shaders);
  bool busy() const { return result_.valid(); }
  /// The result, once, when it is there; never waits. An error is that of reading the scene, or a shader's.
  std::optional<Expected<LoadedScene>> take();

 private:
  Context context_;
  std::future<Expected<LoadedScene>> result_;
};

}  // namespace sward::host
