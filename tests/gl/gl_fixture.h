// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What GL tests share: one context a process, no GL error and no debug message after every test; gl_state.h proves what
// an entry point binds and leaves.
#include <gtest/gtest.h>

#include <sward/gl/bindings.h>
#include <sward/gl/handles.h>
#include <memory>

#include "gl/gl_state.h"
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

}  // namespace sward::test
