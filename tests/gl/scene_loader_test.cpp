// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Reloading beside the drawing: what another context has prepared draws the same picture, programs come from binaries,
// and what is wrong is told without a change.
#include "host/scene_loader.h"

#include <sward/gl/program_binaries.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <filesystem>
#include <fstream>
#include <thread>

#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

constexpr glm::ivec2 k_size(96, 64);

class SceneLoaderTest : public test::GlTest {
 protected:
  static Expected<host::SceneSource> read(float density) {
    auto scene = builtin_scene("meadow");
    if (!scene) return tl::unexpected(scene.error());
    scene->generator_samples = 129;
    scene->generator_size_m = 500;
    scene->layers.resize(1);
    scene->layers[0].density = density;
    scene->layers[0].horizon_m = 20;
    auto terrain = host::load_terrain(*scene, true);
    if (!terrain) return tl::unexpected(terrain.error());
    return host::SceneSource{std::move(*scene), std::move(*terrain)};
  }

  static host::SceneLoader::Context context() {
    auto made = host::EglContext::create_shared(*test::shared_context());
    EXPECT_TRUE(made) << made.error().message;
    auto shared = std::make_shared<host::EglContext>(std::move(*made));
    return {[shared] { return shared->make_current(); }, [shared] { shared->release_current(); }};
  }

  static Expected<host::LoadedScene> wait(host::SceneLoader& loader) {
    for (;;) {
      if (auto loaded = loader.take()) return std::move(*loaded);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  static std::vector<uint8_t> picture(host::SceneRenderer& renderer, const host::SceneSource& source) {
    auto target = host::RenderTarget::create(k_size, 1);
    EXPECT_TRUE(target);
    const View view = host::scene_view(source.scene, *source.terrain, k_size);
    const gl::Lighting light = gl::Lighting::clear_day(source.scene.sun_azimuth, source.scene.sun_elevation);
    target->begin();
    EXPECT_TRUE(renderer.draw(view, light, 0.0, target->framebuffer(), 1, true));
    return target->read_rgb();
  }
};

TEST_F(SceneLoaderTest, DrawsWhatAnotherContextHasPrepared) {
  host::SceneLoader loader(context());
  loader.start([] { return read(80); }, gl::ShaderLibrary());
  EXPECT_TRUE(loader.busy());
  auto loaded = wait(loader);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_FALSE(loader.busy());
  auto prepared = host::SceneRenderer::create(loaded->source.scene, *loaded->source.terrain, std::move(loaded->ground),
                                              loaded->shaders);
  ASSERT_TRUE(prepared) << prepared.error().message;
  // Whatever may be asked of it later was built beside, too.
  prepared->wind();
  const auto texts = loaded->shaders.binaries()->binaries().size();
  picture(*prepared, loaded->source);
  EXPECT_EQ(loaded->shaders.binaries()->binaries().size(), texts) << "a program was compiled here";
  if (texts > 0) {
    EXPECT_GT(loaded->shaders.binaries()->taken(), 5u);
  }
  auto plain = host::SceneRenderer::create(loaded->source.scene, *loaded->source.terrain, gl::ShaderLibrary());
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(picture(*prepared, loaded->source), picture(*plain, loaded->source));
}

TEST_F(SceneLoaderTest, TellsWhatIsWrongAndLoadsAgain) {
  host::SceneLoader loader(context());
  loader.start([]() -> Expected<host::SceneSource> { return fail("scene.toml:3: wrong"); }, gl::ShaderLibrary());
  auto wrong = wait(loader);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, "scene.toml:3: wrong");

  const auto folder = std::filesystem::temp_directory_path() / "sward_scene_loader_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "grass_blade.frag.glsl") << "void main() { nothing(); }\n";
  loader.start([] { return read(80); }, gl::ShaderLibrary(folder.string()));
  auto refused = wait(loader);
  std::filesystem::remove_all(folder);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("grass_blade.frag.glsl:1"), std::string::npos) << refused.error().message;

  // A kind that a first scene would go without is no reason to exchange a whole one.
  gl::ShaderLibrary shaders;
  shaders.add_source("reed.glsl", "#include \"common_shoot.glsl\"\nint two = three;\n");
  const auto with_reeds = [] {
    auto source = read(80);
    Species& reed = source->scene.layers[0].species[0];
    reed.kind = PlantKind::custom;
    reed.custom.functions = "reed.glsl";
    return source;
  };
  loader.start(with_reeds, shaders);
  auto maimed = wait(loader);
  ASSERT_FALSE(maimed);
  EXPECT_NE(maimed.error().message.find("reed.glsl:2"), std::string::npos) << maimed.error().message;

  loader.start([] { return read(80); }, gl::ShaderLibrary());
  EXPECT_TRUE(wait(loader));
}

class ProgramBinariesTest : public test::GlTest {
 protected:
  static Expected<gl::Program> build(const std::shared_ptr<gl::ProgramBinaries>& binaries) {
    gl::ShaderLibrary library;
    library.set_binaries(binaries);
    return library.build({.name = "sky",
                          .vertex = "sky.vert.glsl",
                          .tess_control = {},
                          .tess_evaluation = {},
                          .geometry = {},
                          .fragment = "sky.frag.glsl",
                          .defines = gl::binding_defines({}),
                          .feedback_varyings = {}});
  }
};

TEST_F(ProgramBinariesTest, ComeBackWithoutCompiling) {
  auto binaries = std::make_shared<gl::ProgramBinaries>();
  ASSERT_TRUE(build(binaries));
  if (binaries->binaries().empty()) GTEST_SKIP() << "this driver has no format for programs";
  EXPECT_EQ(binaries->taken(), 0u);
  auto again = build(binaries);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(binaries->taken(), 1u);
  EXPECT_EQ(binaries->binaries().size(), 1u);
}

TEST_F(ProgramBinariesTest, ThatTheDriverRefusesAreCompiled) {
  auto binaries = std::make_shared<gl::ProgramBinaries>();
  ASSERT_TRUE(build(binaries));
  for (auto& [text, binary] : binaries->binaries()) {
    std::fill(binary.bytes.begin(), binary.bytes.end(), std::byte(0x5a));
    binaries->add(text, binary);
  }
  auto again = build(binaries);
  take_messages();  // drivers tell that they refuse
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(binaries->taken(), 0u);
}

}  // namespace
}  // namespace sward
