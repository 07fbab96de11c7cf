// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What GL tests share: one context a process, no GL error and no debug message after every test, and the means to prove
// what an entry point binds and leaves.
#include <gtest/gtest.h>

#include <sward/gl/bindings.h>
#include <sward/gl/handles.h>
#include <map>
#include <memory>
#include <set>

#include "host/egl_context.h"

namespace sward::test {

/// The process's debug context, or why there is none.
inline Expected<host::EglContext>& shared_context() {
  static Expected<host::EglContext> context = host::EglContext::create(true);
  return context;
}

/// Performance messages that are no fault, each with its reason.
inline bool is_expected(const std::string& message) {
  // NVIDIA 131186, a buffer moves from video to host memory: tests read buffers back that the GPU has written.
  // NVIDIA 131218, a geometry shader is compiled anew for the state that it first runs in: once a program and machine.
  return message.starts_with("medium performance 131186:") || message.starts_with("medium performance 131218:");
}

/// Base of GL tests. Skips with EGL's reason where there is no context; otherwise every test ends by asserting that GL
/// has neither an error nor a debug message above notification.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Expected<host::EglContext>& context = shared_context();
    if (!context) GTEST_SKIP() << context.error().message;
    context->take_messages();
  }
  void TearDown() override {
    if (!shared_context()) return;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    for (const std::string& message : shared_context()->take_messages()) {
      if (!is_expected(message)) ADD_FAILURE() << "GL debug message: " << message;
    }
  }
  /// For tests that provoke messages: hands them over, so that the end of the test is silent.
  static std::vector<std::string> take_messages() {
    while (glGetError() != GL_NO_ERROR) {
    }
    return shared_context()->take_messages();
  }
};

// ---- State: poison, call, compare.

/// Named values of the state that any sward entry point may touch.
using GlState = std::map<std::string, std::vector<double>>;

inline constexpr GLuint k_probed_units = 18;

