// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <epoxy/gl.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "host/egl_context.h"
#include "host/scene_renderer.h"
#include "sward/commands/commands.h"
#include "sward/output/video.h"

namespace sward::tool {

namespace {

struct Limit {
  const char* name;
  GLenum query;
};
constexpr Limit k_limits[] = {
    {"samples", GL_MAX_SAMPLES},
    {"transform feedback streams", GL_MAX_VERTEX_STREAMS},
    {"tessellation level", GL_MAX_TESS_GEN_LEVEL},
    {"geometry shader invocations", GL_MAX_GEOMETRY_SHADER_INVOCATIONS},
    {"texture size", GL_MAX_TEXTURE_SIZE},
    {"buffer texture texels", GL_MAX_TEXTURE_BUFFER_SIZE},
    {"uniform block bytes", GL_MAX_UNIFORM_BLOCK_SIZE},
};

void print_gl_string(const char* name, GLenum query) {
  const auto* text = reinterpret_cast<const char*>(glGetString(query));
  std::printf("%-28s %s\n", name, text != nullptr ? text : "unknown");
}

void print_missing() {
  bool none = true;
  const auto missing = [&none](bool is_missing, const char* text) {
    if (is_missing) std::printf("%-28s %s\n", none ? "missing" : "", text);
    none = none && !is_missing;
  };
  missing(epoxy_gl_version() < 45, "OpenGL 4.5: nothing can be drawn");
  missing(!host::gpu_can_time(), "usable timer queries (software renderer): gpu_*_ms are null");
  missing(find_program("ffmpeg").empty(), "ffmpeg: no fly --video");
#ifndef SWARD_IMAGE_IO
  missing(true, "image_io (not in this build): no height and colour maps, pictures as .ppm only");
#endif
#ifndef SWARD_WINDOW
  missing(true, "window (not in this build): no view");
#endif
  if (none) std::printf("%-28s %s\n", "missing", "nothing");
}

Expected<void> info() {
  auto context = host::EglContext::create(false);
  if (!context) return tl::unexpected(context.error());
  print_gl_string("GL vendor", GL_VENDOR);
  print_gl_string("GL renderer", GL_RENDERER);
  print_gl_string("GL version", GL_VERSION);
  print_gl_string("GLSL version", GL_SHADING_LANGUAGE_VERSION);
  for (const Limit& limit : k_limits) {
    GLint value = 0;
    glGetIntegerv(limit.query, &value);
    std::printf("%-28s %d\n", limit.name, value);
  }
  print_missing();
  return {};
}

}  // namespace

Command add_info(CLI::App& parent) {
  return {parent.add_subcommand("info", "What the GL driver offers, and what is missing"), info};
}

}  // namespace sward::tool
