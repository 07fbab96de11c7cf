// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The smallest host: a window of GLFW's, hills, grass on them. W and S walk, A and D turn, Escape ends; `--frames N`
// ends it after so many frames.

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string_view>

#include "hills.h"

using namespace hello;

namespace {

GLFWwindow* open_window() {
  if (glfwInit() == GLFW_FALSE) give_up("no window can be opened here; without a display run hello_headless");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  GLFWwindow* window = glfwCreateWindow(960, 540, "hello, sward", nullptr, nullptr);
  if (window == nullptr) give_up("no window with OpenGL 4.5 can be opened; is the driver recent?");
  glfwMakeContextCurrent(window);
  return window;
}

int key(GLFWwindow* window, int plus, int minus) {
  return int(glfwGetKey(window, plus) == GLFW_PRESS) - int(glfwGetKey(window, minus) == GLFW_PRESS);
}

void run(GLFWwindow* window, int frames) {
  // embedding: once
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = 513;
  desc.spacing = {2, 2};  // metres
  auto field = need(sward::HeightField::create(desc, heights()));
  auto base_map = colors(field);
  auto landscape = need(sward::Landscape::create({std::move(field), std::move(base_map), {grass()}}));
  auto lighting = sward::gl::Lighting::clear_day(2.4f, 0.6f);  // the sun's azimuth and elevation, radians
  // embedding: end

  GLint samples = 1;
  glGetIntegerv(GL_SAMPLES, &samples);
  glm::dvec2 at(0);
  double yaw = 1;
  while (!glfwWindowShouldClose(window) && glfwGetKey(window, GLFW_KEY_ESCAPE) != GLFW_PRESS && frames-- != 0) {
    glfwPollEvents();
    yaw += 0.03 * key(window, GLFW_KEY_A, GLFW_KEY_D);
    at += 0.1 * key(window, GLFW_KEY_W, GLFW_KEY_S) * glm::dvec2(std::cos(yaw), std::sin(yaw));
    at = glm::clamp(at, landscape.field().min_corner(), landscape.field().max_corner());
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window, &size.x, &size.y);
    if (size.x == 0 || size.y == 0) continue;
    const double time = glfwGetTime();
    begin_frame(size);

    // embedding: each frame
    glm::dvec3 eye(at, landscape.field().height(at) + 1.7);
    auto view = sward::View::look(eye, yaw, -0.1, 0.87, size, 0.1, 4000);
    need(landscape.draw(view, lighting, time, samples));
    // embedding: end

    glfwSwapBuffers(window);
  }
}

}  // namespace

int main(int argc, char** argv) {
  int frames = -1;
  if (argc == 3 && argv[1] == std::string_view("--frames")) {
    frames = std::atoi(argv[2]);
  } else if (argc != 1) {
    give_up("unknown arguments; hello [--frames N]");
  }
  GLFWwindow* window = open_window();
  run(window, frames);  // what it made is gone before the context is
  glfwDestroyWindow(window);
  glfwTerminate();
}
