// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/slope_map.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ground_textures.h"
#include "slope_tiles.h"

namespace sward::gl {

namespace {

/// Rows of slopes computed and uploaded at a time.
constexpr int k_rows_at_a_time = 256;
/// Of windows, down to two texels a tile: coarser ones would mix what lies on both sides of a window's edge.
constexpr int k_window_levels = 7;
static_assert(k_slope_tile >> (k_window_levels - 1) == 2);
constexpr int k_least_window = 512, k_most_window = 8192;

/// Central differences of the samples, one-sided along the border; y of the gradient counts north.
glm::vec2 slope_at(const HeightField& field, int column, int row) {
  const HeightFieldDesc& desc = field.desc();
  const int west = std::max(column - 1, 0), east = std::min(column + 1, desc.columns - 1);
  const int north = std::max(row - 1, 0), south = std::min(row + 1, desc.rows - 1);
  return {(field.sample(east, row) - field.sample(west, row)) / ((east - west) * desc.spacing.x),
          (field.sample(column, north) - field.sample(column, south)) / ((south - north) * desc.spacing.y)};
}

/// Computes and uploads the slopes of samples first..last, both included.
void write_slopes(GLuint texture, const HeightField& field, glm::ivec2 first, glm::ivec2 last) {
  const glm::ivec2 size = last - first + 1;
  std::vector<glm::vec2> slopes(size_t(size.x) * size_t(std::min(size.y, k_rows_at_a_time)));
  for (int above = 0; above < size.y; above += k_rows_at_a_time) {
    const int rows = std::min(k_rows_at_a_time, size.y - above);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < size.x; ++column) {
        slopes[size_t(row) * size_t(size.x) + size_t(column)] =
            slope_at(field, first.x + column, first.y + above + row);
      }
    }
    glTextureSubImage3D(texture, 0, first.x, first.y + above, 0, size.x, rows, 1, GL_RG, GL_FLOAT, slopes.data());
  }
  glGenerateTextureMipmap(texture);
}

/// Halves an image whose sides are even, in place: each texel the mean of four.
void halve(std::vector<glm::vec2>& texels, glm::ivec2 size) {
  const auto width = size_t(size.x);
  size_t to = 0;
  for (size_t row = 0; row < size_t(size.y); row += 2)
    for (size_t column = 0; column < width; column += 2) {
      const glm::vec2* at = &texels[row * width + column];
      texels[to++] = 0.25f * (at[0] + at[1] + at[width] + at[width + 1]);
    }
}

}  // namespace

struct SlopeMap::Impl {
  HomeContext home = HomeContext::of_current();
  Lattice lattice;
  SlopeTiles tiles;
  Texture texture;
  std::vector<glm::vec2> slopes;  // of the tile that is being written

  Impl(const Lattice& of, int window, int whole) : lattice(of), tiles({of.columns, of.rows}, window, whole) {
    const glm::ivec2 size = tiles.texels();
    const int levels = std::bit_width(unsigned(std::max(size.x, size.y)));
    texture = create_texture(GL_TEXTURE_2D_ARRAY);
    const int held = tiles.windowed() ? k_window_levels : levels;
    glTextureStorage3D(texture.id(), held, GL_RG16F, size.x, size.y, tiles.layers());
    set_trilinear(texture.id());
    // Filters read a little beyond what is written: level ground instead of whatever the memory held.
    for (int level = 0; level < held; ++level) glClearTexImage(texture.id(), level, GL_RG, GL_FLOAT, nullptr);
    if (!tiles.windowed()) return;
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_REPEAT);
  }

  void write(const Surface& surface, const SlopeTiles::Tile& tile) {
    const SlopeTiles::Box box = tiles.box(tile);
    const int stride = tiles.stride(tile.layer);
    slopes.resize(size_t(box.size.x) * size_t(box.size.y));
    surface.data_gradients(box.first * stride, stride, box.size, slopes);
    // Tiles of windows fill whole texels of every level, so that only theirs have to be made anew.
    const int levels = tiles.windowed() ? k_window_levels : 1;
    for (int level = 0; level < levels; ++level) {
      const glm::ivec2 place = box.place >> level, size = box.size >> level;
      glTextureSubImage3D(texture.id(), level, place.x, place.y, tile.layer, size.x, size.y, 1, GL_RG, GL_FLOAT,
                          slopes.data());
      if (level + 1 < levels) halve(slopes, size);
    }
  }
};

