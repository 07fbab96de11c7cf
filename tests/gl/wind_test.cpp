// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The wind on the GPU against Wind::at(), what an upload sends, and what it leaves.
#include <sward/gl/shader_library.h>
#include <sward/vegetation/wind_textures.h>

#include <cmath>
#include <random>

#include "gl/gl_fixture.h"

namespace sward {
namespace {

using namespace test;

constexpr size_t k_points = 4096;

constexpr const char* k_probe = R"(
#include "common_wind.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Winds { vec4 winds[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  WindHere here = wind_here(points[i].xyz);
  winds[2u * i] = vec4(here.velocity, here.ambient);
  winds[2u * i + 1u] = vec4(here.gust, 0.0, 0.0, 0.0);
}
)";

/// Asks the GPU for the wind at places relative to the eye.
std::vector<WindHere> wind_on_gpu(const WindTextures& wind, const std::vector<glm::vec4>& points) {
  const gl::Bindings bindings;
  gl::ShaderLibrary library;
  library.add_source("wind_probe.comp.glsl", k_probe);
  gl::ProgramDesc desc;
  desc.name = "wind probe";
  desc.compute = "wind_probe.comp.glsl";
  desc.defines = gl::binding_defines(bindings);
  const auto program = library.build(desc);
  EXPECT_TRUE(program) << program.error().message;
  if (!program) return {};
  const gl::Buffer in = gl::create_buffer(), out = gl::create_buffer();
  glNamedBufferStorage(in.id(), GLsizeiptr(points.size() * sizeof points[0]), points.data(), 0);
  std::vector<glm::vec4> read(2 * points.size());
  glNamedBufferStorage(out.id(), GLsizeiptr(read.size() * sizeof read[0]), nullptr, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.id());
  glBindBufferBase(GL_UNIFORM_BUFFER, bindings.wind, wind.block());
  glBindTextureUnit(bindings.wind_maps, wind.maps());
  glBindTextureUnit(bindings.wind_grid, wind.grid());
  glBindTextureUnit(bindings.wind_painted, wind.painted());
  glUseProgram(program->id());
  glDispatchCompute(GLuint(points.size() / 64), 1, 1);
  glUseProgram(0);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(out.id(), 0, GLsizeiptr(read.size() * sizeof read[0]), read.data());
  std::vector<WindHere> winds;
  for (size_t i = 0; i < points.size(); ++i)
    winds.push_back({glm::vec2(read[2 * i]), glm::vec2(read[2 * i].z, read[2 * i].w), read[2 * i + 1].x});
  return winds;
}

std::vector<glm::vec4> places(float spread) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-spread, spread);
  std::vector<glm::vec4> points(k_points);
  for (glm::vec4& point : points) point = {place(random), place(random), 1, 0};
  return points;
}

/// Wind::at()'s promise: within 0.5 % of the strongest wind and 0.01 m/s.
void expect_twins(const Wind& wind, const WindTextures& textures, glm::dvec3 eye, float spread) {
  const std::vector<glm::vec4> points = places(spread);
  const std::vector<WindHere> gpu = wind_on_gpu(textures, points);
  ASSERT_EQ(gpu.size(), points.size());
  float strongest = 0, worst = 0, worst_gust = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const WindHere cpu = wind.at(eye + glm::dvec3(points[i]));
    ASSERT_TRUE(std::isfinite(gpu[i].velocity.x + gpu[i].velocity.y + gpu[i].ambient.x + gpu[i].ambient.y));
    strongest = std::max(strongest, glm::length(cpu.velocity) + glm::length(cpu.ambient));
    worst = std::max({worst, glm::length(cpu.velocity - gpu[i].velocity), glm::length(cpu.ambient - gpu[i].ambient)});
    worst_gust = std::max(worst_gust, std::abs(cpu.gust - gpu[i].gust));
  }
  EXPECT_LE(worst, 0.005f * strongest + 0.01f) << "of " << strongest << " m/s within " << spread << " m";
  EXPECT_LE(worst_gust, 0.01f);
  EXPECT_GT(strongest, 0.1f);
}

class WindOnGpu : public GlTest {
 protected:
  Wind wind_;
  const glm::dvec3 eye_{2'345'678.25, -1'234'567.5, 120.0};

  void blow() {
    Weather weather;
    weather.speed_m_s = 9;
    weather.from_azimuth = 2.1f;
    ASSERT_TRUE(wind_.set_weather(weather));
  }
  void stir() {
    for (int i = 0; i < 20; ++i) {
      WindSource source = whirlwind(glm::dvec2(eye_) + glm::dvec2(30 * i - 200, 17 * (i % 5)), 6, 14, 0);
      if (i % 2) source = WindSource{.position = glm::dvec2(eye_) + glm::dvec2(-100, 20.0 * i), .duration_s = 60};
      ASSERT_TRUE(wind_.add_source(source));
    }
    WindMover rotor{.kind = WindMover::Kind::rotor, .position = glm::dvec2(eye_) + glm::dvec2(25, 10)};
    rotor.radius_m = 7;
    rotor.strength = 18;
    ASSERT_TRUE(wind_.add_mover(rotor));
  }
  void go(double seconds) {
    for (double t = 0; t < seconds; t += 0.25) ASSERT_TRUE(wind_.advance(0.25, eye_));
  }
};

