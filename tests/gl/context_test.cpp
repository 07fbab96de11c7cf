// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The headless context, per-view uniforms, lighting and render targets.
#include <sward/gl/frame.h>
#include <sward/gl/shader_library.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <thread>

#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

class Context : public test::GlTest {};
class FrameBlock : public test::GlTest {};
class Target : public test::GlTest {};

TEST_F(Context, IsCoreOfAtLeast45AndRecordsMessages) {
  EXPECT_GE(epoxy_gl_version(), 45);
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
  glBindBuffer(GL_ARRAY_BUFFER, 4711);  // not a name from glGenBuffers: an error in core
  const std::vector<std::string> messages = take_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_TRUE(messages.front().starts_with("high error ")) << messages.front();
  EXPECT_TRUE(take_messages().empty());
}

TEST_F(Context, InsertedNotificationsAreNotRecordedAndWarningsAre) {
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 1, GL_DEBUG_SEVERITY_NOTIFICATION, -1,
                       "quiet");
  EXPECT_TRUE(take_messages().empty());
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 7, GL_DEBUG_SEVERITY_LOW, -1, "loud");
  EXPECT_EQ(take_messages(), std::vector<std::string>{"low performance 7: loud"});
}

TEST_F(Context, WithoutOneCreationFailsInsteadOfAborting) {
  Expected<void> result;
  // A thread of its own has no current context.
  std::thread([&] { result = gl::require_context(); }).join();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("no OpenGL context is current"), std::string::npos) << result.error().message;
}

TEST_F(Context, StateComparisonNoticesWhatIsLeftBehind) {
  const test::PoisonedState poison;
  const test::GlState before = test::capture_state();
  const gl::VertexArray other = gl::create_vertex_array();
  glBindVertexArray(other.id());
  EXPECT_NE(test::capture_state(), before);
  glBindVertexArray(0);
  test::expect_only_changed(before, test::capture_state(), {{"vertex array", {0}}});
}

const char* const k_probe_vertex = R"(
#include "common_frame.glsl"
void main() {
  gl_Position = frame.clip_from_relative * frame.eye_from_relative * frame.relative_from_clip * frame.viewport +
                frame.focal + frame.sun_direction + frame.sun_radiance + frame.sky_radiance + frame.horizon_radiance +
                frame.ground_radiance + frame.eye_noise + frame.up;
}
)";