SlopeMap::SlopeMap(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SlopeMap::SlopeMap(SlopeMap&&) noexcept = default;
SlopeMap& SlopeMap::operator=(SlopeMap&&) noexcept = default;
SlopeMap::~SlopeMap() = default;

Expected<SlopeMap> SlopeMap::create(const HeightField& field) {
  if (auto context = require_context(); !context) return tl::unexpected(context.error());
  const glm::ivec2 samples(field.desc().columns, field.desc().rows);
  if (auto fits = check_texture_size("a height field", samples); !fits) return tl::unexpected(fits.error());
  const DefaultUnpack unpack;
  auto impl = std::make_unique<Impl>(field.lattice(), k_least_window, std::max(samples.x, samples.y));
  write_slopes(impl->texture.id(), field, glm::ivec2(0), samples - 1);
  impl->tiles.take(std::numeric_limits<size_t>::max());
  return SlopeMap(std::move(impl));
}

Expected<SlopeMap> SlopeMap::create_level(glm::dvec2 min_corner, glm::dvec2 size) {
  if (auto context = require_context(); !context) return tl::unexpected(context.error());
  Lattice lattice;  // a sample at each corner
  lattice.spacing = size;
  lattice.origin = glm::dvec3(min_corner + 0.5 * size, 0);
  auto impl = std::make_unique<Impl>(lattice, k_least_window, lattice.columns);
  impl->tiles.take(std::numeric_limits<size_t>::max());
  return SlopeMap(std::move(impl));
}

Expected<SlopeMap> SlopeMap::create(const Surface& surface, const SlopeMapOptions& options) {
  if (auto context = require_context(); !context) return tl::unexpected(context.error());
  const int window = options.window_texels;
  if (window < k_least_window || window > k_most_window || !std::has_single_bit(unsigned(window)))
    return fail("a slope window of " + std::to_string(window) + " texels; give a power of two from 512 to 8192");
  const Lattice& lattice = surface.lattice();
  const bool whole = lattice.columns <= options.whole_texels && lattice.rows <= options.whole_texels;
  const glm::ivec2 size = whole ? glm::ivec2(lattice.columns, lattice.rows) : glm::ivec2(window);
  if (auto fits = check_texture_size("a slope map", size); !fits) return tl::unexpected(fits.error());
  return SlopeMap(std::make_unique<Impl>(lattice, window, options.whole_texels));
}

void SlopeMap::follow(const Surface& surface, glm::dvec2 eye, size_t tiles) {
  if (!impl_->home.shared_here("SlopeMap::follow")) return;
  const Lattice& lattice = impl_->lattice;
  SWARD_ASSERT(surface.lattice() == lattice, "the slope map was created for another surface");
  SWARD_ASSERT(std::isfinite(eye.x) && std::isfinite(eye.y),
               "the eye of a slope map has a number that is NaN or infinite");
  const glm::dvec2 from_middle = (eye - glm::dvec2(lattice.origin)) / lattice.spacing;
  impl_->tiles.follow(glm::dvec2(from_middle.x, -from_middle.y) +
                      0.5 * glm::dvec2(lattice.columns - 1, lattice.rows - 1));
  const std::vector<SlopeTiles::Tile> next = impl_->tiles.take(tiles);
  if (next.empty()) return;
  const DefaultUnpack unpack;
  for (const SlopeTiles::Tile& tile : next) impl_->write(surface, tile);
  if (!impl_->tiles.windowed()) glGenerateTextureMipmap(impl_->texture.id());
}

void SlopeMap::changed(const LatticeBox& box) {
  if (box.empty()) return;
  const int step = impl_->lattice.sample_step();
  impl_->tiles.changed(glm::max(box.first, LatticePoint(0)) / step, (box.last + (step - 1)) / step);
}

bool SlopeMap::settled() const {
  return impl_->tiles.settled();
}

void SlopeMap::update(const HeightField& field, const LatticeBox& changed) {
  if (!impl_->home.shared_here("SlopeMap::update")) return;
  const glm::ivec2 samples(field.desc().columns, field.desc().rows);
  SWARD_ASSERT(samples == impl_->tiles.texels(), "the slope map was made from a field of another size");
  if (changed.empty()) return;
  // A central difference reads one sample to each side.
  const int step = field.sample_step();
  const glm::ivec2 first = glm::max(glm::max(changed.first, LatticePoint(0)) / step - 1, glm::ivec2(0));
  const glm::ivec2 last = glm::min((changed.last + (step - 1)) / step + 1, samples - 1);
  if (last.x < first.x || last.y < first.y) return;
  const DefaultUnpack unpack;
  write_slopes(impl_->texture.id(), field, first, last);
}

GLuint SlopeMap::texture() const {
  return impl_->texture.id();
}

int SlopeMap::layers() const {
  return impl_->tiles.layers();
}

// The north-western texel's outer corner lies half a texel beyond the data's.
glm::dvec2 SlopeMap::layer_min(int layer) const {
  const glm::dvec2 half = 0.5 * impl_->tiles.stride(layer) * impl_->lattice.spacing;
  const glm::dvec2 north_west = impl_->lattice.world_xy({0, 0}) + glm::dvec2(-half.x, half.y);
  return {north_west.x, north_west.y - layer_size(layer).y};
}

glm::dvec2 SlopeMap::layer_size(int layer) const {
  return glm::dvec2(impl_->tiles.texels()) * double(impl_->tiles.stride(layer)) * impl_->lattice.spacing;
}

bool SlopeMap::repeats() const {
  return impl_->tiles.windowed();
}

double SlopeMap::reach() const {
  return impl_->tiles.reach();
}

glm::dvec2 SlopeMap::spacing() const {
  return impl_->lattice.spacing;
}

size_t SlopeMap::gpu_bytes() const {
  return storage_bytes(impl_->texture);
}

}  // namespace sward::gl