TEST_F(WindOnGpu, StillBeforeAnyUploadAndInDeadAir) {
  auto textures = WindTextures::create();
  ASSERT_TRUE(textures) << textures.error().message;
  ASSERT_TRUE(wind_.set_weather({.ambient_m_s = 0}));
  for (int upload = 0; upload < 2; ++upload) {
    for (const WindHere& here : wind_on_gpu(*textures, places(500))) {
      ASSERT_EQ(here.velocity, glm::vec2(0));
      ASSERT_EQ(here.ambient, glm::vec2(0));
      ASSERT_EQ(here.gust, 0.0f);
    }
    textures->upload(wind_, eye_);
  }
}

TEST_F(WindOnGpu, EqualsTheCpuInCalm) {
  auto textures = WindTextures::create();
  go(3);
  textures->upload(wind_, eye_);
  expect_twins(wind_, *textures, eye_, 40);
}

TEST_F(WindOnGpu, EqualsTheCpuWithAllOfIt) {
  auto textures = WindTextures::create();
  blow();
  stir();
  auto painted = std::make_shared<PaintedWind>();
  painted->width = 5;
  painted->height = 3;
  painted->min = glm::dvec2(eye_) - glm::dvec2(150, 90);
  painted->size_m = {400, 210};
  for (int i = 0; i < 15; ++i) painted->factors.emplace_back(0.1f * float(i), 0.7f - 0.1f * float(i));
  ASSERT_TRUE(wind_.set_painted(painted));
  go(6);
  const WindTextures::Upload sent = textures->upload(wind_, eye_);
  EXPECT_TRUE(sent.painted);
  EXPECT_GT(sent.rows, 20);
  for (const float spread : {20.0f, 60.0f, 300.0f, 3000.0f}) expect_twins(wind_, *textures, eye_, spread);
  // Without the map again.
  ASSERT_TRUE(wind_.set_painted(nullptr));
  textures->upload(wind_, eye_);
  expect_twins(wind_, *textures, eye_, 300);
}

TEST_F(WindOnGpu, AViewFromElsewhereSeesTheSameWind) {
  auto textures = WindTextures::create();
  blow();
  stir();
  go(4);
  const glm::dvec3 beside = eye_ + glm::dvec3(35.3, -18.9, 4);
  textures->upload(wind_, beside);
  expect_twins(wind_, *textures, beside, 100);
}

TEST_F(WindOnGpu, OnlyWhatHasChangedIsSent) {
  auto textures = WindTextures::create();
  blow();
  textures->upload(wind_, eye_);
  go(1);
  EXPECT_EQ(textures->upload(wind_, eye_).rows, 0) << "nothing moves";
  stir();
  go(1);
  const int all = textures->upload(wind_, eye_).rows;
  EXPECT_GT(all, 0);
  EXPECT_LT(all, 256) << "rows that the rotor does not reach";
  EXPECT_EQ(textures->upload(wind_, eye_).rows, 0) << "no time has passed";
  // Another wind: the old one's air is gone.
  Wind other;
  ASSERT_TRUE(other.set_weather({.ambient_m_s = 0}));
  ASSERT_TRUE(other.advance(1, eye_));
  textures->upload(other, eye_);
  for (const WindHere& here : wind_on_gpu(*textures, places(60))) ASSERT_EQ(here.velocity, glm::vec2(0));
  textures->upload(wind_, eye_);
  const auto walker = other.add_mover({.position = glm::dvec2(eye_) - glm::dvec2(20)});
  ASSERT_TRUE(other.move(*walker, glm::dvec2(eye_) - glm::dvec2(19), 0));
  ASSERT_TRUE(other.advance(0.5, eye_));
  textures->upload(other, eye_);
  expect_twins(other, *textures, eye_, 60);
  // And back.
  textures->upload(wind_, eye_);
  expect_twins(wind_, *textures, eye_, 60);
}

TEST_F(WindOnGpu, UploadsLeaveAllState) {
  auto painted = std::make_shared<PaintedWind>();
  painted->width = painted->height = 1;
  painted->size_m = {1, 1};
  painted->factors = {{0.5f, 0}};
  blow();
  stir();
  go(1);
  ASSERT_TRUE(wind_.set_painted(painted));
  Expected<WindTextures> textures = fail("not made");
  {
    const PoisonedState poison;
    const GlState before = capture_state();
    textures = WindTextures::create();
    ASSERT_TRUE(textures);
    textures->upload(wind_, eye_);
    expect_only_changed(before, capture_state(), {});
  }
  expect_twins(wind_, *textures, eye_, 60);
}

}  // namespace
}  // namespace sward
