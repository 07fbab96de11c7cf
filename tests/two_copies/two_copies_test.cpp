// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Two copies of the library in one process, a third one in the test itself, in one context: none sees the others.
#include <dlfcn.h>

#include <filesystem>

#include "copy.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

constexpr int k_side = 64;

/// A module loaded from a file of its own, so that it is a copy of its own.
class Copy {
 public:
  explicit Copy(const std::string& name) : path_(testing::TempDir() + name) {
    std::filesystem::copy_file(SWARD_COPY_MODULE, path_, std::filesystem::copy_options::overwrite_existing);
    library_ = dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
  }
  ~Copy() {
    dlclose(library_);
    std::filesystem::remove(path_);
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  /// A function is named by its type alone: this program has none of them.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(library_, name));
  }
  bool create() const { return find<decltype(copy_create)>("copy_create")(); }
  bool draw(GLuint framebuffer) const { return find<decltype(copy_draw)>("copy_draw")(framebuffer, k_side); }
  void destroy() const { find<decltype(copy_destroy)>("copy_destroy")(); }
  void count_asserts() const { find<decltype(copy_count_asserts)>("copy_count_asserts")(); }
  int provoke_assert() const { return find<decltype(copy_provoke_assert)>("copy_provoke_assert")(); }

 private:
  std::string path_;
  void* library_ = nullptr;
};

class TwoCopies : public GlTest {};

TEST_F(TwoCopies, DrawInTurnsInOneContext) {
  const Copy a("sward_copy_a.so"), b("sward_copy_b.so");
  ASSERT_TRUE(a.create() && b.create());
  auto target = host::RenderTarget::create({k_side, k_side}, 1);
  ASSERT_TRUE(target) << target.error().message;
  std::vector<std::vector<uint8_t>> pictures;
  for (const Copy* copy : {&a, &b, &a, &b}) {
    target->begin();
    ASSERT_TRUE(copy->draw(target->framebuffer()));
    pictures.push_back(target->read_rgb());
  }
  EXPECT_GT(std::ranges::count_if(pictures[0], [](uint8_t c) { return c > 0; }), k_side * k_side);
  for (const auto& picture : pictures) EXPECT_EQ(picture, pictures[0]);
  a.destroy();
  target->begin();
  ASSERT_TRUE(b.draw(target->framebuffer()));
  EXPECT_EQ(target->read_rgb(), pictures[0]) << "the other copy's end changes nothing";
  b.destroy();
}

TEST_F(TwoCopies, HaveAnAssertionHandlerEach) {
  const Copy a("sward_copy_c.so"), b("sward_copy_d.so");
  static int ours = 0;
  set_assert_handler([](const char*, const char*, const char*, int) { ++ours; });
  a.count_asserts();
  b.count_asserts();
  EXPECT_EQ(a.provoke_assert(), 1);
  EXPECT_EQ(b.provoke_assert(), 1);
  EXPECT_EQ(a.provoke_assert(), 2);
  EXPECT_EQ(ours, 0);
  gl::HomeContext().here("a test");
  EXPECT_EQ(ours, 1);
  EXPECT_EQ(b.provoke_assert(), 2);
  set_assert_handler(nullptr);
}

}  // namespace
}  // namespace sward
