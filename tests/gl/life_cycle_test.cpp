// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Create, draw, resize, reload, switch contexts, destroy, again and again: no message, no object and no memory is left.
// SWARD_CYCLES says how often; 20 by default.
#include <dlfcn.h>
#include <link.h>
#include <malloc.h>

#include <string_view>

#include <sward/gl/program_binaries.h>
#include <cstdlib>

#include "gl/contract_scene.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

#if defined(__SANITIZE_ADDRESS__)
// Of the sanitizer's run-time library; not every package of a compiler brings its header.
extern "C" size_t __sanitizer_get_current_allocated_bytes();
#endif

namespace sward {
namespace {

using namespace test;

int cycles() {
  const char* const text = std::getenv("SWARD_CYCLES");
  return text != nullptr ? std::max(std::atoi(text), 20) : 20;
}

/// Bytes that the process has allocated and not freed.
size_t allocated() {
#if defined(__SANITIZE_ADDRESS__)
  return __sanitizer_get_current_allocated_bytes();
#else
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

/// Mesa's drivers are unloaded with the last display and leave what their own static data point to: a leak checker that
/// comes afterwards cannot see those pointers. Loaded drivers stay.
void keep_drivers() {
  std::vector<std::string> drivers;
  const auto find = [](dl_phdr_info* info, size_t, void* out) {
    if (std::string_view(info->dlpi_name).ends_with("_dri.so"))
      static_cast<std::vector<std::string>*>(out)->emplace_back(info->dlpi_name);
    return 0;
  };
  dl_iterate_phdr(find, &drivers);
  for (const std::string& name : drivers) dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

/// Objects of the current context by kind. Names are handed out from the lowest, so those in use lie near 0.
std::array<int, 9> live_objects() {
  constexpr GLuint k_most = 4096;
  using Is = GLboolean (*)(GLuint);
  const std::array<Is, 9> kinds{
      [](GLuint n) { return glIsBuffer(n); },      [](GLuint n) { return glIsTexture(n); },
      [](GLuint n) { return glIsVertexArray(n); }, [](GLuint n) { return glIsProgram(n); },
      [](GLuint n) { return glIsShader(n); },      [](GLuint n) { return glIsFramebuffer(n); },
      [](GLuint n) { return glIsQuery(n); },       [](GLuint n) { return glIsTransformFeedback(n); },
      [](GLuint n) { return glIsSampler(n); }};
  std::array<int, 9> counts{};
  for (size_t kind = 0; kind < kinds.size(); ++kind)
    for (GLuint name = 1; name <= k_most; ++name) counts[kind] += kinds[kind](name) == GL_TRUE;
  return counts;
}

/// Pixels that are not black.
int drawn(host::RenderTarget& target, ContractScene& scene) {
  target.begin();
  scene.draw(target.framebuffer());
  const std::vector<uint8_t> rgb = target.read_rgb();
  int count = 0;
  for (size_t i = 0; i < rgb.size(); i += 3) count += rgb[i] + rgb[i + 1] + rgb[i + 2] > 0;
  return count;
}

/// A host that comes and goes in two contexts.
class Host {
 public:
  Host(host::EglContext& first, host::EglContext& second) : contexts_{&first, &second} {
    // Compiling a thousand times would test the compiler.
    shaders_.set_binaries(std::make_shared<gl::ProgramBinaries>());
    world_.layer.horizon_m = 6;
    world_.layer.density = 4;
  }

  void live_once() {
    std::array<std::unique_ptr<ContractScene>, 2> scenes;
    std::array<std::unique_ptr<host::RenderTarget>, 2> targets;
    for (size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(contexts_[i]->make_current());
      scenes[i] = std::make_unique<ContractScene>(world_, shaders_);
      targets[i] = std::make_unique<host::RenderTarget>(made(host::RenderTarget::create(k_contract_size, 1)));
    }
    for (const size_t i : {0u, 1u, 0u}) {
      ASSERT_TRUE(contexts_[i]->make_current());
      EXPECT_GT(drawn(*targets[i], *scenes[i]), 1000);
    }
    // Resized.
    const glm::ivec2 size(48, 80);
    *targets[0] = made(host::RenderTarget::create(size, 1));
    scenes[0]->look(world_.look(size));
    EXPECT_GT(drawn(*targets[0], *scenes[0]), 1000);
    // Reloaded: made beside the old ones, then put in their place.
    scenes[0]->plants = made(VegetationRenderer::create(world_.layer, shaders_));
    scenes[0]->terrain = made(TerrainRenderer::create(shaders_));
    EXPECT_GT(drawn(*targets[0], *scenes[0]), 1000);
    for (size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(contexts_[i]->make_current());
      scenes[i].reset();
      targets[i].reset();
    }
  }

  std::array<std::array<int, 9>, 2> objects() {
    std::array<std::array<int, 9>, 2> counts{};
    for (size_t i = 0; i < 2; ++i) {
      contexts_[i]->make_current();
      counts[i] = live_objects();
    }
    return counts;
  }

 private:
  ContractWorld world_;
  gl::ShaderLibrary shaders_;
  std::array<host::EglContext*, 2> contexts_;
};

TEST(LifeCycle, LeavesNothingBehind) {
  Expected<host::EglContext>& first = shared_context();
  if (!first) GTEST_SKIP() << first.error().message;
  keep_drivers();
  auto second = host::EglContext::create(true);
  ASSERT_TRUE(second) << second.error().message;
  Host host(*first, *second);
  const int count = cycles(), settled = count / 2;
  const auto before = host.objects();
  size_t at_half = 0;
  for (int i = 0; i < count; ++i) {
    ASSERT_NO_FATAL_FAILURE(host.live_once());
    if (i + 1 == settled) at_half = allocated();
  }
  EXPECT_EQ(host.objects(), before);
  // Caches of the driver and of the library are full by the first half; what leaks goes on.
  const double grown = double(allocated()) - double(at_half);
  const double a_cycle = grown / (count - settled);
  RecordProperty("cycles", count);
  RecordProperty("bytes_a_cycle", std::to_string(a_cycle));
  std::printf("%d cycles, %.1f bytes a cycle more than at half of them\n", count, a_cycle);
  EXPECT_LT(a_cycle, 4096);
  for (host::EglContext* context : {&*first, &*second})
    for (const std::string& message : context->take_messages())
      if (!is_expected(message)) ADD_FAILURE() << "GL debug message: " << message;
  EXPECT_TRUE(first->make_current());
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace sward