TEST_F(FrameBlock, LayoutIsWhatTheDriverSees) {
  gl::Bindings bindings;
  bindings.frame = 5;
  gl::ShaderLibrary library;
  library.add_source("probe.vert.glsl", k_probe_vertex);
  gl::ProgramDesc desc;
  desc.name = "probe";
  desc.vertex = "probe.vert.glsl";
  desc.defines = gl::binding_defines(bindings);
  const Expected<gl::Program> program = library.build(desc);
  ASSERT_TRUE(program) << program.error().message;
  const GLuint block = glGetProgramResourceIndex(program->id(), GL_UNIFORM_BLOCK, "SwardFrame");
  ASSERT_NE(block, GL_INVALID_INDEX);
  const GLenum block_properties[] = {GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
  GLint block_values[2] = {};
  glGetProgramResourceiv(program->id(), GL_UNIFORM_BLOCK, block, 2, block_properties, 2, nullptr, block_values);
  EXPECT_EQ(block_values[0], 5);
  EXPECT_EQ(size_t(block_values[1]), sizeof(gl::FrameUniforms));
  const std::pair<const char*, size_t> members[] = {
      {"clip_from_relative", offsetof(gl::FrameUniforms, clip_from_relative)},
      {"eye_from_relative", offsetof(gl::FrameUniforms, eye_from_relative)},
      {"relative_from_clip", offsetof(gl::FrameUniforms, relative_from_clip)},
      {"viewport", offsetof(gl::FrameUniforms, viewport)},
      {"focal", offsetof(gl::FrameUniforms, focal)},
      {"sun_direction", offsetof(gl::FrameUniforms, sun_direction)},
      {"sun_radiance", offsetof(gl::FrameUniforms, sun_radiance)},
      {"sky_radiance", offsetof(gl::FrameUniforms, sky_radiance)},
      {"horizon_radiance", offsetof(gl::FrameUniforms, horizon_radiance)},
      {"ground_radiance", offsetof(gl::FrameUniforms, ground_radiance)},
      {"eye_noise", offsetof(gl::FrameUniforms, eye_noise)},
      {"up", offsetof(gl::FrameUniforms, up)},
      {"ground_tint", offsetof(gl::FrameUniforms, ground_tint)},
  };
  for (const auto& [name, offset] : members) {
    const GLuint index =
        glGetProgramResourceIndex(program->id(), GL_UNIFORM, (std::string("SwardFrame.") + name).c_str());
    ASSERT_NE(index, GL_INVALID_INDEX) << name;
    const GLenum property = GL_OFFSET;
    GLint value = -1;
    glGetProgramResourceiv(program->id(), GL_UNIFORM, index, 1, &property, 1, nullptr, &value);
    EXPECT_EQ(size_t(value), offset) << name;
  }
}

View sample_view(glm::dvec3 eye) {
  return View::look(eye, 0.7, -0.2, 0.9, {640, 360}, 0.2, 20000);
}

TEST_F(FrameBlock, UploadFillsTheBufferAndBindsNothing) {
  Expected<gl::Frame> frame = gl::Frame::create();
  ASSERT_TRUE(frame) << frame.error().message;
  const View view = sample_view({1030, -5, 77});
  gl::Lighting light;
  light.sun_azimuth = 0;
  light.sun_elevation = float(std::numbers::pi / 6);
  const test::PoisonedState poison;
  const test::GlState before = test::capture_state();
  frame->upload(view, light, 12.5, 4);
  test::expect_only_changed(before, test::capture_state(), {});
  gl::FrameUniforms read;
  glGetNamedBufferSubData(frame->buffer(), 0, sizeof read, &read);
  EXPECT_EQ(frame->samples(), 4);
  EXPECT_EQ(read.viewport, glm::vec4(640, 360, 1.0f / 640, 1.0f / 360));
  EXPECT_FLOAT_EQ(read.focal.w, 12.5f);
  EXPECT_EQ(read.eye_noise, glm::vec4(6, 1019, 77, 4));
  EXPECT_NEAR(read.sun_direction.x, std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(read.sun_direction.y, 0, 1e-6);
  EXPECT_NEAR(read.sun_direction.z, 0.5, 1e-6);
  EXPECT_EQ(read.sun_direction.w, 1);
  EXPECT_EQ(read.sky_radiance.w, 1);
  EXPECT_FLOAT_EQ(read.horizon_radiance.w, 1 / light.haze_distance_m);
  EXPECT_FLOAT_EQ(read.ground_radiance.w, 1 / light.haze_height_m);
}

TEST_F(FrameBlock, NoiseOriginStaysInItsPeriodFarFromTheOrigin) {
  for (const double x : {-1e7 - 0.25, -1024.0, -0.5, 0.0, 1023.75, 1.0e7 + 0.5}) {
    const gl::FrameUniforms u = gl::make_frame_uniforms(sample_view({x, x, 0}), {}, 0, 1);
    EXPECT_GE(u.eye_noise.x, 0);
    EXPECT_LT(u.eye_noise.x, 1024);
    EXPECT_NEAR(std::remainder(u.eye_noise.x - x, 1024.0), 0, 1e-4) << x;
  }
}

TEST(ClearDay, IsSmoothAndSetsWithTheSun) {
  const double step = glm::radians(0.25);
  glm::vec3 last_sun(-1), last_sky(-1);
  float last_shine = 0;
  for (double elevation = glm::radians(-20.0); elevation < glm::radians(90.0); elevation += step) {
    const gl::Lighting light = gl::Lighting::clear_day(1, float(elevation));
    EXPECT_EQ(light.sun_elevation, float(elevation));
    EXPECT_GT(light.haze_distance_m, 0);
    EXPECT_GT(light.exposure, 0);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(light.sun_radiance[i], 0);
      EXPECT_GT(light.sky_radiance[i], 0);
      EXPECT_GT(light.horizon_radiance[i], 0);
      if (last_sun.x < 0) continue;
      EXPECT_LT(std::abs(light.sun_radiance[i] - last_sun[i]), 0.06) << elevation;
      EXPECT_LT(std::abs(light.sky_radiance[i] - last_sky[i]), 0.02) << elevation;
    }
    const float shine = gl::make_frame_uniforms(sample_view({0, 0, 0}), light, 0, 1).sun_direction.w;
    EXPECT_GE(shine, last_shine);
    if (elevation <= 0) {
      EXPECT_EQ(shine, 0);
    }
    if (elevation > glm::radians(5.0)) {
      EXPECT_EQ(shine, 1);
    }
    last_shine = shine;
    last_sun = light.sun_radiance;
    last_sky = light.sky_radiance;
  }
  const gl::Lighting low = gl::Lighting::clear_day(0, 0.1f), high = gl::Lighting::clear_day(0, 1.0f);
  EXPECT_GT(low.sun_radiance.r / low.sun_radiance.b, 1.5f * high.sun_radiance.r / high.sun_radiance.b)
      << "low sun is warm";
  EXPECT_GT(high.sun_radiance.g, low.sun_radiance.g);
}

TEST_F(Target, RefusesTooManySamplesAndImpossibleSizes) {
  const int most = host::RenderTarget::max_samples();
  EXPECT_GE(most, 4);  // GL 4.5's least
  const Expected<host::RenderTarget> too_many = host::RenderTarget::create({16, 16}, most + 1);
  ASSERT_FALSE(too_many);
  EXPECT_NE(too_many.error().message.find("maximum of this device is " + std::to_string(most)), std::string::npos)
      << too_many.error().message;
  EXPECT_FALSE(host::RenderTarget::create({16, 16}, -1));
  EXPECT_FALSE(host::RenderTarget::create({0, 16}, 1));
  EXPECT_FALSE(host::RenderTarget::create({16, 1 << 24}, 1));
  const Expected<host::RenderTarget> best = host::RenderTarget::create({16, 16}, 0);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->samples(), most);
}

TEST_F(Target, ReadsRowsFromTheTopResolved) {
  for (const int samples : {1, 4}) {
    Expected<host::RenderTarget> target = host::RenderTarget::create({5, 3}, samples);
    ASSERT_TRUE(target) << target.error().message;
    target->begin();
    EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST));
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 2, 5, 1);  // GL's third row is the top one
    glClearColor(1, 0.5f, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glScissor(0, 0, 1, 1);
    glClearColor(0, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    const std::vector<uint8_t> rgb = target->read_rgb();
    ASSERT_EQ(rgb.size(), 45u);
    EXPECT_EQ(rgb[0], 255);
    EXPECT_NEAR(rgb[1], 128, 1);
    EXPECT_EQ(rgb[2], 0);
    EXPECT_EQ(rgb[15], 0) << "middle row";
    EXPECT_EQ(rgb[32], 255) << "bottom left is blue";
    EXPECT_EQ(rgb[33 + 2], 0);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(0, 0, 0, 0);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace
}  // namespace sward
