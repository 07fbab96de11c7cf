// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Which context is current, asked of the window system's own library instead of GL: that needs no context.
#include <sward/gl/handles.h>

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <string>

namespace sward::gl {

namespace {

using CurrentContext = void* (*)();

struct WindowSystem {
  std::array<const char*, 2> libraries;
  const char* function;
};
constexpr std::array<WindowSystem, 2> k_systems{
    {{{"libEGL.so.1", "libEGL.so"}, "eglGetCurrentContext"}, {{"libGLX.so.0", "libGL.so.1"}, "glXGetCurrentContext"}}};

std::array<std::atomic<CurrentContext>, k_systems.size()> g_current{};

/// A context has been current that neither of them knows: another window system's.
std::atomic<bool> g_other_system{false};

/// In a library that the process has already loaded; what is found stays loaded for good.
CurrentContext find(const WindowSystem& system) {
  for (const char* name : system.libraries) {
    void* const library = dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    if (library == nullptr) continue;
    if (void* const function = dlsym(library, system.function)) return reinterpret_cast<CurrentContext>(function);
    dlclose(library);
  }
  return nullptr;
}

/// A host may load another window system's library at any time: creation looks again.
void find_window_systems() {
  for (size_t i = 0; i < k_systems.size(); ++i)
    if (g_current[i] == nullptr) g_current[i] = find(k_systems[i]);
}

bool complain(const char* call, const char* what) {
  assert_failed("the object's OpenGL context is current", (std::string(call) + ": " + what).c_str(), __FILE__,
                __LINE__);
  return false;
}

constexpr const char* k_not_made =
    "the object was not made by its create(); call that first, with a context current, and keep what it returns";
constexpr const char* k_none =
    "no OpenGL context is current on this thread; make the one that the object was created in current, and call from "
    "its thread";

}  // namespace

const void* current_context() {
  static const char unknown = 0;
  bool any = false;  // window system that could tell
  for (const std::atomic<CurrentContext>& current : g_current) {
    const CurrentContext function = current.load(std::memory_order_relaxed);
    if (function == nullptr) continue;
    any = true;
    if (const void* const context = function()) return context;
  }
  return any && !g_other_system ? nullptr : &unknown;
}

bool HomeContext::here(const char* call) const {
  const void* const current = current_context();
  if (current != nullptr && current == context_) return true;
  if (context_ == nullptr) return complain(call, k_not_made);
  if (current == nullptr) return complain(call, k_none);
  return complain(
      call,
      "another OpenGL context is current than the one that the object was created in; make that one current, "
      "or create an object for each context");
}

bool HomeContext::shared_here(const char* call) const {
  if (context_ == nullptr) return complain(call, k_not_made);
  return current_context() != nullptr || complain(call, k_none);
}

Expected<void> require_context() {
  find_window_systems();
  const int version = epoxy_gl_version();
  if (version == 0) return fail("no OpenGL context is current; make one of at least version 4.5 current first");
  if (current_context() == nullptr) g_other_system = true;
  if (version >= 45) return {};
  return fail((epoxy_is_desktop_gl() ? "OpenGL " : "OpenGL ES ") + std::to_string(version / 10) + "." +
              std::to_string(version % 10) +
              " is current, sward needs OpenGL of at least 4.5; ask the window system for such a context");
}

}  // namespace sward::gl
