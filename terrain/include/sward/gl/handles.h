// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstddef>
#include <utility>

namespace sward::gl {

/// What is current on this thread, as EGL or GLX name it; null: no context. No GL call, some nanoseconds. A process that
/// draws through neither of them counts as having one everywhere, always the same.
SWARD_API const void* current_context();

/// The one owner of a GL object. Move-only; deletes on destruction where the object's context is current, or, for kinds
/// that contexts can share, where any is. Without one nothing is called: the object goes with its context.
/// `wrap` holds an object that the host owns and never deletes it; `release` gives the name up.
template <class Traits>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id) : id_(id), context_(Traits::k_shared ? nullptr : current_context()) {}
  static Handle wrap(GLuint id) {
    Handle handle(id);
    handle.owned_ = false;
    return handle;
  }
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, 0)), owned_(std::exchange(other.owned_, true)), context_(other.context_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(owned_, other.owned_);
    std::swap(context_, other.context_);
    return *this;
  }
  ~Handle() {
    if (id_ != 0 && owned_ && reachable()) Traits::destroy(id_);
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }
  GLuint release() { return std::exchange(id_, 0); }

 private:
  bool reachable() const {
    const void* const current = current_context();
    return Traits::k_shared ? current != nullptr : current == context_;
  }

  GLuint id_ = 0;
  bool owned_ = true;
  const void* context_ = nullptr;  ///< Whose it is, for kinds that are not shared.
};

/// What contexts of one share group have in common.
struct SharedTraits {
  static constexpr bool k_shared = true;
};
/// What belongs to one context: the same name may be another object in another.
struct OwnTraits {
  static constexpr bool k_shared = false;
};
struct BufferTraits : SharedTraits {
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureTraits : SharedTraits {
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct VertexArrayTraits : OwnTraits {
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct ProgramTraits : SharedTraits {
  static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct QueryTraits : OwnTraits {
  static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};
struct FeedbackTraits : OwnTraits {
  static void destroy(GLuint id) { glDeleteTransformFeedbacks(1, &id); }
};
struct FramebufferTraits : OwnTraits {
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Program = Handle<ProgramTraits>;
using Query = Handle<QueryTraits>;
using Feedback = Handle<FeedbackTraits>;
using Framebuffer = Handle<FramebufferTraits>;

/// Bytes of an object's storage as its format says, without what a driver adds: padding, compression, copies. A view or
/// a buffer texture has none of its own. 0 for none and without a context. Asks GL: not for every frame. Leaves all
/// state as it was.
SWARD_API size_t storage_bytes(const Buffer& buffer);
SWARD_API size_t storage_bytes(const Texture& texture);

// All by direct state access; nothing stays bound.
SWARD_API Buffer create_buffer();
SWARD_API Texture create_texture(GLenum target);
SWARD_API VertexArray create_vertex_array();
SWARD_API Query create_query(GLenum target);
/// A query that takes its target when it is first begun: Mesa 22.3's glCreateQueries refuses pipeline statistics.
SWARD_API Query name_query();
SWARD_API Feedback create_feedback();
SWARD_API Framebuffer create_framebuffer();

/// The context that an object of sward's was made in. Every entry point asks it before the first GL call, because
/// without a context GL calls abort the process or do nothing, and in a foreign one they reach the host's objects.
class SWARD_API HomeContext {
 public:
  /// Of an object that create() has not made.
  HomeContext() = default;
  /// The one that is current now.
  static HomeContext of_current() { return HomeContext(current_context()); }
  /// Asserts that it is current on this thread; `call` is for the message. False where an assertion handler has
  /// returned: then the call does nothing.
  bool here(const char* call) const;
  /// The same for objects that contexts share: asserts that some context is current.
  bool shared_here(const char* call) const;

 private:
  explicit HomeContext(const void* context) : context_(context) {}
  const void* context_ = nullptr;
};

/// The default pixel-unpack state (no unpack buffer, tight rows) while it lives, then what it found. For creation, which
/// reads pixels from memory; it queries, so it does not belong in a frame.
class SWARD_API DefaultUnpack {
 public:
  DefaultUnpack();
  ~DefaultUnpack();
  DefaultUnpack(const DefaultUnpack&) = delete;
  DefaultUnpack& operator=(const DefaultUnpack&) = delete;

 private:
  static constexpr int k_count = 7;
  GLint buffer_ = 0;
  GLint values_[k_count] = {};
};

/// Fails unless a context of at least GL 4.5 is current. Call it first in every creation: epoxy aborts the process at
/// the first other GL call without a context.
SWARD_API Expected<void> require_context();

/// Whether the current context draws on the CPU (llvmpipe, softpipe, SwiftShader): such drivers filter anisotropically
/// at fifty times the cost of a frame, cannot time themselves, and have limits of their own.
SWARD_API bool software_renderer();

}  // namespace sward::gl
