// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Hosts whose OpenGL is too old, or none: every create() says so.
// epoxy first: it and EGL bring the same types.
#include <epoxy/gl.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <functional>

#include "gl/contract_scene.h"

namespace sward {
namespace {

using namespace test;

// Mesa reads it when its library is loaded into this process.
const int k_old = setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);

/// A context of any kind, current while it lives.
class AnyContext {
 public:
  AnyContext(EGLenum api, EGLint renderable, std::initializer_list<EGLint> attributes) {
    const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get == nullptr) return;
    display_ = get(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) return;
    eglBindAPI(api);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, renderable, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted, &config, 1, &count) != EGL_TRUE || count < 1) return;
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, std::data(attributes));
    if (context_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }
  ~AnyContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }
  AnyContext(const AnyContext&) = delete;
  AnyContext& operator=(const AnyContext&) = delete;
  bool current() const { return context_ != EGL_NO_CONTEXT; }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

template <class T>
std::string message_of(const Expected<T>& result) {
  return result ? "created" : result.error().message;
}

/// What every create() of the library says here, by name.
std::vector<std::pair<std::string, std::string>> all_creations() {
  const ContractWorld world;
  const gl::ShaderLibrary shaders;
  gl::ProgramDesc program;
  program.name = "mesh_body";
  program.vertex = "mesh_body.vert.glsl";
  const HeightField& field = *world.ground.field;
  const Surface& surface = *world.ground.surface;
  return {
      {"require_context", message_of(gl::require_context())},
      {"Frame", message_of(gl::Frame::create())},
      {"GroundTextures", message_of(gl::GroundTextures::create(field, world.map))},
      {"GroundTextures of a surface", message_of(gl::GroundTextures::create(surface, world.map))},
      {"SlopeMap", message_of(gl::SlopeMap::create(field))},
      {"SlopeMap of a surface", message_of(gl::SlopeMap::create(surface))},
      {"Clipmap", message_of(gl::Clipmap::create(surface, {64}))},
      {"ShaderLibrary::build", message_of(shaders.build(program))},
      {"TerrainRenderer", message_of(TerrainRenderer::create(shaders))},
      {"ClipmapRenderer", message_of(ClipmapRenderer::create(shaders))},
      {"VegetationRenderer", message_of(VegetationRenderer::create(world.layer, shaders))},
      {"VegetationRenderer for a clipmap", message_of(VegetationRenderer::create_for_clipmap(world.layer, shaders))},
      {"ClipmapSeeder", message_of(ClipmapSeeder::create(world.layer, surface, world.map, shaders))},
      {"MeshRenderer", message_of(MeshRenderer::create(world.body, world.layer, shaders))},
      {"WindTextures", message_of(WindTextures::create())},
      {"DisturbanceTextures", message_of(DisturbanceTextures::create())},
  };
}

void expect_all_say(const std::string& what) {
  for (const auto& [name, message] : all_creations())
    EXPECT_NE(message.find(what + " is current, sward needs OpenGL of at least 4.5"), std::string::npos)
        << name << ": " << message;
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(OldContext, OpenGl33IsNamedByEveryCreation) {
  const AnyContext context(EGL_OPENGL_API, EGL_OPENGL_BIT,
                           {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE});
  if (!context.current()) GTEST_SKIP() << "EGL gives no OpenGL 3.3";
  if (epoxy_gl_version() >= 45) GTEST_SKIP() << "this driver gives a newer OpenGL where 3.3 is asked for";
  expect_all_say("OpenGL 3.3");
}

TEST(OldContext, OpenGlEsIsNamedByEveryCreation) {
  const AnyContext context(EGL_OPENGL_ES_API, EGL_OPENGL_ES3_BIT, {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE});
  if (!context.current()) GTEST_SKIP() << "EGL gives no OpenGL ES 3";
  expect_all_say("OpenGL ES 3." + std::to_string(epoxy_gl_version() % 10));
}

TEST(OldContext, NoContextIsNamedByEveryCreation) {
  for (const auto& [name, message] : all_creations())
    EXPECT_NE(message.find("no OpenGL context is current"), std::string::npos) << name << ": " << message;
}

}  // namespace
}  // namespace sward
