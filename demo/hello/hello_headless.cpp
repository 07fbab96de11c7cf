// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The same without a display: EGL makes the context, a framebuffer object takes the picture.
//   hello_headless [--frames N] [--size WIDTHxHEIGHT] [--picture FILE.ppm]
// says how long a host waits from the start of main() until all is created, and until the first frame is drawn.

#include <epoxy/egl.h>

#include <chrono>
#include <string_view>

#include "hills.h"

using namespace hello;

namespace {

constexpr int k_samples = 4;

struct Options {
  int frames = 1;
  glm::ivec2 size{960, 540};
  std::string picture;
};

[[noreturn]] void wrong_usage() {
  give_up("wrong arguments; hello_headless [--frames N] [--size WIDTHxHEIGHT] [--picture FILE.ppm]");
}

Options options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    const char* value = argv[i + 1];  // null at the end
    if (value == nullptr) wrong_usage();
    glm::ivec2& size = options.size;
    if (name == "--picture") {
      options.picture = value;
    } else if (name == "--frames") {
      options.frames = std::atoi(value);
    } else if (name != "--size" || std::sscanf(value, "%dx%d", &size.x, &size.y) != 2) {
      wrong_usage();
    }
  }
  if (options.frames < 1 || options.size.x < 1 || options.size.y < 1) wrong_usage();
  return options;
}

/// The first device that a driver answers for, GPU or software.
EGLDisplay open_display() {
  EGLDeviceEXT devices[16];
  EGLint count = 0;
  eglQueryDevicesEXT(16, devices, &count);
  for (int i = 0; i < count; ++i) {
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
    if (eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  }
  give_up("EGL finds no device; is a driver installed?");
}

/// Current on this thread until the process ends.
void make_context() {
  EGLDisplay display = open_display();
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    give_up("no OpenGL 4.5 without a display; is the driver recent?");
  }
}

sward::gl::Framebuffer make_target(glm::ivec2 size, int samples) {
  GLuint buffers[2];
  glCreateRenderbuffers(2, buffers);
  glNamedRenderbufferStorageMultisample(buffers[0], samples, GL_RGBA8, size.x, size.y);
  glNamedRenderbufferStorageMultisample(buffers[1], samples, GL_DEPTH_COMPONENT32F, size.x, size.y);
  sward::gl::Framebuffer target = sward::gl::create_framebuffer();
  glNamedFramebufferRenderbuffer(target.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glNamedFramebufferRenderbuffer(target.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  glDeleteRenderbuffers(2, buffers);  // they live as long as what they are attached to
  return target;
}

void write_picture(const sward::gl::Framebuffer& target, glm::ivec2 size, const std::string& path) {
  const sward::gl::Framebuffer single = make_target(size, 0);
  glBlitNamedFramebuffer(target.id(), single.id(), 0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  std::vector<char> pixels(size_t(size.x * size.y * 3));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, single.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) give_up("'" + path + "' cannot be written");
  std::fprintf(file, "P6\n%d %d\n255\n", size.x, size.y);
  for (int row = size.y - 1; row >= 0; --row) std::fwrite(&pixels[size_t(row * size.x * 3)], 3, size.x, file);
  if (std::fclose(file) != 0) give_up("'" + path + "' cannot be written");
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run(const Options& options, std::chrono::steady_clock::time_point start) {
  const sward::gl::Framebuffer target = make_target(options.size, k_samples);

  // embedding: once
  sward::HeightFieldDesc desc;
  desc.columns = desc.rows = 513;
  desc.spacing = {2, 2};  // metres
  auto field = need(sward::HeightField::create(desc, heights()));
  auto base_map = colors(field);
  auto landscape = need(sward::Landscape::create({std::move(field), std::move(base_map), {grass()}}));
  auto lighting = sward::gl::Lighting::clear_day(2.4f, 0.6f);  // the sun's azimuth and elevation, radians
  // embedding: end

  const double ready = seconds_since(start);
  for (int frame = 0; frame < options.frames; ++frame) {
    const glm::dvec2 at(0);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    begin_frame(options.size);
    glm::dvec3 eye(at, landscape.field().height(at) + 1.7);
    auto view = sward::View::look(eye, 1, -0.1, 0.87, options.size, 0.1, 4000);
    need(landscape.draw(view, lighting, frame / 60.0, k_samples, target.id()));
    glFinish();
    if (frame == 0) std::printf("ready after %.3f s, first frame after %.3f s\n", ready, seconds_since(start));
  }
  if (!options.picture.empty()) write_picture(target, options.size, options.picture);
}

}  // namespace

int main(int argc, char** argv) {
  const auto start = std::chrono::steady_clock::now();
  const Options options = options_of(argc, argv);
  make_context();
  run(options, start);  // what it made is gone before the context is
}
