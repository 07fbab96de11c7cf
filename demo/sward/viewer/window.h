// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/scene_loader.h"
#include "sward/viewer/camera.h"

struct GLFWwindow;

namespace sward::tool {

/// A GLFW window with a GL 4.5 core context, current on this thread, and Dear ImGui in it.
class Window {
 public:
  static Expected<Window> open(const std::string& title, glm::ivec2 size, int samples);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) = delete;
  ~Window();

  /// A context that shares objects with the window's, current nowhere, for a thread that prepares what is drawn here.
  /// Call once, on this thread.
  Expected<host::SceneLoader::Context> make_loader_context();

  bool closing() const;
  /// Takes events and begins an ImGui frame.
  void begin_frame();
  /// Draws the ImGui frame over the picture and shows it.
  void end_frame();

  glm::ivec2 framebuffer_size() const;  ///< Pixels; 0 while minimised.
  int samples() const { return samples_; }
  CameraInput camera_input();
  bool pressed_once(int glfw_key);  ///< True in the first frame of a key's being down.

 private:
  Window() = default;
  GLFWwindow* window_ = nullptr;
  GLFWwindow* loader_window_ = nullptr;  ///< Never shown: GLFW has no contexts without windows.
  int samples_ = 1;
  glm::dvec2 cursor_{0};
  bool looking_ = false;
  std::vector<int> keys_down_;
};

}  // namespace sward::tool
