// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/render_target.h"

#include <algorithm>
#include <string>

namespace sward::host {

namespace {

std::string text_of(glm::ivec2 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y);
}

/// A texture that can be drawn into and, with several samples, only resolved.
gl::Texture attachment(GLenum format, glm::ivec2 size, int samples) {
  gl::Texture texture = gl::create_texture(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
  if (samples > 1) {
    glTextureStorage2DMultisample(texture.id(), samples, format, size.x, size.y, GL_TRUE);
  } else {
    glTextureStorage2D(texture.id(), 1, format, size.x, size.y);
  }
  return texture;
}

Expected<void> check_complete(const gl::Framebuffer& framebuffer, glm::ivec2 size, int samples) {
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  return fail("the driver cannot draw into a picture of " + text_of(size) + " pixels with " + std::to_string(samples) +
              " samples (framebuffer status " + std::to_string(status) + ")");
}

}  // namespace

int RenderTarget::max_samples() {
  GLint color = 1, depth = 1, general = 1;
  glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, GL_RGBA8, GL_SAMPLES, 1, &color);
  glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F, GL_SAMPLES, 1, &depth);
  glGetIntegerv(GL_MAX_SAMPLES, &general);
  return std::max(1, std::min({color, depth, general}));
}

Expected<RenderTarget> RenderTarget::create(glm::ivec2 size, int samples) {
  if (Expected<void> context = gl::require_context(); !context) return tl::unexpected(context.error());
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (size.x < 1 || size.y < 1 || size.x > limit || size.y > limit) {
    return fail("a picture of " + text_of(size) + " pixels cannot be drawn; this device takes 1 to " +
                std::to_string(limit) + " along each side");
  }
  const int most = max_samples();
  if (samples < 0 || samples > most) {
    return fail(std::to_string(samples) + " samples a pixel are not possible; the maximum of this device is " +
                std::to_string(most));
  }
  RenderTarget target;
  target.size_ = size;
  target.samples_ = samples == 0 ? most : samples;
  target.color_ = attachment(GL_RGBA8, size, target.samples_);
  target.depth_ = attachment(GL_DEPTH_COMPONENT32F, size, target.samples_);
  target.draw_framebuffer_ = gl::create_framebuffer();
  glNamedFramebufferTexture(target.draw_framebuffer_.id(), GL_COLOR_ATTACHMENT0, target.color_.id(), 0);
  glNamedFramebufferTexture(target.draw_framebuffer_.id(), GL_DEPTH_ATTACHMENT, target.depth_.id(), 0);
  if (Expected<void> complete = check_complete(target.draw_framebuffer_, size, target.samples_); !complete) {
    return tl::unexpected(complete.error());
  }
  if (target.samples_ == 1) return target;
  target.resolved_ = attachment(GL_RGBA8, size, 1);
  target.resolve_framebuffer_ = gl::create_framebuffer();
  glNamedFramebufferTexture(target.resolve_framebuffer_.id(), GL_COLOR_ATTACHMENT0, target.resolved_.id(), 0);
  if (Expected<void> complete = check_complete(target.resolve_framebuffer_, size, 1); !complete) {
    return tl::unexpected(complete.error());
  }
  return target;
}

void RenderTarget::begin() {
  const float black[4] = {0, 0, 0, 1};
  const float farthest = 1;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, draw_framebuffer_.id());
  glViewport(0, 0, size_.x, size_.y);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClearNamedFramebufferfv(draw_framebuffer_.id(), GL_COLOR, 0, black);
  glClearNamedFramebufferfv(draw_framebuffer_.id(), GL_DEPTH, 0, &farthest);
}

std::vector<uint8_t> RenderTarget::read_rgb() {
  if (samples_ > 1) {
    glBlitNamedFramebuffer(draw_framebuffer_.id(), resolve_framebuffer_.id(), 0, 0, size_.x, size_.y, 0, 0, size_.x,
                           size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  const size_t row = size_t(size_.x) * 3;
  std::vector<uint8_t> bottom_up(row * size_t(size_.y));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(samples_ > 1 ? resolved_.id() : color_.id(), 0, GL_RGB, GL_UNSIGNED_BYTE, GLsizei(bottom_up.size()),
                    bottom_up.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  std::vector<uint8_t> top_down(bottom_up.size());
  for (size_t y = 0; y < size_t(size_.y); ++y) {
    std::copy_n(bottom_up.data() + y * row, row, top_down.data() + (size_t(size_.y) - 1 - y) * row);
  }
  return top_down;
}

}  // namespace sward::host
