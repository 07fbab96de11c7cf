// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>

namespace sward::host {

namespace {

bool listed(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  std::string_view rest = extensions;
  while (!rest.empty()) {
    const size_t length = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, length) == name) return true;
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  return false;
}

template <class Function>
Function entry(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::string egl_error() {
  const EGLint code = eglGetError();
  switch (code) {
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return "EGL error " + std::to_string(code);
  }
}

/// EGL hands out one display a device, whoever asks; it is terminated with its last user.
std::mutex g_display_mutex;
std::map<EGLDisplay, int> g_display_users;

bool acquire(EGLDisplay display) {
  const std::lock_guard lock(g_display_mutex);
  if (g_display_users[display] == 0 && eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    g_display_users.erase(display);
    return false;
  }
  ++g_display_users[display];
  return true;
}

void release(EGLDisplay display) {
  const std::lock_guard lock(g_display_mutex);
  if (--g_display_users[display] > 0) return;
  g_display_users.erase(display);
  eglTerminate(display);
}

/// A display to try, and what to call it in messages.
struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
  int rank = 0;  ///< Lower first: a GPU with its vendor's driver, other hardware, software.
};

std::vector<Candidate> device_candidates(const char* client_extensions) {
  std::vector<Candidate> candidates;
  const auto query_devices = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const auto get_display = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!listed(client_extensions, "EGL_EXT_platform_device") || query_devices == nullptr || query_string == nullptr ||
      get_display == nullptr) {
    return candidates;
  }
  EGLint count = 0;
  if (query_devices(0, nullptr, &count) != EGL_TRUE || count <= 0) return candidates;
  std::vector<EGLDeviceEXT> devices(size_t(count), nullptr);
  if (query_devices(count, devices.data(), &count) != EGL_TRUE) return candidates;
  for (int i = 0; i < count; ++i) {
    const char* extensions = query_string(devices[size_t(i)], EGL_EXTENSIONS);
    Candidate candidate;
    candidate.name = "EGL device " + std::to_string(i);
    candidate.rank = listed(extensions, "EGL_NV_device_cuda")         ? 0
                     : listed(extensions, "EGL_MESA_device_software") ? 2
                                                                      : 1;
    candidate.display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[size_t(i)], nullptr);
    candidates.push_back(candidate);
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::rank);
  return candidates;
}

std::vector<Candidate> all_candidates() {
  const char* client_extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> candidates = device_candidates(client_extensions);
  const auto get_display = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (listed(client_extensions, "EGL_MESA_platform_surfaceless") && get_display != nullptr) {
    candidates.push_back(
        {"EGL surfaceless platform",
         get_display(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr), 3});
  }
  return candidates;
}

/// A context on an initialised display, current nowhere. `shared`: with whose objects, or EGL_NO_CONTEXT.
Expected<EGLContext> make_context(EGLDisplay display, EGLContext shared, bool debug) {
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!listed(extensions, "EGL_KHR_surfaceless_context")) return fail("no EGL_KHR_surfaceless_context");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return fail("no desktop OpenGL (" + egl_error() + ")");
  EGLConfig config = nullptr;
  if (!listed(extensions, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count < 1) {
      return fail("no frame buffer configuration for OpenGL");
    }
  }
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG,
                               debug ? EGL_TRUE : EGL_FALSE,
                               EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, shared, attributes);
  if (context == EGL_NO_CONTEXT) return fail("no OpenGL 4.5 core context (" + egl_error() + ")");
  return context;
}

/// The same, current on this thread.
Expected<EGLContext> make_current_context(EGLDisplay display, bool debug) {
  Expected<EGLContext> made = make_context(display, EGL_NO_CONTEXT, debug);
  if (!made) return made;
  const EGLContext context = *made;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
  Expected<EGLContext> failure = fail("the context cannot be made current (" + egl_error() + ")");
  eglDestroyContext(display, context);
  return failure;
}

std::string_view severity_name(GLenum severity) {
  switch (severity) {
    case GL_DEBUG_SEVERITY_HIGH:
      return "high";
    case GL_DEBUG_SEVERITY_MEDIUM:
      return "medium";
    case GL_DEBUG_SEVERITY_LOW:
      return "low";
    default:
      return "notification";
  }
}

std::string_view type_name(GLenum type) {
  switch (type) {
    case GL_DEBUG_TYPE_ERROR:
      return "error";
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
      return "deprecated";
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
      return "undefined";
    case GL_DEBUG_TYPE_PORTABILITY:
      return "portability";
    case GL_DEBUG_TYPE_PERFORMANCE:
      return "performance";
    case GL_DEBUG_TYPE_MARKER:
      return "marker";
    default:
      return "other";
  }
}

}  // namespace

struct EglContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::mutex mutex;  // a driver's own thread may report
  std::vector<std::string> messages;

  ~Impl() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    release(display);
  }

  void record_messages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(on_message, this);
  }

  static void GLAPIENTRY on_message(GLenum, GLenum type, GLuint id, GLenum severity, GLsizei, const GLchar* text,
                                    const void* user) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    auto* self = static_cast<Impl*>(const_cast<void*>(user));
    const std::lock_guard lock(self->mutex);
    self->messages.push_back(std::string(severity_name(severity)) + " " + std::string(type_name(type)) + " " +
                             std::to_string(id) + ": " + text);
  }
};

EglContext::EglContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Expected<EglContext> EglContext::create(bool debug) {
  std::string reasons;
  for (const Candidate& candidate : all_candidates()) {
    if (candidate.display == EGL_NO_DISPLAY || !acquire(candidate.display)) {
      reasons += "; " + candidate.name + ": cannot be initialised (" + egl_error() + ")";
      continue;
    }
    Expected<EGLContext> context = make_current_context(candidate.display, debug);
    if (!context) {
      reasons += "; " + candidate.name + ": " + context.error().message;
      release(candidate.display);
      continue;
    }
    auto impl = std::make_unique<Impl>();
    impl->display = candidate.display;
    impl->context = *context;
    if (debug) impl->record_messages();
    return EglContext(std::move(impl));
  }
  if (reasons.empty()) reasons = "; EGL offers neither EGL_EXT_platform_device nor EGL_MESA_platform_surfaceless";
  return fail("no OpenGL 4.5 core context without a display" + reasons +
              "; install a GL driver with EGL (Debian: libgl1-mesa-dri, libegl1)");
}

Expected<EglContext> EglContext::create_shared(const EglContext& other) {
  auto impl = std::make_unique<Impl>();
  if (!acquire(other.impl_->display)) return fail("the other context's display is gone (" + egl_error() + ")");
  impl->display = other.impl_->display;
  Expected<EGLContext> context = make_context(impl->display, other.impl_->context, false);
  if (!context) {
    release(impl->display);
    return tl::unexpected(context.error());
  }
  impl->context = *context;
  return EglContext(std::move(impl));
}

bool EglContext::make_current() {
  return eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
         eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context) == EGL_TRUE;
}

void EglContext::release_current() {
  eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

std::vector<std::string> EglContext::take_messages() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->messages, {});
}

}  // namespace sward::host
