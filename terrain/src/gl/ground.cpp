// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/ground.h>

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <utility>

#include "ground_textures.h"

namespace sward::gl {

namespace {

/// Anisotropy of the ground's filters: enough for a plain seen from eye level, cheap on every GPU.
constexpr float k_anisotropy = 8;

int level_count(glm::ivec2 size) {
  return std::bit_width(unsigned(std::max(size.x, size.y)));
}

Texture make_base_map(const ColorMap& colors) {
  const glm::ivec2 size(colors.width, colors.height);
  Texture texture = create_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), level_count(size), GL_SRGB8_ALPHA8, size.x, size.y);
  glTextureSubImage2D(texture.id(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, colors.texels.data());
  glGenerateTextureMipmap(texture.id());
  set_trilinear(texture.id());
  return texture;
}

/// The same texels without decoding. A view needs a name that has no target yet, hence not create_texture.
Texture make_raw_view(GLuint base_map) {
  GLuint id = 0;
  glGenTextures(1, &id);
  glTextureView(id, GL_TEXTURE_2D, base_map, GL_RGBA8, 0, 1, 0, 1);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return Texture(id);
}

}  // namespace

Expected<void> check_texture_size(const char* what, glm::ivec2 size) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (size.x <= limit && size.y <= limit) return {};
  return fail(std::string(what) + " of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
              " exceeds this device's largest texture, " + std::to_string(limit) + "; use a smaller one");
}

bool anisotropic_filters() {
  return (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") ||
          epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic")) &&
         !software_renderer();  // blurs magnified texels, too
}

void set_trilinear(GLuint texture) {
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (!anisotropic_filters()) return;
  GLfloat most = 1;
  glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
  glTextureParameterf(texture, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, k_anisotropy));
}

Expected<GroundTextures> GroundTextures::create(const HeightField& field, const ColorMap& colors) {
  const Lattice& lattice = field.lattice();
  return create(lattice.min_corner(), lattice.max_corner(), colors, SlopeMap::create(field));
}

Expected<GroundTextures> GroundTextures::create(const Surface& surface, const ColorMap& colors,
                                                const SlopeMapOptions& options) {
  const Lattice& lattice = surface.lattice();
  return create(lattice.min_corner(), lattice.max_corner(), colors, SlopeMap::create(surface, options));
}

Expected<GroundTextures> GroundTextures::create(const ColorMap& colors) {
  const glm::dvec2 low = colors.min_corner;
  return create(low, low + colors.size, colors, SlopeMap::create_level(low, colors.size));
}

Expected<GroundTextures> GroundTextures::create(glm::dvec2 data_min, glm::dvec2 data_max, const ColorMap& colors,
                                                Expected<SlopeMap> slopes) {
  if (!slopes) return tl::unexpected(slopes.error());
  if (Expected<void> valid = colors.validate(); !valid) return tl::unexpected(valid.error());
  if (Expected<void> fits = check_texture_size("a base map", {colors.width, colors.height}); !fits) {
    return tl::unexpected(fits.error());
  }
  const DefaultUnpack unpack;
  GroundTextures ground(std::move(*slopes));
  const DisturbanceBlock nothing;
  ground.undisturbed_ = create_buffer();
  glNamedBufferStorage(ground.undisturbed_.id(), sizeof nothing, &nothing, 0);
  // A texture of its own: drivers warn of units that a program could read and that have none.
  ground.untouched_map_ = create_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(ground.untouched_map_.id(), 1, GL_RGBA16F, 1, 1, 1);
  glClearTexImage(ground.untouched_map_.id(), 0, GL_RGBA, GL_FLOAT, nullptr);
  ground.base_map_ = make_base_map(colors);
  ground.base_map_raw_ = make_raw_view(ground.base_map_.id());
  if (Expected<void> empty = ground.set_materials({}); !empty) return tl::unexpected(empty.error());
  ground.map_min_ = colors.min_corner;
  ground.map_size_ = colors.size;
  ground.texels_ = {colors.width, colors.height};
  ground.data_min_ = data_min;
  ground.data_max_ = data_max;
  return ground;
}

void GroundTextures::update_slopes(const HeightField& field, const LatticeBox& changed) {
  slopes_.update(field, changed);
}

// The raw base map is a view of the other.
size_t GroundTextures::gpu_bytes() const {
  size_t bytes = slopes_.gpu_bytes() + storage_bytes(materials_) + storage_bytes(undisturbed_);
  for (const Texture* texture : {&base_map_, &detail_, &detail_slope_, &untouched_map_})
    bytes += storage_bytes(*texture);
  return bytes;
}

}  // namespace sward::gl
