// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <utility>

namespace sward::gl {

/// The one owner of a GL object. Move-only; deletes on destruction, which needs the context current. `wrap` holds an
/// object that the host owns and never deletes it; `release` gives the name up.
template <class Traits>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id) : id_(id) {}
  static Handle wrap(GLuint id) {
    Handle handle(id);
    handle.owned_ = false;
    return handle;
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)), owned_(std::exchange(other.owned_, true)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(owned_, other.owned_);
    return *this;
  }
  ~Handle() {
    if (id_ != 0 && owned_) Traits::destroy(id_);
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }
  GLuint release() { return std::exchange(id_, 0); }

 private:
  GLuint id_ = 0;
  bool owned_ = true;
};

struct BufferTraits { static void destroy(GLuint id) { glDeleteBuffers(1, &id); } };
struct TextureTraits { static void destroy(GLuint id) { glDeleteTextures(1, &id); } };
struct VertexArrayTraits { static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); } };
struct ProgramTraits { static void destroy(GLuint id) { glDeleteProgram(id); } };
struct QueryTraits { static void destroy(GLuint id) { glDeleteQueries(1, &id); } };
struct FeedbackTraits { static void destroy(GLuint id) { glDeleteTransformFeedbacks(1, &id); } };
struct FramebufferTraits { static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); } };

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Program = Handle<ProgramTraits>;
using Query = Handle<QueryTraits>;
using Feedback = Handle<FeedbackTraits>;
using Framebuffer = Handle<FramebufferTraits>;

// All by direct state access; nothing stays bound.
SWARD_API Buffer create_buffer();
SWARD_API Texture create_texture(GLenum target);
SWARD_API VertexArray create_vertex_array();
SWARD_API Query create_query(GLenum target);
/// A query that takes its target when it is first begun: Mesa 22.3's glCreateQueries refuses pipeline statistics.
SWARD_API Query name_query();
SWARD_API Feedback create_feedback();
SWARD_API Framebuffer create_framebuffer();

/// The default pixel-unpack state (no unpack buffer, tight rows) while it lives, then what it found. For creation, which
/// reads pixels from memory; it queries, so it does not belong in a frame.
class SWARD_API DefaultUnpack {
 public:
  DefaultUnpack();
  ~DefaultUnpack();
  DefaultUnpack(const DefaultUnpack&) = delete;
  DefaultUnpack& operator=(const DefaultUnpack&) = delete;

 private:
  static constexpr int k_count = 6;
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
