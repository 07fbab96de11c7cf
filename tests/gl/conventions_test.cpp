// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Conventions that a host may bring: depth reversed and infinite, a viewport that does not begin in the corner, several
// samples, a linear target. The picture is the plain one.
#include <cmath>

#include "gl/contract_scene.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

constexpr glm::ivec2 k_size{96, 64};

/// Linear colour as floats, and depth: any format, any size.
struct Target {
  gl::Texture color, depth;
  gl::Framebuffer framebuffer = gl::create_framebuffer();
  glm::ivec2 size;

  Target(GLenum format, glm::ivec2 of, int samples = 1) : size(of) {
    color = make(format, samples);
    depth = make(GL_DEPTH_COMPONENT32F, samples);
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
    glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    EXPECT_EQ(glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER), GLenum(GL_FRAMEBUFFER_COMPLETE));
  }
  gl::Texture make(GLenum format, int samples) const {
    gl::Texture texture = gl::create_texture(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
    if (samples > 1) glTextureStorage2DMultisample(texture.id(), samples, format, size.x, size.y, GL_TRUE);
    if (samples == 1) glTextureStorage2D(texture.id(), 1, format, size.x, size.y);
    return texture;
  }
  void begin(float farthest, GLenum nearer) const {
    const float black[4] = {0, 0, 0, 1};
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glViewport(0, 0, size.x, size.y);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(nearer);
    glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &farthest);
  }
  /// Rows from the bottom, resolved.
  std::vector<glm::vec3> read(glm::ivec2 corner = {0, 0}, glm::ivec2 part = k_size) const {
    const Target plain(GL_RGBA32F, size);
    glBlitNamedFramebuffer(framebuffer.id(), plain.framebuffer.id(), 0, 0, size.x, size.y, 0, 0, size.x, size.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    std::vector<glm::vec3> pixels(size_t(part.x * part.y));
    glGetTextureSubImage(plain.color.id(), 0, corner.x, corner.y, 0, part.x, part.y, 1, GL_RGB, GL_FLOAT,
                         GLsizei(pixels.size() * sizeof(glm::vec3)), pixels.data());
    return pixels;
  }
};

/// The same frustum with depth 1 at the near plane and 0 at infinity.
View reversed(View view) {
  const double near = view.near_distance();
  view.clip_from_eye[2][2] = 0;
  view.clip_from_eye[3][2] = near;
  return view;
}

struct Difference {
  double mean = 0;
  double share = 0;  ///< Pixels that differ by more than 1 %.
};

Difference compare(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  Difference d;
  for (size_t i = 0; i < a.size(); ++i) {
    const glm::vec3 gap = glm::abs(a[i] - b[i]);
    const double most = std::max({gap.r, gap.g, gap.b});
    d.mean += most / double(a.size());
    d.share += (most > 0.01) / double(a.size());
  }
  return d;
}

