// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/handles.h>

namespace sward::gl {

namespace {

template <class Owner, class Create>
Owner create(Create create_one) {
  GLuint id = 0;
  create_one(&id);
  return Owner(id);
}

}  // namespace

Buffer create_buffer() {
  return create<Buffer>([](GLuint* id) { glCreateBuffers(1, id); });
}

Texture create_texture(GLenum target) {
  return create<Texture>([target](GLuint* id) { glCreateTextures(target, 1, id); });
}

VertexArray create_vertex_array() {
  return create<VertexArray>([](GLuint* id) { glCreateVertexArrays(1, id); });
}

Query create_query(GLenum target) {
  return create<Query>([target](GLuint* id) { glCreateQueries(target, 1, id); });
}

Feedback create_feedback() {
  return create<Feedback>([](GLuint* id) { glCreateTransformFeedbacks(1, id); });
}

Framebuffer create_framebuffer() {
  return create<Framebuffer>([](GLuint* id) { glCreateFramebuffers(1, id); });
}

Expected<void> require_context() {
  const int version = epoxy_gl_version();
  if (version >= 45) return {};
  if (version == 0) return fail("no OpenGL context is current; make one of at least version 4.5 current first");
  return fail("OpenGL " + std::to_string(version / 10) + "." + std::to_string(version % 10) +
              " is current, sward needs at least 4.5");
}

}  // namespace sward::gl
