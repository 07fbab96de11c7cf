// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Detail textures on the ground as shaders compute them, on planes that face the eye or lie under it.
#include <sward/gl/frame.h>
#include <sward/gl/ground.h>
#include <sward/gl/shader_library.h>

#include <cmath>
#include <numbers>

#include "gl/gl_fixture.h"

namespace sward {
namespace {

constexpr int k_side = 96;
constexpr double k_fov = 0.8;

// Outputs by `mode`: 0, shares of the colour that the fragment's place names; 1, what is put on the base map's colour
// at the place of a plane that the pixel's ray meets.
constexpr const char* k_probe = R"(
#include "common_ground.glsl"
layout(location = 0) uniform int mode;
layout(location = 1) uniform vec4 plane;  // normal; distance from the eye, negative below
layout(location = 2) uniform vec3 base;   // linear
layout(location = 0) out vec4 answer;
void main() {
  vec2 at = gl_FragCoord.xy * frame.viewport.zw;
  if (mode == 0) {
    BestMaterials best = materials_at(vec3(at, base.b));
    vec3 shares = material_shares_of(best);
    answer = vec4(shares, float(best.first + 1) + 32.0 * float(best.second + 1) + 1024.0 * float(best.third + 1));
    return;
  }
  vec4 far = frame.relative_from_clip * vec4(2.0 * at - 1.0, 0.5, 1.0);
  vec3 ray = far.xyz / far.w;
  vec3 point = ray * (plane.w / dot(plane.xyz, ray));
  GroundDetail detail = ground_detail(point, plane.xyz);
  answer = vec4(material_shade(base, detail), 1.0);
}
)";
constexpr const char* k_everywhere = R"(
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
)";

struct Answer {
  std::vector<glm::vec4> pixels;
  glm::vec4 at(int x, int y) const { return pixels[size_t(y) * k_side + size_t(x)]; }
  double luminance(int x, int y) const { return glm::dot(glm::vec3(at(x, y)), glm::vec3(0.2126f, 0.7152f, 0.0722f)); }
};

class Splat : public test::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    gl::ShaderLibrary library;
    library.add_source("probe.frag.glsl", k_probe);
    library.add_source("probe.vert.glsl", k_everywhere);
    gl::ProgramDesc desc;
    desc.name = "probe";
    desc.vertex = "probe.vert.glsl";
    desc.fragment = "probe.frag.glsl";
    desc.defines = gl::binding_defines(bindings_);
    auto program = library.build(desc);
    ASSERT_TRUE(program) << program.error().message;
    program_ = std::move(*program);
    auto frame = gl::Frame::create();
    ASSERT_TRUE(frame);
    frame_ = std::make_unique<gl::Frame>(std::move(*frame));
    HeightFieldDesc field;
    field.columns = field.rows = 3;
    auto flat = HeightField::create(field, std::vector<float>(9, 0.0f));
    ASSERT_TRUE(flat) << flat.error().message;
    auto ground = gl::GroundTextures::create(*flat, {1, 1, {{128, 128, 128, 255}}, {-1, -1}, {2, 2}});
    ASSERT_TRUE(ground) << ground.error().message;
    ground_ = std::make_unique<gl::GroundTextures>(std::move(*ground));
    color_ = gl::create_texture(GL_TEXTURE_2D);
    glTextureStorage2D(color_.id(), 1, GL_RGBA32F, k_side, k_side);
    framebuffer_ = gl::create_framebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, color_.id(), 0);
    vertex_array_ = gl::create_vertex_array();
  }

  void set_materials(const std::vector<GroundMaterial>& materials) {
    const auto set = ground_->set_materials(materials);
    ASSERT_TRUE(set) << set.error().message;
  }

  Answer draw(const View& view, int mode, glm::vec4 plane, glm::vec3 base) {
    frame_->upload(view, {}, 0, 1);
    const GLuint frame = frame_->buffer(), materials = ground_->materials();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, k_side, k_side);
    glProgramUniform1i(program_.id(), 0, mode);
    glProgramUniform4f(program_.id(), 1, plane.x, plane.y, plane.z, plane.w);
    glProgramUniform3f(program_.id(), 2, base.r, base.g, base.b);
    glUseProgram(program_.id());
    glBindVertexArray(vertex_array_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, bindings_.frame, frame);
    glBindBufferBase(GL_UNIFORM_BUFFER, bindings_.materials, materials);
    glBindTextureUnit(bindings_.detail, ground_->detail());
    glBindTextureUnit(bindings_.detail_slope, ground_->detail_slope());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Answer answer{std::vector<glm::vec4>(size_t(k_side) * k_side)};
    glReadPixels(0, 0, k_side, k_side, GL_RGBA, GL_FLOAT, answer.pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(0);
    glBindVertexArray(0);
    return answer;
  }

  /// A plane at `distance` across the view's middle, of a slope (radians) towards the eye, seen along its normal.
  Answer face(double slope, double azimuth, double distance) {
    const glm::dvec3 normal(std::sin(slope) * std::cos(azimuth), std::sin(slope) * std::sin(azimuth), std::cos(slope));
    const View view = View::look({300.25, 411.5, 37}, azimuth + std::numbers::pi, slope - std::numbers::pi / 2, k_fov,
                                 {k_side, k_side}, 0.01, 1e6);
    return draw(view, 1, glm::vec4(glm::vec3(normal), float(-distance)), glm::vec3(0.2f));
  }

  gl::Bindings bindings_;
  gl::Program program_;
  std::unique_ptr<gl::Frame> frame_;
  std::unique_ptr<gl::GroundTextures> ground_;
  gl::Texture color_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray vertex_array_;
};