class Conventions : public GlTest {
 protected:
  void TearDown() override {
    if (shared_context()) {
      glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
      glDepthFunc(GL_LESS);
      glDisable(GL_FRAMEBUFFER_SRGB);
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    GlTest::TearDown();
  }
  /// Draws both kinds of terrain with their plants' and a body's help: what a host can draw.
  static void draw(ContractScene& scene, const Target& target) { scene.draw(target.framebuffer.id()); }

  static std::vector<glm::vec3> plain_picture(ContractScene& scene, const View& view, GLenum format = GL_RGBA8) {
    const Target target(format, k_size);
    scene.look(view);
    target.begin(1, GL_LESS);
    draw(scene, target);
    return target.read();
  }
};

// The plants' places follow the frustum and do not move; only depth is rounded otherwise, so that a pixel where two
// blades lie within that of each other may change.
TEST_F(Conventions, ReversedInfiniteDepthGivesThePlainPicture) {
  const ContractWorld world;
  ContractScene scene(world);
  const View view = world.look(k_size);
  const std::vector<glm::vec3> plain = plain_picture(scene, view);
  const Target target(GL_RGBA8, k_size);
  scene.look(reversed(view));
  EXPECT_NEAR(scene.view.near_distance(), view.near_distance(), 1e-9);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  target.begin(0, GL_GREATER);
  draw(scene, target);
  const Difference d = compare(plain, target.read());
  EXPECT_LT(d.share, 0.02);
  EXPECT_LT(d.mean, 0.002);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

// Shaders know pixels by their distances alone; what is interpolated is rounded otherwise elsewhere in the target, and
// coverage that lies on the edge may fall to the other side.
TEST_F(Conventions, AnOffsetViewportGivesThePlainPictureThere) {
  const ContractWorld world;
  ContractScene scene(world);
  const View view = world.look(k_size);
  const std::vector<glm::vec3> plain = plain_picture(scene, view);
  const glm::ivec2 corner(32, 16);
  const Target target(GL_RGBA8, k_size + 2 * corner);
  scene.look(view);
  target.begin(1, GL_LESS);
  glViewport(corner.x, corner.y, k_size.x, k_size.y);
  draw(scene, target);
  const Difference d = compare(plain, target.read(corner));
  EXPECT_LT(d.share, 0.01);
  EXPECT_LT(d.mean, 0.001);
  const std::vector<glm::vec3> below = target.read({0, 0}, {target.size.x, corner.y});
  for (const glm::vec3& pixel : below) ASSERT_EQ(pixel, glm::vec3(0)) << "nothing outside of the viewport";
}

// Coverage takes the place of hashed alpha and edges are soft: the same meadow in the mean of 8 x 8 pixels.
TEST_F(Conventions, SeveralSamplesGiveThePlainPictureInTheMean) {
  if (host::RenderTarget::max_samples() < 4) GTEST_SKIP() << "this device has no 4 samples";
  const ContractWorld world;
  ContractScene scene(world);
  const View view = world.look(k_size);
  const std::vector<glm::vec3> plain = plain_picture(scene, view);
  const Target target(GL_RGBA8, k_size, 4);
  scene.samples = 4;
  scene.look(view);
  target.begin(1, GL_LESS);
  draw(scene, target);
  const std::vector<glm::vec3> smooth = target.read();
  const auto means = [](const std::vector<glm::vec3>& pixels) {
    std::vector<glm::vec3> blocks(size_t(k_size.x / 8 * (k_size.y / 8)));
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x)
        blocks[size_t(y / 8 * (k_size.x / 8) + x / 8)] += pixels[size_t(y * k_size.x + x)] / 64.0f;
    return blocks;
  };
  EXPECT_LT(compare(means(plain), means(smooth)).mean, 0.03);
}

/// encode_output() of common_light.glsl.
glm::vec3 encoded(glm::vec3 radiance, float exposure) {
  const auto curve = [](double x) { return 1.0 - std::exp(-1.15 * x * x / (x + 0.03)); };
  const auto srgb = [](double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
  const glm::dvec3 exposed = glm::dvec3(glm::max(radiance, glm::vec3(0))) * double(exposure);
  const double luminance = std::max(glm::dot(exposed, glm::dvec3(0.2126, 0.7152, 0.0722)), 1e-6);
  glm::vec3 out;
  for (int i = 0; i < 3; ++i)
    out[i] =
        float(srgb(glm::clamp(0.5 * curve(exposed[i]) + 0.5 * exposed[i] * curve(luminance) / luminance, 0.0, 1.0)));
  return out;
}

// A host that maps tones itself gets radiance. Mapped as the shaders do, it is the plain picture to a step of 8 bits
// where light is found at fragments (the ground); blades find it at vertices and interpolate before or after the curve.
TEST_F(Conventions, ALinearTargetHoldsTheRadianceOfThePlainPicture) {
  const ContractWorld world;
  ContractScene scene(world);
  const View view = world.look(k_size);
  const std::vector<glm::vec3> plain = plain_picture(scene, view, GL_RGBA32F);
  scene.lighting.encode_srgb = false;
  std::vector<glm::vec3> linear = plain_picture(scene, view, GL_RGBA32F);
  for (glm::vec3& pixel : linear) pixel = encoded(pixel, scene.lighting.exposure);
  const Difference d = compare(plain, linear);
  EXPECT_LT(d.mean, 0.004);
  EXPECT_LT(d.share, 0.05);
}

// An sRGB target with GL_FRAMEBUFFER_SRGB encodes what is linear: the host's tone mapping is then none.
TEST_F(Conventions, AnSrgbTargetEncodesLinearColour) {
  const ContractWorld world;
  ContractScene scene(world);
  const View view = world.look(k_size);
  scene.lighting.encode_srgb = false;
  const std::vector<glm::vec3> linear = plain_picture(scene, view, GL_RGBA32F);
  glEnable(GL_FRAMEBUFFER_SRGB);
  const std::vector<glm::vec3> decoded = plain_picture(scene, view, GL_SRGB8_ALPHA8);
  glDisable(GL_FRAMEBUFFER_SRGB);
  double most = 0;
  for (size_t i = 0; i < linear.size(); ++i) {
    const glm::vec3 gap = glm::abs(glm::clamp(linear[i], 0.0f, 1.0f) - decoded[i]);
    most = std::max(most, double(std::max({gap.r, gap.g, gap.b})));
  }
  EXPECT_LT(most, 0.01) << "a step of 8 bits near white is 0.009 of linear light";
}

// ---- What a host adds to the light.

constexpr const char* k_host_light = R"(
#include "common_frame.glsl"
vec3 host_fog(vec3 radiance, vec3 relative_position) { return vec3(0.0, 0.0, 1.0); }
float host_shadow(vec3 relative_position) { return 1.0; }
)";
constexpr const char* k_host_shade = R"(
vec3 host_fog(vec3 radiance, vec3 relative_position) { return radiance; }
float host_shadow(vec3 relative_position) { return 0.0; }
)";

TEST_F(Conventions, FogOfTheHostIsTheLastWordOnEverything) {
  const ContractWorld world;
  gl::ShaderLibrary shaders;
  shaders.add_source("common_host.glsl", k_host_light);
  ContractScene scene(world, shaders);
  scene.lighting.encode_srgb = false;
  int blue = 0;
  for (const glm::vec3& pixel : plain_picture(scene, world.look(k_size), GL_RGBA32F)) {
    if (pixel == glm::vec3(0)) continue;
    ++blue;
    // Blades vary a vertex's light across themselves.
    ASSERT_EQ(pixel.r + pixel.g, 0.0f);
    ASSERT_GT(pixel.b, 0.5f);
  }
  EXPECT_GT(blue, 2000);
}

TEST_F(Conventions, ShadowOfTheHostTakesTheSunAndNothingElse) {
  const ContractWorld world;
  gl::ShaderLibrary shaders;
  shaders.add_source("common_host.glsl", k_host_shade);
  ContractScene shaded(world, shaders), night(world);
  night.lighting.sun_radiance = glm::vec3(0);
  // The haze glows with the sun: not here.
  shaded.lighting.haze_distance_m = night.lighting.haze_distance_m = 1e9f;
  const View view = world.look(k_size);
  const Difference d = compare(plain_picture(shaded, view), plain_picture(night, view));
  EXPECT_LT(d.share, 0.001);
  ContractScene day(world);
  EXPECT_GT(compare(plain_picture(day, view), plain_picture(night, view)).share, 0.2);
}

}  // namespace
}  // namespace sward