inline GlState capture_state() {
  GlState state;
  const auto integer = [&](const char* name, GLenum parameter, size_t count = 1) {
    GLint values[16] = {};
    glGetIntegerv(parameter, values);
    state[name].assign(values, values + count);
  };
  const auto number = [&](const char* name, GLenum parameter, size_t count = 1) {
    GLfloat values[16] = {};
    glGetFloatv(parameter, values);
    state[name].assign(values, values + count);
  };
  const auto capability = [&](const char* name, GLenum parameter) { state[name] = {double(glIsEnabled(parameter))}; };
  integer("program", GL_CURRENT_PROGRAM);
  integer("vertex array", GL_VERTEX_ARRAY_BINDING);
  integer("draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING);
  integer("read framebuffer", GL_READ_FRAMEBUFFER_BINDING);
  integer("transform feedback", GL_TRANSFORM_FEEDBACK_BINDING);
  integer("array buffer", GL_ARRAY_BUFFER_BINDING);
  integer("uniform buffer", GL_UNIFORM_BUFFER_BINDING);
  integer("storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING);
  integer("indirect buffer", GL_DRAW_INDIRECT_BUFFER_BINDING);
  integer("copy read buffer", GL_COPY_READ_BUFFER_BINDING);
  integer("copy write buffer", GL_COPY_WRITE_BUFFER_BINDING);
  integer("pack buffer", GL_PIXEL_PACK_BUFFER_BINDING);
  integer("unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING);
  integer("texture buffer", GL_TEXTURE_BUFFER_BINDING);
  integer("active texture", GL_ACTIVE_TEXTURE);
  integer("patch vertices", GL_PATCH_VERTICES);
  integer("depth function", GL_DEPTH_FUNC);
  integer("depth mask", GL_DEPTH_WRITEMASK);
  integer("color mask", GL_COLOR_WRITEMASK, 4);
  integer("cull face", GL_CULL_FACE_MODE);
  integer("front face", GL_FRONT_FACE);
  integer("polygon mode", GL_POLYGON_MODE);
  integer("blend source", GL_BLEND_SRC_RGB);
  integer("blend destination", GL_BLEND_DST_RGB);
  integer("viewport", GL_VIEWPORT, 4);
  integer("scissor box", GL_SCISSOR_BOX, 4);
  integer("unpack alignment", GL_UNPACK_ALIGNMENT);
  integer("unpack row length", GL_UNPACK_ROW_LENGTH);
  integer("unpack skip pixels", GL_UNPACK_SKIP_PIXELS);
  integer("unpack skip rows", GL_UNPACK_SKIP_ROWS);
  integer("pack alignment", GL_PACK_ALIGNMENT);
  integer("pack row length", GL_PACK_ROW_LENGTH);
  number("clear color", GL_COLOR_CLEAR_VALUE, 4);
  number("clear depth", GL_DEPTH_CLEAR_VALUE);
  number("line width", GL_LINE_WIDTH);
  number("polygon offset", GL_POLYGON_OFFSET_FACTOR);
  capability("depth test", GL_DEPTH_TEST);
  capability("blend", GL_BLEND);
  capability("culling", GL_CULL_FACE);
  capability("scissor test", GL_SCISSOR_TEST);
  capability("stencil test", GL_STENCIL_TEST);
  capability("rasterizer discard", GL_RASTERIZER_DISCARD);
  capability("alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE);
  capability("sample mask", GL_SAMPLE_MASK);
  capability("sample shading", GL_SAMPLE_SHADING);
  capability("multisample", GL_MULTISAMPLE);
  capability("primitive restart", GL_PRIMITIVE_RESTART);
  capability("fixed primitive restart", GL_PRIMITIVE_RESTART_FIXED_INDEX);
  capability("framebuffer sRGB", GL_FRAMEBUFFER_SRGB);
  capability("depth clamp", GL_DEPTH_CLAMP);
  capability("polygon offset fill", GL_POLYGON_OFFSET_FILL);
  capability("seamless cube maps", GL_TEXTURE_CUBE_MAP_SEAMLESS);
  for (GLuint i = 0; i < k_probed_units; ++i) {
    GLint value = 0;
    const std::string number_text = std::to_string(i);
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &value);
    state["uniform buffer " + number_text] = {double(value)};
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, std::min(i, 7u), &value);
    state["storage buffer " + std::to_string(std::min(i, 7u))] = {double(value)};
    for (const auto& [name, target] :
         {std::pair{"texture 2D ", GL_TEXTURE_BINDING_2D}, std::pair{"texture 2D array ", GL_TEXTURE_BINDING_2D_ARRAY},
          std::pair{"texture buffer ", GL_TEXTURE_BINDING_BUFFER}, std::pair{"sampler ", GL_SAMPLER_BINDING}}) {
      glGetIntegeri_v(GLenum(target), i, &value);
      state[name + number_text] = {double(value)};
    }
  }
  for (GLuint i = 0; i < 4; ++i) {
    GLint value = 0;
    glGetIntegeri_v(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, i, &value);
    state["feedback buffer " + std::to_string(i)] = {double(value)};
  }
  return state;
}

/// Fills all that capture_state() sees with unusual values that a call's documentation does not ask the host for, and
/// puts the defaults back on destruction. Depth test, culling, blending, masks, viewport and framebuffer stay as they
/// are: those are the host's to choose.
class PoisonedState {
 public:
  PoisonedState() {
    const GLuint buffer = make_buffer();
    glUseProgram(make_program());
    for (const GLenum target : k_buffer_targets) glBindBuffer(target, buffer);
    for (GLuint i = 0; i < k_probed_units; ++i) {
      glBindBufferBase(GL_UNIFORM_BUFFER, i, buffer);
      if (i < 8) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer);
      glBindTextureUnit(i, texture_.id());
    }
    glBindVertexArray(vertex_array_.id());
    glActiveTexture(GL_TEXTURE5);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 7);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 2);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    glClearColor(0.25f, 0.5f, 0.75f, 0.125f);
    glClearDepth(0.375);
  }
  ~PoisonedState() {
    for (const GLenum target : k_buffer_targets) glBindBuffer(target, 0);
    for (GLuint i = 0; i < k_probed_units; ++i) {
      glBindBufferBase(GL_UNIFORM_BUFFER, i, 0);
      if (i < 8) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
      glBindTextureUnit(i, 0);
    }
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPatchParameteri(GL_PATCH_VERTICES, 3);
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
  }
  PoisonedState(const PoisonedState&) = delete;
  PoisonedState& operator=(const PoisonedState&) = delete;

 private:
  static constexpr GLenum k_buffer_targets[] = {GL_ARRAY_BUFFER,      GL_UNIFORM_BUFFER,      GL_SHADER_STORAGE_BUFFER,
                                                GL_COPY_READ_BUFFER,  GL_COPY_WRITE_BUFFER,   GL_TEXTURE_BUFFER,
                                                GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_DRAW_INDIRECT_BUFFER};
  GLuint make_buffer() {
    buffer_ = gl::create_buffer();
    glNamedBufferStorage(buffer_.id(), 4096, nullptr, GL_DYNAMIC_STORAGE_BIT);
    texture_ = gl::create_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture_.id(), 1, GL_RGBA8, 1, 1);
    vertex_array_ = gl::create_vertex_array();
    return buffer_.id();
  }
  GLuint make_program() {
    program_ = gl::Program(glCreateProgram());
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    const char* const text = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program_.id(), shader);
    glLinkProgram(program_.id());
    glDeleteShader(shader);
    return program_.id();
  }
  gl::Program program_;
  gl::Buffer buffer_;
  gl::Texture texture_;
  gl::VertexArray vertex_array_;
};

/// Asserts that between the two captures exactly the names in `left` may differ, and that each of those has the value
/// that the entry point promises.
inline void expect_only_changed(const GlState& before, const GlState& after, const GlState& left) {
  for (const auto& [name, value] : after) {
    const auto promised = left.find(name);
    EXPECT_EQ(value, promised != left.end() ? promised->second : before.at(name)) << name;
  }
  for (const auto& [name, value] : left) EXPECT_TRUE(after.contains(name)) << "no such state: " << name;
}

}  // namespace sward::test
