// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/viewer/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace sward::tool {

namespace {

constexpr double k_radians_a_pixel = 0.0025;

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

}  // namespace

Expected<Window> Window::open(const std::string& title, glm::ivec2 size, int samples) {
  if (glfwInit() == GLFW_FALSE)
    return fail("no window can be opened: " + glfw_reason() + "; without a display use sward render");
  Window window;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, samples);
  window.window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (window.window_ == nullptr) {
    std::string reason = glfw_reason();
    glfwTerminate();
    return fail("no window with OpenGL 4.5 can be opened: " + reason);
  }
  glfwMakeContextCurrent(window.window_);
  glfwSwapInterval(1);
  glGetIntegerv(GL_SAMPLES, &window.samples_);
  window.samples_ = std::max(window.samples_, 1);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window.window_, true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
  return window;
}

Expected<host::SceneLoader::Context> Window::make_loader_context() {
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  loader_window_ = glfwCreateWindow(16, 16, "sward loader", nullptr, window_);
  if (loader_window_ == nullptr) return fail("no second OpenGL context for loading: " + glfw_reason());
  GLFWwindow* const window = loader_window_;
  return host::SceneLoader::Context{[window] {
                                      glfwMakeContextCurrent(window);
                                      return glfwGetCurrentContext() == window;
                                    },
                                    [] { glfwMakeContextCurrent(nullptr); }};
}

Window::Window(Window&& other) noexcept
    : window_(std::exchange(other.window_, nullptr)),
      loader_window_(std::exchange(other.loader_window_, nullptr)),
      samples_(other.samples_),
      cursor_(other.cursor_),
      looking_(other.looking_),
      keys_down_(std::move(other.keys_down_)) {}

Window::~Window() {
  if (window_ == nullptr) return;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  if (loader_window_ != nullptr) glfwDestroyWindow(loader_window_);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_) != GLFW_FALSE || glfwGetKey(window_, GLFW_KEY_ESCAPE) == GLFW_PRESS;
}

void Window::begin_frame() {
  glfwPollEvents();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

glm::ivec2 Window::framebuffer_size() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

CameraInput Window::camera_input() {
  CameraInput input;
  const auto axis = [this](int plus, int minus) {
    return (glfwGetKey(window_, plus) == GLFW_PRESS ? 1 : 0) - (glfwGetKey(window_, minus) == GLFW_PRESS ? 1 : 0);
  };
  if (!ImGui::GetIO().WantCaptureKeyboard) {
    input.forward = axis(GLFW_KEY_W, GLFW_KEY_S);
    input.right = axis(GLFW_KEY_D, GLFW_KEY_A);
    input.up = axis(GLFW_KEY_E, GLFW_KEY_Q);
    input.fast = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
  }
  glm::dvec2 cursor(0);
  glfwGetCursorPos(window_, &cursor.x, &cursor.y);
  const bool held = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  const bool looking = held && (looking_ || !ImGui::GetIO().WantCaptureMouse);
  if (looking != looking_) glfwSetInputMode(window_, GLFW_CURSOR, looking ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  // The cursor may jump when it is caught, so the first frame only remembers it.
  if (looking && looking_) input.look = (cursor_ - cursor) * k_radians_a_pixel;
  cursor_ = cursor;
  looking_ = looking;
  return input;
}

bool Window::pressed_once(int glfw_key) {
  const bool down = glfwGetKey(window_, glfw_key) == GLFW_PRESS;
  const auto known = std::find(keys_down_.begin(), keys_down_.end(), glfw_key);
  if (down && known == keys_down_.end()) {
    keys_down_.push_back(glfw_key);
    return true;
  }
  if (!down && known != keys_down_.end()) keys_down_.erase(known);
  return false;
}

}  // namespace sward::tool
