// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The smallest host: a window of GLFW's, a height field from a function, grass on it. Everything that a host has to do
// is in this file. W and S walk, A and D turn, Escape ends. An argument ends it after so many frames.

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <sward/terrain/terrain.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr int k_samples = 513;
constexpr double k_spacing = 2.0;  // metres

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "hello: error: %s\n", why.c_str());
  std::exit(1);
}

// Everything that can fail returns an Expected: a value, or an Error with one sentence.
template <class T>
T need(sward::Expected<T> result) {
  if (!result) give_up(result.error().message);
  return std::move(*result);
}

float height_at(int column, int row) {
  return float(8 * std::sin(column * 0.045) * std::cos(row * 0.037) + 2 * std::sin(column * 0.21 + row * 0.13));
}

sward::HeightField make_hills() {
  std::vector<float> heights;
  for (int row = 0; row < k_samples; ++row)
    for (int column = 0; column < k_samples; ++column) heights.push_back(height_at(column, row));
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = k_samples;
  desc.spacing = {k_spacing, k_spacing};
  return need(sward::HeightField::create(desc, std::move(heights)));
}

// One green texel: plants take the ground's colour, and this one is everywhere.
sward::ColorMap make_colors(const sward::HeightField& field) {
  return {1, 1, {{96, 120, 48, 255}}, field.min_corner(), field.max_corner() - field.min_corner()};
}

sward::Layer make_grass() {
  sward::Species grass;
  grass.name = "grass";
  grass.reference_hsv = {0.22f, 0.6f, 0.47f};
  sward::Layer layer;
  layer.species = {grass};
  layer.horizon_m = 60;
  return layer;
}

GLFWwindow* open_window() {
  if (glfwInit() == GLFW_FALSE) give_up("no window can be opened here (is there a display?)");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  GLFWwindow* window = glfwCreateWindow(960, 540, "hello, sward", nullptr, nullptr);
  if (window == nullptr) give_up("no window with OpenGL 4.5 can be opened");
  glfwMakeContextCurrent(window);
  return window;
}

int key(GLFWwindow* window, int plus, int minus) {
  return int(glfwGetKey(window, plus) == GLFW_PRESS) - int(glfwGetKey(window, minus) == GLFW_PRESS);
}

void run(GLFWwindow* window, int frames) {
  // Once: terrain and its bounds, the mesh, and what draws them.
  const sward::HeightField field = make_hills();
  const sward::ColorMap colors = make_colors(field);
  const sward::Bounds bounds = sward::Bounds::create(field);
  sward::RoamMesh mesh = need(sward::RoamMesh::create(bounds, {}));
  const sward::Layer layer = make_grass();
  const sward::gl::ShaderLibrary shaders;
  sward::gl::Frame frame = need(sward::gl::Frame::create());
  const auto ground = need(sward::gl::GroundTextures::create(field, colors));
  auto terrain = need(sward::TerrainRenderer::create(shaders));
  auto grass = need(sward::VegetationRenderer::create(layer, shaders));
  const auto lighting = sward::gl::Lighting::clear_day(2.4f, 0.6f);
  sward::FixedLevelOptions cut;
  cut.level = sward::level_for_area(field, layer.triangle_area_m2);
  cut.horizon_m = layer.horizon_m;
  cut.canopy_m = sward::canopy_height(layer);
  cut.spread_m = sward::canopy_spread(layer);
  sward::FixedTriangles triangles;
  sward::Seeding seeding;
  GLint samples = 1;
  glGetIntegerv(GL_SAMPLES, &samples);

  glm::dvec2 at(0);
  double yaw = 1;
  while (!glfwWindowShouldClose(window) && glfwGetKey(window, GLFW_KEY_ESCAPE) != GLFW_PRESS && frames-- != 0) {
    glfwPollEvents();
    yaw += 0.03 * key(window, GLFW_KEY_A, GLFW_KEY_D);
    at += 0.1 * key(window, GLFW_KEY_W, GLFW_KEY_S) * glm::dvec2(std::cos(yaw), std::sin(yaw));
    at = glm::clamp(at, field.min_corner(), field.max_corner());
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window, &size.x, &size.y);
    if (size.x == 0 || size.y == 0) continue;
    const sward::View view = sward::View::look({at, field.height(at) + 1.7}, yaw, -0.1, 0.87, size, 0.1, 4000);

    // The CPU's share: the mesh follows the view, its triangles near the eye are seeded.
    need(mesh.update(view));
    mesh.fixed_level_triangles(cut, triangles);
    sward::seed(layer, view, colors, triangles, seeding);

    // The host's own state: sward draws into whatever is bound.
    glViewport(0, 0, size.x, size.y);
    glClearColor(0.62f, 0.74f, 0.90f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);

    // The GPU's share.
    frame.upload(view, lighting, glfwGetTime(), samples);
    terrain.upload(mesh);
    terrain.draw(view, frame, ground);
    if (auto uploaded = grass.upload(seeding, triangles, view); !uploaded) give_up(uploaded.error().message);
    grass.classify(frame, ground, 0);
    grass.draw(frame, ground);
    glfwSwapBuffers(window);
  }
}

}  // namespace

int main(int argc, char** argv) {
  GLFWwindow* window = open_window();
  run(window, argc > 1 ? std::atoi(argv[1]) : -1);  // what it made is gone before the context is
  glfwDestroyWindow(window);
  glfwTerminate();
}