std::vector<GroundMaterial> one_everywhere(const char* detail) {
  GroundMaterial m;
  m.name = m.detail = detail;
  return {m};
}

// The colours of a slice of the colour cube: every material's share is what the CPU says.
TEST_F(Splat, SharesAreThoseOfTheCpu) {
  const std::vector<GroundMaterial> materials = default_ground_materials();
  set_materials(materials);
  std::vector<float> expected(materials.size());
  const View view = View::look({0, 0, 2}, 0, -1, k_fov, {k_side, k_side}, 0.1, 100);
  int several = 0;
  for (const float blue : {0.1f, 0.3f, 0.55f, 0.9f}) {
    const Answer answer = draw(view, 0, {0, 0, 1, -1}, {0, 0, blue});
    for (int y = 0; y < k_side; ++y) {
      for (int x = 0; x < k_side; ++x) {
        const glm::vec3 srgb((float(x) + 0.5f) / k_side, (float(y) + 0.5f) / k_side, blue);
        material_shares(materials, srgb, expected);
        std::vector<float> drawn(materials.size(), 0.0f);
        const int code = int(answer.at(x, y).w);
        const int indices[] = {code % 32 - 1, code / 32 % 32 - 1, code / 1024 - 1};
        for (int i = 0; i < 3; ++i)
          if (indices[i] >= 0) drawn[size_t(indices[i])] = answer.at(x, y)[i];
        for (size_t i = 0; i < materials.size(); ++i)
          ASSERT_NEAR(drawn[i], expected[i], 2e-3) << materials[i].name << " at " << x << " " << y << " " << blue;
        several += answer.at(x, y).y > 0.1f ? 1 : 0;
      }
    }
  }
  EXPECT_GT(several, 500) << "the slices must hold borders";
}

// Change along the picture's two axes: equal where nothing is stretched.
TEST_F(Splat, CliffsAreNotStretched) {
  std::vector<GroundMaterial> materials = one_everywhere("gravel");
  materials[0].cliff_tile_m = materials[0].tile_m;
  set_materials(materials);
  for (const double degrees : {0.0, 20.0, 45.0, 60.0, 80.0, 90.0}) {
    for (const double azimuth : {0.0, 0.7, 2.5, 4.0}) {
      const Answer answer = face(degrees * std::numbers::pi / 180, azimuth, 1.6);
      double across = 0, down = 0;
      for (int y = 1; y < k_side; ++y) {
        for (int x = 1; x < k_side; ++x) {
          across += std::abs(answer.luminance(x, y) - answer.luminance(x - 1, y));
          down += std::abs(answer.luminance(x, y) - answer.luminance(x, y - 1));
        }
      }
      EXPECT_NEAR(std::log2(across / down), 0, 0.6) << degrees << " degrees, azimuth " << azimuth;
      EXPECT_GT(across, 20) << degrees;
    }
  }
}

struct Statistics {
  double mean = 0, deviation = 0;
};
Statistics statistics(const Answer& answer) {
  Statistics s;
  for (int y = 0; y < k_side; ++y)
    for (int x = 0; x < k_side; ++x) s.mean += answer.luminance(x, y) / (k_side * k_side);
  for (int y = 0; y < k_side; ++y)
    for (int x = 0; x < k_side; ++x) {
      const double d = answer.luminance(x, y) - s.mean;
      s.deviation += d * d / (k_side * k_side);
    }
  s.deviation = std::sqrt(s.deviation);
  return s;
}

