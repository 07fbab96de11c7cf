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

constexpr GLenum k_unpack_names[] = {GL_UNPACK_ALIGNMENT,   GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
                                     GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SWAP_BYTES,
                                     GL_UNPACK_SKIP_IMAGES};

}  // namespace

DefaultUnpack::DefaultUnpack() {
  glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &buffer_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (int i = 0; i < k_count; ++i) {
    glGetIntegerv(k_unpack_names[i], &values_[i]);
    glPixelStorei(k_unpack_names[i], i == 0 ? 1 : 0);
  }
}

DefaultUnpack::~DefaultUnpack() {
  for (int i = 0; i < k_count; ++i) glPixelStorei(k_unpack_names[i], values_[i]);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(buffer_));
}

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

Query name_query() {
  return create<Query>([](GLuint* id) { glGenQueries(1, id); });
}

Feedback create_feedback() {
  return create<Feedback>([](GLuint* id) { glCreateTransformFeedbacks(1, id); });
}

Framebuffer create_framebuffer() {
  return create<Framebuffer>([](GLuint* id) { glCreateFramebuffers(1, id); });
}

size_t storage_bytes(const Buffer& buffer) {
  GLint64 bytes = 0;
  if (buffer && current_context() != nullptr) glGetNamedBufferParameteri64v(buffer.id(), GL_BUFFER_SIZE, &bytes);
  return size_t(bytes);
}

size_t storage_bytes(const Texture& texture) {
  if (!texture || current_context() == nullptr) return 0;
  const auto of_level = [&](GLint level, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture.id(), level, name, &value);
    return size_t(value);
  };
  GLint levels = 0;
  glGetTextureParameteriv(texture.id(), GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
  size_t texels = 0, bits = 0;
  for (GLint level = 0; level < levels; ++level)
    texels += of_level(level, GL_TEXTURE_WIDTH) * of_level(level, GL_TEXTURE_HEIGHT) *
              of_level(level, GL_TEXTURE_DEPTH);
  for (const GLenum channel : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE})
    bits += of_level(0, channel);
  return texels * bits / 8;
}

bool software_renderer() {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view name = text != nullptr ? text : "";
  return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos ||
         name.find("SwiftShader") != name.npos;
}

}  // namespace sward::gl
