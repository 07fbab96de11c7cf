// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

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
  int samples_ = 1;
  glm::dvec2 cursor_{0};
  bool looking_ = false;
  std::vector<int> keys_down_;
};

}  // namespace sward::tool
