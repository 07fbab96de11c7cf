// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/clipmap_seeder_buffers.h"

#include <cstring>
#include <utility>

#include "vegetation/vegetation_renderer_buffers.h"

namespace sward {

namespace {

/// Ranks above are not exact in a float (seeding.cpp).
constexpr float k_most_seeds = 16777216.0f;

}  // namespace

SeedingUniforms make_seeding_uniforms(const Layer& layer, const View& view, const Lattice& lattice,
                                      const ClipmapTable& table) {
  const float zoom = float(view.zoom());
  SeedingUniforms u;
  u.origin = glm::dvec2(lattice.origin);
  u.spacing = lattice.spacing;
  u.middle = 0.5 * glm::dvec2(lattice.columns - 1, lattice.rows - 1);
  u.eye_xy = glm::dvec2(view.eye);
  u.scale = {1.0 / double(lattice.sample_step()), double(canopy_spread(layer))};
  const std::array<Plane, 6> planes = frustum_planes(view);
  for (size_t i = 0; i < planes.size(); ++i) u.plane[i] = glm::vec4(glm::vec3(planes[i].n), float(planes[i].d));
  u.clip = glm::mat4(view.clip_from_relative());
  u.window = {table.first(), table.cells()};
  u.cell = {table.shift(), table.triangles_a_cell(), table.memory() - 1};
  const int groups = int((table.candidates() + k_seed_group - 1) / k_seed_group);
  u.level = {table.level(), table.cell_bits(), int(table.candidates()), groups};
  u.law = {float(layer.law), layer.density, layer.full_distance_m * zoom, layer.falloff};
  u.reach = {layer.horizon_m * zoom, float(layer.cluster_size), layer.plain ? 1.0f : 0.0f, float(layer.ceiling)};
  const float aspect = float(double(view.viewport.x) / double(view.viewport.y));
  u.view = {float(view.clip_from_eye[1][1]), aspect, canopy_height(layer), k_most_seeds};
  return u;
}

bool TexelBuffer::fit(size_t needed, GLenum format) {
  if (needed <= bytes) return false;
  bytes = needed + needed / 2;
  buffer = make_buffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (!texture) texture = gl::create_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(texture.id(), format, buffer.id());
  return true;
}

SeedFrameReadBack SeedFrameReadBack::create() {
  SeedFrameReadBack result;
  constexpr GLbitfield k_flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  result.buffer_ = make_buffer(k_frames * k_bytes, nullptr, k_flags | GL_CLIENT_STORAGE_BIT);
  result.mapped_ =
      static_cast<const std::byte*>(glMapNamedBufferRange(result.buffer_.id(), 0, k_frames * k_bytes, k_flags));
  return result;
}

SeedFrameReadBack::~SeedFrameReadBack() {
  if (gl::current_context() == nullptr) return;  // they go with their context
  for (GLsync fence : fences_)
    if (fence != nullptr) glDeleteSync(fence);
}

void SeedFrameReadBack::swap(SeedFrameReadBack& other) noexcept {
  std::swap(buffer_, other.buffer_);
  std::swap(mapped_, other.mapped_);
  std::swap(fences_, other.fences_);
  std::swap(next_, other.next_);
  std::swap(newest_, other.newest_);
}

void SeedFrameReadBack::collect(size_t slot, bool wait) {
  GLsync& fence = fences_[slot];
  if (fence == nullptr) return;
  constexpr GLuint64 k_a_second = 1000000000;
  GLenum state = glClientWaitSync(fence, 0, 0);
  while (wait && state == GL_TIMEOUT_EXPIRED) state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, k_a_second);
  if (state == GL_TIMEOUT_EXPIRED) return;
  if (state != GL_WAIT_FAILED && mapped_ != nullptr) std::memcpy(newest_.data(), mapped_ + slot * k_bytes, k_bytes);
  glDeleteSync(fence);
  fence = nullptr;
}

void SeedFrameReadBack::request(GLuint buffer) {
  collect(next_, false);
  // Still on its way after three frames: what is asked for now takes its place.
  if (fences_[next_] != nullptr) glDeleteSync(std::exchange(fences_[next_], nullptr));
  glCopyNamedBufferSubData(buffer, buffer_.id(), 0, GLintptr(next_ * k_bytes), k_bytes);
  fences_[next_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  next_ = (next_ + 1) % k_frames;
}

SeedFrameReadBack::Head SeedFrameReadBack::newest(bool wait) {
  // From the oldest to the newest.
  for (size_t i = 0; i < k_frames; ++i) collect((next_ + i) % k_frames, wait);
  return newest_;
}

}  // namespace sward
