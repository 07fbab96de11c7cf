// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/wind_textures.h>

#include <cmath>

#include "vegetation/wind_maps.h"
#include "vegetation/wind_state.h"

namespace sward {

namespace {

gl::Texture make_array(GLenum format, int side) {
  gl::Texture texture = gl::create_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.id(), 1, format, side, side, 2);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  return texture;  // repeats
}

gl::Texture make_painted(int width, int height) {
  gl::Texture texture = gl::create_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 1, GL_RG16F, width, height);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

/// Runs of rows that have changed since a stamp. Returns how many rows.
int send_rows(GLuint texture, int layer, const WindGrid& grid, uint64_t since) {
  const auto stamps = grid.row_stamps();
  const int side = grid.side();
  int sent = 0;
  for (int row = 0; row < side;) {
    const int begin = row;
    while (row < side && stamps[size_t(row)] > since) ++row;
    if (row == begin) {
      ++row;
      continue;
    }
    const glm::vec2* const texels = grid.velocity().data() + size_t(begin) * size_t(side);
    glTextureSubImage3D(texture, 0, 0, begin, layer, side, row - begin, 1, GL_RG, GL_FLOAT, texels);
    sent += row - begin;
  }
  return sent;
}

/// The map, row 0 at v = 0.
gl::Texture send_painted(const PaintedWind& map) {
  gl::Texture texture = make_painted(map.width, map.height);
  for (int row = 0; row < map.height; ++row)
    glTextureSubImage2D(texture.id(), 0, 0, map.height - 1 - row, map.width, 1, GL_RG, GL_FLOAT,
                        map.factors.data() + size_t(row) * size_t(map.width));
  return texture;
}

}  // namespace

Expected<WindTextures> WindTextures::create() {
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  const gl::DefaultUnpack unpack;
  WindTextures textures;
  textures.home_ = gl::HomeContext::of_current();
  textures.maps_ = make_array(GL_RGBA8, WindMaps::k_side);
  for (int layer = 0; layer < 2; ++layer)
    glTextureSubImage3D(textures.maps_.id(), 0, 0, 0, layer, WindMaps::k_side, WindMaps::k_side, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, wind_maps().layers[size_t(layer)].data());
  textures.grid_ = make_array(GL_RG16F, k_wind_grid_side);
  glClearTexImage(textures.grid_.id(), 0, GL_RG, GL_FLOAT, nullptr);
  textures.painted_ = make_painted(1, 1);
  const glm::vec2 unchanged(1, 0);
  glTextureSubImage2D(textures.painted_.id(), 0, 0, 0, 1, 1, GL_RG, GL_FLOAT, &unchanged);
  textures.block_ = gl::create_buffer();
  const wind_shared::WindParams still{};
  glNamedBufferStorage(textures.block_.id(), sizeof still, &still, GL_DYNAMIC_STORAGE_BIT);
  return textures;
}

WindTextures::Upload WindTextures::upload(const Wind& wind, glm::dvec3 eye) {
  if (!home_.shared_here("WindTextures::upload")) return {};
  SWARD_ASSERT(std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z),
               "WindTextures::upload: the eye has a number that is NaN or infinite");
  const WindState& state = wind.state();
  const bool another = wind_ != state.identity;
  const bool repaint = state.painted && (another || painting_ != state.painting);
  const std::array<uint64_t, 2> since = another ? std::array<uint64_t, 2>{} : stamps_;
  const std::array<uint64_t, 2> stamps{state.fine.stamp(), state.coarse.stamp()};
  Upload upload;
  if (repaint || another || stamps != since) {
    const gl::DefaultUnpack unpack;
    // Rows that another wind has never touched are still to be put at rest.
    if (another) glClearTexImage(grid_.id(), 0, GL_RG, GL_FLOAT, nullptr);
    upload.rows = send_rows(grid_.id(), 0, state.fine, since[0]) + send_rows(grid_.id(), 1, state.coarse, since[1]);
    if (repaint) painted_ = send_painted(*state.painted);
  }
  const wind_shared::WindParams params = make_wind_params(state, eye);
  glNamedBufferSubData(block_.id(), 0, sizeof params, &params);
  upload.bytes = size_t(upload.rows) * size_t(k_wind_grid_side) * sizeof(glm::vec2) + sizeof params;
  upload.painted = repaint;
  if (repaint) upload.bytes += state.painted->factors.size() * sizeof(glm::vec2);
  wind_ = state.identity;
  stamps_ = stamps;
  painting_ = state.painting;
  return upload;
}

size_t WindTextures::gpu_bytes() const {
  return gl::storage_bytes(block_) + gl::storage_bytes(maps_) + gl::storage_bytes(grid_) + gl::storage_bytes(painted_);
}

}  // namespace sward
