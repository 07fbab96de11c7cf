// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/vegetation_renderer_buffers.h"

#include <algorithm>

#include "gl/bind.h"

namespace sward {

namespace {

constexpr size_t k_regions = 3;
constexpr size_t k_texel_bytes = 16;

size_t device_limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return size_t(std::max(value, 1));
}

size_t round_up(size_t value, size_t step) {
  return (value + step - 1) / step * step;
}

/// Half as much again as is needed, so that a slowly growing need does not mean a new buffer a frame.
size_t with_room(size_t needed) {
  return needed + needed / 2;
}

Expected<void> check_texels(const char* what, size_t count, size_t texels_each, size_t max_texels) {
  if (count * texels_each <= max_texels) return {};
  return fail(std::to_string(count) + " " + what + " do not fit into a buffer texture of this device (" +
              std::to_string(max_texels / texels_each) + "); raise the layer's triangle area or lower its horizon");
}

}  // namespace

gl::Buffer make_buffer(size_t bytes, const void* data, GLbitfield flags) {
  gl::Buffer buffer = gl::create_buffer();
  glNamedBufferStorage(buffer.id(), GLsizeiptr(bytes), data, flags);
  return buffer;
}

TriangleBuffers TriangleBuffers::create() {
  TriangleBuffers buffers;
  buffers.records_ = gl::create_texture(GL_TEXTURE_BUFFER);
  buffers.surface_ = gl::create_texture(GL_TEXTURE_BUFFER);
  buffers.exclusions_ = gl::create_texture(GL_TEXTURE_BUFFER);
  buffers.alignment_ = std::max(device_limit(GL_TEXTURE_BUFFER_OFFSET_ALIGNMENT), k_texel_bytes);
  buffers.max_texels_ = device_limit(GL_MAX_TEXTURE_BUFFER_SIZE);
  return buffers;
}

void TriangleBuffers::reserve(size_t region_bytes) {
  if (region_bytes <= region_bytes_) return;
  region_bytes_ = round_up(with_room(region_bytes), alignment_);
  buffer_ = make_buffer(k_regions * region_bytes_, nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Expected<void> TriangleBuffers::write(std::span<const TriangleRecord> records, std::span<const SurfaceNode> nodes,
                                      std::span<const glm::vec4> exclusions) {
  if (auto fits = check_texels("triangles", records.size(), sizeof(TriangleRecord) / k_texel_bytes, max_texels_); !fits)
    return fits;
  if (auto fits = check_texels("surface nodes", nodes.size(), 1, max_texels_); !fits) return fits;
  if (auto fits = check_texels("corners of excluded shapes", exclusions.size(), 1, max_texels_); !fits) return fits;

  // A buffer texture cannot be empty; node 0 stands for "flat" and is never read.
  const size_t record_bytes = std::max(records.size_bytes(), sizeof(TriangleRecord));
  const size_t node_bytes = std::max(nodes.size_bytes(), sizeof(SurfaceNode));
  const size_t nodes_at = round_up(record_bytes, alignment_);
  const size_t shape_bytes = std::max(exclusions.size_bytes(), k_texel_bytes);
  const size_t shapes_at = round_up(nodes_at + node_bytes, alignment_);
  reserve(shapes_at + shape_bytes);
  region_ = (region_ + 1) % k_regions;
  const size_t begin = region_ * region_bytes_;
  if (!records.empty())
    glNamedBufferSubData(buffer_.id(), GLintptr(begin), GLsizeiptr(records.size_bytes()), records.data());
  if (!nodes.empty())
    glNamedBufferSubData(buffer_.id(), GLintptr(begin + nodes_at), GLsizeiptr(nodes.size_bytes()), nodes.data());
  if (!exclusions.empty())
    glNamedBufferSubData(buffer_.id(), GLintptr(begin + shapes_at), GLsizeiptr(exclusions.size_bytes()),
                         exclusions.data());
  glTextureBufferRange(records_.id(), GL_RGBA32UI, buffer_.id(), GLintptr(begin), GLsizeiptr(record_bytes));
  glTextureBufferRange(surface_.id(), GL_RGBA32UI, buffer_.id(), GLintptr(begin + nodes_at), GLsizeiptr(node_bytes));
  glTextureBufferRange(exclusions_.id(), GL_RGBA32F, buffer_.id(), GLintptr(begin + shapes_at),
                       GLsizeiptr(shape_bytes));
  return {};
}

FeedbackPass FeedbackPass::create(int used) {
  FeedbackPass pass;
  pass.feedback_ = gl::create_feedback();
  pass.used_ = used;
  // All four are declared by the program, so all four need a buffer.
  for (int stream = 0; stream < k_streams; ++stream) pass.allocate(stream, 1);
  pass.capacity_ = 1;
  return pass;
}

void FeedbackPass::allocate(int stream, size_t clusters) {
  gl::Buffer& buffer = streams_[size_t(stream)];
  buffer = make_buffer(clusters * k_cluster_bytes, nullptr, 0);
  glTransformFeedbackBufferBase(feedback_.id(), GLuint(stream), buffer.id());
}

void FeedbackPass::reserve(size_t clusters) {
  if (clusters <= capacity_) return;
  capacity_ = with_room(clusters);
  for (int stream = 0; stream < used_; ++stream) allocate(stream, capacity_);
}

size_t FeedbackPass::gpu_bytes() const {
  size_t bytes = 0;
  for (const gl::Buffer& stream : streams_) bytes += gl::storage_bytes(stream);
  return bytes;
}

StageBindings::StageBindings(const gl::Bindings& bindings, GLuint frame, GLuint species,
                             std::initializer_list<Unit> units, TriangleTextures::Clipmap clipmap)
    : bindings_(bindings), clipmap_(clipmap.block != 0) {
  gl::bind_uniforms(bindings.frame, frame);
  gl::bind_uniforms(bindings.species, species);
  for (const Unit& unit : units) {
    gl::bind_texture(unit.unit, unit.texture);
    units_[count_++] = unit.unit;
  }
  if (!clipmap_) return;
  gl::bind_uniforms(bindings.clipmap, clipmap.block);
  gl::bind_texture(bindings.clipmap_heights, clipmap.heights);
  units_[count_++] = bindings.clipmap_heights;
}

StageBindings::~StageBindings() {
  for (size_t i = 0; i < count_; ++i) glBindTextureUnit(units_[i], 0);
  if (clipmap_) gl::bind_uniforms(bindings_.clipmap, 0);
  gl::bind_uniforms(bindings_.species, 0);
  gl::bind_uniforms(bindings_.frame, 0);
}

DisturbedBindings::DisturbedBindings(const gl::Bindings& bindings, const gl::DisturbedGround& disturbed)
    : bindings_(bindings) {
  gl::bind_uniforms(bindings.disturbance, disturbed.block);
  gl::bind_texture(bindings.disturbance_map, disturbed.map);
}

DisturbedBindings::~DisturbedBindings() {
  glBindTextureUnit(bindings_.disturbance_map, 0);
  gl::bind_uniforms(bindings_.disturbance, 0);
}

}  // namespace sward
