// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/placement_textures.h"

#include <bit>
#include <cstring>

#include "vegetation/vegetation_renderer_buffers.h"

namespace sward {

namespace {

constexpr size_t k_greys_a_texel = 16;

GLint device_limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

size_t texels_of(const GrayMap& mask) {
  return (mask.values.size() + k_greys_a_texel - 1) / k_greys_a_texel;
}

/// Two texels a mask (first texel, width, height; mask_header(), written by follow()), then the greys, lowest byte
/// first.
std::vector<glm::uvec4> pack_masks(const std::vector<const GrayMap*>& masks) {
  std::vector<glm::uvec4> texels(2 * masks.size() + 1, glm::uvec4(0));
  for (size_t i = 0; i < masks.size(); ++i) {
    const size_t first = texels.size();
    texels[2 * i] = {uint32_t(first), uint32_t(masks[i]->width), uint32_t(masks[i]->height), 0};
    texels.resize(first + texels_of(*masks[i]), glm::uvec4(0));
    for (size_t grey = 0; grey < masks[i]->values.size(); ++grey) {
      uint32_t& word = texels[first + grey / k_greys_a_texel][int(grey / 4 % 4)];
      word |= uint32_t(masks[i]->values[grey]) << (8 * (grey % 4));
    }
  }
  return texels;
}

Expected<void> check_sizes(const Layer& layer, const std::vector<const GrayMap*>& masks) {
  size_t texels = 2 * masks.size() + 1;
  for (const GrayMap* mask : masks) texels += texels_of(*mask);
  const auto most = size_t(device_limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  if (texels > most) {
    return fail("layer '" + layer.name + "': its masks have " + std::to_string(texels * k_greys_a_texel) +
                " texels but this device holds " + std::to_string(most * k_greys_a_texel) + "; use smaller ones");
  }
  const GLint widest = device_limit(GL_MAX_TEXTURE_SIZE);
  if (layer.distribution && (layer.distribution->width > widest || layer.distribution->height > widest)) {
    return fail("layer '" + layer.name + "': its distribution map exceeds this device's largest texture, " +
                std::to_string(widest) + "; use a smaller one");
  }
  return {};
}

gl::Texture make_distribution(const ColorMap& map) {
  const gl::DefaultUnpack unpack;
  gl::Texture texture = gl::create_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 1, GL_RGBA8, map.width, map.height);
  glTextureSubImage2D(texture.id(), 0, 0, 0, map.width, map.height, GL_RGBA, GL_UNSIGNED_BYTE, map.texels.data());
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

}  // namespace

Expected<PlacementTextures> PlacementTextures::create(const Layer& layer) {
  const std::vector<const GrayMap*> masks = masks_of(layer);
  if (auto fits = check_sizes(layer, masks); !fits) return tl::unexpected(fits.error());
  const std::vector<glm::uvec4> texels = pack_masks(masks);
  PlacementTextures textures;
  textures.buffer_ = make_buffer(texels.size() * sizeof(glm::uvec4), texels.data(), GL_DYNAMIC_STORAGE_BIT);
  textures.masks_ = gl::create_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(textures.masks_.id(), GL_RGBA32UI, textures.buffer_.id());
  if (layer.distribution) textures.distribution_ = make_distribution(*layer.distribution);
  return textures;
}

void PlacementTextures::follow(const Layer& layer, const MapGeometry& map, GLuint base_map_raw) {
  base_map_raw_ = base_map_raw;
  if (texels_ == map.texels && size_ == map.size) return;
  texels_ = map.texels;
  size_ = map.size;
  const size_t masks = masks_of(layer).size();
  for (size_t i = 0; i < masks; ++i) {
    const glm::vec4 header = mask_header(layer, i, map);
    glNamedBufferSubData(buffer_.id(), GLintptr((2 * i + 1) * sizeof header), GLsizeiptr(sizeof header), &header);
  }
}

}  // namespace sward
