// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/clipmap.h>

#include <algorithm>
#include <cstddef>

#include "terrain/usable_view.h"

namespace sward::gl {

// std140.
static_assert(offsetof(ClipmapUniforms, from) == 16);
static_assert(offsetof(ClipmapUniforms, place) == 32);
static_assert(offsetof(ClipmapUniforms, eye) == 48);
static_assert(offsetof(ClipmapUniforms, height) == 64);
static_assert(offsetof(ClipmapUniforms, ring) == 80);
static_assert(sizeof(ClipmapUniforms) == 80 + 16 * ClipmapRings::k_most_rings);

namespace {

/// A part of a torus that does not wrap: place and size in texels.
struct Rect {
  glm::ivec2 place, size;
};

/// The parts of `first`, `size` (less than a period a side) on a torus of `side` texels.
int unwrap(glm::ivec2 first, glm::ivec2 size, int side, Rect (&out)[4]) {
  const glm::ivec2 begin = first & (side - 1), head = glm::min(size, side - begin), tail = size - head;
  int count = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      const Rect rect{{x == 0 ? begin.x : 0, y == 0 ? begin.y : 0},
                      {x == 0 ? head.x : tail.x, y == 0 ? head.y : tail.y}};
      if (rect.size.x > 0 && rect.size.y > 0) out[count++] = rect;
    }
  return count;
}

Texture make_array(GLenum format, int texels, int layers) {
  Texture texture = create_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.id(), 1, format, texels, texels, layers);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

}  // namespace

ClipmapUniforms make_clipmap_uniforms(const ClipmapRings& rings, const View& view) {
  const Lattice& lattice = rings.surface().lattice();
  const LatticePoint from(glm::round(rings.eye()));
  const glm::dvec2 metres = lattice.spacing / double(lattice.sample_step());
  const glm::dvec2 place = lattice.world_xy(from) - glm::dvec2(view.eye);
  ClipmapUniforms u;
  u.grid = {rings.cells(), rings.texels() - 1, rings.rings(), rings.finest()};
  u.from = {from, 0, 0};
  u.place = {float(metres.x), float(-metres.y), float(place.x), float(place.y)};
  u.eye = {glm::vec2(rings.eye() - glm::dvec2(from)), 0, 0};
  u.height = {float(rings.base() - view.eye.z), float(rings.melt_begin()), float(1.0 / rings.melt_width()),
              float(rings.finest_melt())};
  for (int i = 0; i < rings.rings(); ++i) u.ring[i] = {rings.first(i), rings.shift(i), rings.relief(i).empty() ? 0 : 1};
  return u;
}

Expected<Clipmap> Clipmap::create(const Surface& surface, const ClipmapOptions& options) {
  if (auto context = require_context(); !context) return tl::unexpected(context.error());
  auto rings = ClipmapRings::create(surface, options);
  if (!rings) return tl::unexpected(rings.error());
  Clipmap clipmap(std::move(*rings));
  clipmap.home_ = HomeContext::of_current();
  const int texels = clipmap.rings_.texels(), layers = clipmap.rings_.rings();
  clipmap.heights_ = make_array(GL_R32F, texels, layers);
  clipmap.relief_ = make_array(GL_RG16F, texels, layers);
  clipmap.block_ = create_buffer();
  glNamedBufferStorage(clipmap.block_.id(), sizeof(ClipmapUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  return clipmap;
}

void Clipmap::send(const ClipmapRings::Change& change, Upload& upload) {
  const int side = rings_.texels();
  Rect rects[4];
  const int count = unwrap(change.first, change.size, side, rects);
  const std::span<const float> z = rings_.heights(change.ring);
  const std::span<const glm::vec2> relief = rings_.relief(change.ring);
  for (int i = 0; i < count; ++i) {
    const auto& [place, size] = rects[i];
    const size_t from = size_t(place.y) * size_t(side) + size_t(place.x), points = size_t(size.x) * size_t(size.y);
    glTextureSubImage3D(heights_.id(), 0, place.x, place.y, change.ring, size.x, size.y, 1, GL_RED, GL_FLOAT,
                        z.data() + from);
    upload.points += points;
    upload.bytes += points * sizeof(float);
    ++upload.rects;
    if (relief.empty()) continue;
    glTextureSubImage3D(relief_.id(), 0, place.x, place.y, change.ring, size.x, size.y, 1, GL_RG, GL_FLOAT,
                        relief.data() + from);
    upload.bytes += points * sizeof(glm::vec2);
    ++upload.rects;
  }
}

Clipmap::Upload Clipmap::follow(const View& view, size_t most_points) {
  Upload upload;
  if (!home_.shared_here("Clipmap::follow") || !usable(view, "Clipmap::follow")) return upload;
  const std::span<const ClipmapRings::Change> changes = rings_.follow(view, most_points);
  if (!changes.empty()) {
    const DefaultUnpack unpack;
    // Straight out of the rings' rows.
    glPixelStorei(GL_UNPACK_ROW_LENGTH, rings_.texels());
    for (const ClipmapRings::Change& change : changes) send(change, upload);
  }
  const ClipmapUniforms uniforms = make_clipmap_uniforms(rings_, view);
  glNamedBufferSubData(block_.id(), 0, sizeof uniforms, &uniforms);
  upload.bytes += sizeof uniforms;
  return upload;
}

size_t Clipmap::gpu_bytes() const {
  return storage_bytes(heights_) + storage_bytes(relief_) + storage_bytes(block_);
}

}  // namespace sward::gl
