// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/ground.h>

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gl {

namespace {

/// Anisotropy of the ground's filters: enough for a plain seen from eye level, cheap on every GPU.
constexpr float k_anisotropy = 8;
/// Rows of slopes computed and uploaded at a time.
constexpr int k_rows_at_a_time = 256;

int level_count(glm::ivec2 size) {
  return std::bit_width(unsigned(std::max(size.x, size.y)));
}

Expected<void> check_size(const char* what, glm::ivec2 size) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (size.x <= limit && size.y <= limit) return {};
  return fail(std::string(what) + " of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
              " exceeds this device's largest texture, " + std::to_string(limit) + "; use a smaller one");
}

void set_trilinear(GLuint texture) {
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") &&
      !epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic")) {
    return;
  }
  if (software_renderer()) return;  // blurs magnified texels, too
  GLfloat most = 1;
  glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
  glTextureParameterf(texture, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, k_anisotropy));
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
    glTextureSubImage2D(texture, 0, first.x, first.y + above, size.x, rows, GL_RG, GL_FLOAT, slopes.data());
  }
  glGenerateTextureMipmap(texture);
}

Texture make_slope_map(const HeightField& field) {
  const glm::ivec2 size(field.desc().columns, field.desc().rows);
  Texture texture = create_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), level_count(size), GL_RG16F, size.x, size.y);
  write_slopes(texture.id(), field, glm::ivec2(0), size - 1);
  set_trilinear(texture.id());
  return texture;
}

}  // namespace

Expected<GroundTextures> GroundTextures::create(const HeightField& field, const ColorMap& colors) {
  if (Expected<void> context = require_context(); !context) return tl::unexpected(context.error());
  if (Expected<void> valid = colors.validate(); !valid) return tl::unexpected(valid.error());
  const HeightFieldDesc& desc = field.desc();
  const glm::ivec2 samples(desc.columns, desc.rows);
  if (Expected<void> fits = check_size("a base map", {colors.width, colors.height}); !fits) {
    return tl::unexpected(fits.error());
  }
  if (Expected<void> fits = check_size("a height field", samples); !fits) return tl::unexpected(fits.error());

  const DefaultUnpack unpack;
  GroundTextures ground;
  ground.base_map_ = make_base_map(colors);
  ground.base_map_raw_ = make_raw_view(ground.base_map_.id());
  ground.slope_map_ = make_slope_map(field);
  ground.map_min_ = colors.min_corner;
  ground.map_size_ = colors.size;
  ground.texels_ = {colors.width, colors.height};
  ground.data_min_ = field.min_corner();
  ground.data_max_ = field.max_corner();
  ground.samples_ = samples;
  ground.field_min_ = ground.data_min_ - 0.5 * desc.spacing;
  ground.field_size_ = glm::dvec2(samples) * desc.spacing;
  return ground;
}

void GroundTextures::update_slopes(const HeightField& field, const LatticeBox& changed) {
  SWARD_ASSERT(glm::ivec2(field.desc().columns, field.desc().rows) == samples_,
               "the slope map was made from a field of another size");
  if (changed.empty()) return;
  // A central difference reads one sample to each side.
  const int step = field.sample_step();
  const glm::ivec2 first = glm::max(glm::max(changed.first, LatticePoint(0)) / step - 1, glm::ivec2(0));
  const glm::ivec2 last = glm::min((changed.last + (step - 1)) / step + 1, samples_ - 1);
  if (last.x < first.x || last.y < first.y) return;
  const DefaultUnpack unpack;
  write_slopes(slope_map_.id(), field, first, last);
}

}  // namespace sward::gl