// A quarter of a pixel to the side: what is filtered changes by much less than it varies, what aliases by more.
TEST_F(Splat, NothingAliasesAtAnyDistance) {
  for (const char* detail : {"gravel", "grass", "litter"}) {
    set_materials(one_everywhere(detail));
    for (const double distance : {0.8, 2.0, 5.0, 12.0, 30.0, 80.0, 250.0}) {
      const View view = View::look({0, 0, distance}, 0.3, -0.9, k_fov, {k_side, k_side}, 0.01, 1e6);
      View moved = view;
      // Straight to the left, by a quarter of the pixels in the middle.
      const double pixel = distance / std::sin(0.9) / view.focal_px().x;
      moved.eye += 0.25 * pixel * glm::dvec3(-std::sin(0.3), std::cos(0.3), 0);
      const Answer one = draw(view, 1, {0, 0, 1, float(-distance)}, glm::vec3(0.2f));
      const Answer two = draw(moved, 1, {0, 0, 1, float(-distance)}, glm::vec3(0.2f));
      double difference = 0;
      for (int y = 0; y < k_side; ++y)
        for (int x = 0; x < k_side; ++x) {
          const double d = one.luminance(x, y) - two.luminance(x, y);
          difference += d * d / (k_side * k_side);
        }
      const double deviation = statistics(one).deviation;
      if (deviation < 0.005) continue;  // nothing is left that could flicker
      EXPECT_LT(std::sqrt(difference), 0.62 * deviation) << detail << " at " << distance;
    }
    EXPECT_GT(statistics(face(0, 0, 1.5)).deviation, 0.15) << "near the eye there is something to see";
    const Answer far = face(0, 0, 4000);
    EXPECT_LT(statistics(far).deviation, 0.01) << "far away the ground is the base map";
  }
}

// Whatever the scale, the mean is the base map's colour.
TEST_F(Splat, TheMeanIsOneAtEveryDistanceAndOnEverySlope) {
  for (const std::string_view detail : generated_details()) {
    std::vector<GroundMaterial> materials = one_everywhere(std::string(detail).c_str());
    materials[0].cliff_tile_m = 1;
    set_materials(materials);
    for (const double distance : {8.0, 60.0, 200.0, 600.0}) {
      const double bound = distance < 30 ? 0.1 : 0.025;  // few tiles in the picture: their share is chance
      EXPECT_NEAR(statistics(face(0, 0, distance)).mean, 1, bound) << detail << " at " << distance;
      EXPECT_NEAR(statistics(face(1.3, 0.4, distance)).mean, 1, bound) << detail << " on a cliff at " << distance;
    }
  }
}

// As the eye passes the place where the ground's coordinates begin anew, nothing changes.
TEST_F(Splat, ThePeriodHasNoSeam) {
  std::vector<GroundMaterial> materials = one_everywhere("litter");
  materials[0].tile_m = 1.37f;  // not a whole number of times in the period
  set_materials(materials);
  for (const double height : {1.5, 40.0}) {
    Answer sides[2];
    for (const int side : {0, 1}) {
      const glm::dvec3 eye(1024 + (side == 0 ? -1e-5 : 1e-5), 2048 + (side == 0 ? -1e-5 : 1e-5), height);
      const View view = View::look(eye, 0.5, -1.2, k_fov, {k_side, k_side}, 0.01, 1e6);
      sides[side] = draw(view, 1, {0, 0, 1, float(-height)}, glm::vec3(0.2f));
    }
    double most = 0;
    for (int y = 0; y < k_side; ++y)
      for (int x = 0; x < k_side; ++x)
        most = std::max(most, std::abs(sides[0].luminance(x, y) - sides[1].luminance(x, y)));
    EXPECT_LT(most, 0.05) << height;
  }
}

TEST_F(Splat, SettingMaterialsLeavesStateAsItWas) {
  const std::vector<GroundMaterial> materials = default_ground_materials();
  const test::PoisonedState poison;
  const test::GlState before = test::capture_state();
  const auto set = ground_->set_materials(materials);
  EXPECT_TRUE(set) << set.error().message;
  test::expect_only_changed(before, test::capture_state(), {});
}

TEST_F(Splat, WrongMaterialsChangeNothing) {
  set_materials(default_ground_materials());
  const GLuint detail = ground_->detail(), buffer = ground_->materials();
  std::vector<GroundMaterial> wrong = default_ground_materials();
  wrong[2].tile_m = -1;
  const auto set = ground_->set_materials(wrong);
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().message.find("\"gravel\": tile_m"), std::string::npos) << set.error().message;
  EXPECT_EQ(ground_->detail(), detail);
  EXPECT_EQ(ground_->materials(), buffer);
}

}  // namespace
}  // namespace sward
