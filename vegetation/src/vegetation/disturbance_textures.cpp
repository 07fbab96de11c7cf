// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/disturbance_textures.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "vegetation/disturbance_tiles.h"

namespace sward {

namespace {

static_assert(gl::k_disturbance_levels == k_tile_levels);
constexpr int k_layers = 3;  // a level: press, water, cut; burn; paint
constexpr int k_side = k_window_tiles * k_tile_side;
constexpr size_t k_layer_texels = size_t(k_tile_cells) * 4;  // halves of a tile's layer
/// Stored values may have grown by 2^10 and more until they are taken anew: half floats reach 2^15.
constexpr double k_most_half_lives = 10;
/// Values that regrow are written in so many steps.
constexpr double k_regrow_steps = 256;

/// Nearest half float of a number within its normal range; smaller ones become 0.
uint16_t to_half(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value), sign = bits >> 16 & 0x8000u;
  const uint32_t rest = (bits & 0x7fffffffu) + 0x1000u;
  if (rest < 0x38800000u) return uint16_t(sign);
  return uint16_t(sign | ((rest - 0x38000000u) >> 13));
}

/// The window's south-western tile.
glm::ivec2 window_corner(glm::dvec2 eye, int level) {
  return glm::ivec2(glm::floor(eye / tile_m(level) + 0.5)) - k_window_tiles / 2;
}

int slot_of(glm::ivec2 place) {
  const glm::ivec2 at = place & (k_window_tiles - 1);
  return at.y * k_window_tiles + at.x;
}

/// Press and water of a cell as they are, or would be, at moments in half-lives since the beginning: the same bits
/// whenever it is asked.
glm::vec3 moving_at(const DisturbanceTiles& tiles, const DisturbanceTile& tile, size_t cell, double press_moment,
                    double wet_moment) {
  const auto scale = [&](uint32_t time, double half_life_s, double moment) {
    return float(std::exp2((tiles.epoch + (double(time) - 1) / k_ticks_a_second) / half_life_s - moment));
  };
  glm::vec3 moving(0);
  if (tile.press && tile.press->way[cell] != std::array<int8_t, 2>{})
    moving = glm::vec3(tile.press->way[cell][0], tile.press->way[cell][1], 0) / 127.0f *
             scale(tile.press->time[cell], double(tiles.options.press_half_life_s), press_moment);
  if (tile.wet && tile.wet->wet[cell] != 0)
    moving.z = float(tile.wet->wet[cell]) / 255.0f *
               scale(tile.wet->time[cell], double(tiles.options.wet_half_life_s), wet_moment);
  return moving;
}

/// How far a tile's regrowth has come, in steps of what changes on screen.
uint32_t regrow_step(const DisturbanceTile& tile, uint32_t now) {
  if (!tile.regrow) return 0;
  uint32_t shortest = 0xffffffffu;
  for (size_t i = 0; i < size_t(k_tile_cells); ++i)
    if (tile.regrow->end[i] != 0) shortest = std::min(shortest, tile.regrow->end[i] - tile.regrow->start[i]);
  return 1 + uint32_t(double(now) * k_regrow_steps / std::max(double(shortest), 1.0));
}

}  // namespace

Expected<DisturbanceTextures> DisturbanceTextures::create() {
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  DisturbanceTextures made;
  made.home_ = gl::HomeContext::of_current();
  made.map_ = gl::create_texture(GL_TEXTURE_2D_ARRAY);
  const GLuint id = made.map_.id();
  glTextureStorage3D(id, 1, GL_RGBA16F, k_side, k_side, k_tile_levels * k_layers);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glClearTexImage(id, 0, GL_RGBA, GL_FLOAT, nullptr);
  made.block_ = gl::create_buffer();
  glNamedBufferStorage(made.block_.id(), sizeof made.values_, &made.values_, GL_DYNAMIC_STORAGE_BIT);
  made.slots_.resize(size_t(k_tile_levels * k_window_tiles * k_window_tiles));
  return made;
}

/// Whether any slot may hold what it should not.
bool DisturbanceTextures::stale(const Disturbance& disturbance, glm::dvec2 eye) {
  const DisturbanceTiles& tiles = disturbance.tiles();
  const double press = tiles.time / double(tiles.options.press_half_life_s);
  const double wet = tiles.time / double(tiles.options.wet_half_life_s);
  const bool again = !whole_ || source_ != &disturbance || tiles.time < last_time_ ||
                     press - press_moment_ > k_most_half_lives || wet - wet_moment_ > k_most_half_lives;
  bool moved = again || regrowing_ || tiles.revision != last_revision_;
  if (again) {
    // Whole half-lives: then rounding is the same whenever this happens.
    press_moment_ = std::floor(press);
    wet_moment_ = std::floor(wet);
    for (Slot& slot : slots_) slot.revision = slot.filled ? ~uint64_t(0) : 0;
  }
  for (int level = 0; level < k_tile_levels; ++level) {
    const glm::dvec2 corner(window_corner(eye, level));
    moved = moved || corner != last_corner_[level];
    last_corner_[level] = corner;
  }
  source_ = &disturbance;
  whole_ = true;
  last_time_ = tiles.time;
  last_revision_ = tiles.revision;
  return moved;
}

DisturbanceTextures::Upload DisturbanceTextures::upload(const Disturbance& disturbance, glm::dvec2 eye) {
  if (!home_.shared_here("DisturbanceTextures::upload")) return {};
  SWARD_ASSERT(std::abs(eye.x) <= Disturbance::k_most_place && std::abs(eye.y) <= Disturbance::k_most_place,
               "the eye must be within 1e9 m");
  Upload written;
  const DisturbanceTiles& tiles = disturbance.tiles();
  if (stale(disturbance, eye)) {
    regrowing_ = false;
    const gl::DefaultUnpack unpack;
    for (int level = 0; level < k_tile_levels; ++level) {
      const glm::ivec2 corner(last_corner_[level]);
      for (int i = 0; i < k_window_tiles * k_window_tiles; ++i)
        write_slot(tiles, level, corner + glm::ivec2(i % k_window_tiles, i / k_window_tiles), written);
    }
  }
  write_block(tiles, eye);
  return written;
}

/// Cells of a tile of this level from those of `tile`: its own, or each `factor` of them on a side from one of a
/// coarser tile, in which the first is `first`.
void DisturbanceTextures::fill_texels(const DisturbanceTiles& tiles, const DisturbanceTile& tile, glm::ivec2 first,
                                      int factor) {
  const CellClock clock = tiles.clock();
  for (int i = 0; i < k_tile_cells; ++i) {
    const glm::ivec2 at = (first + glm::ivec2(i % k_tile_side, i / k_tile_side)) / factor;
    const int cell = at.y * k_tile_side + at.x;
    const Disturbed d = read_cell(tile, cell, clock);
    const glm::vec3 moving = moving_at(tiles, tile, size_t(cell), press_moment_, wet_moment_);
    uint16_t* to = &texels_[size_t(i) * 4];
    for (int c = 0; c < 3; ++c) to[c] = to_half(moving[c]);
    to[3] = to_half(d.cut);
    to[k_layer_texels] = to_half(d.burn);
    for (int c = 0; c < 4; ++c) to[2 * k_layer_texels + size_t(c)] = to_half(d.paint[c]);
  }
}

void DisturbanceTextures::write_slot(const DisturbanceTiles& tiles, int level, glm::ivec2 place, Upload& upload) {
  const TileKey key{level, place};
  TileKey found;
  const DisturbanceTile* tile = tiles.map.empty() ? nullptr : tiles.holder(key, found);
  Slot& slot = slots_[size_t(level * k_window_tiles * k_window_tiles + slot_of(place))];
  if (tile == nullptr && !slot.filled) return;
  Slot wanted;
  wanted.zero = slot.zero;
  if (tile != nullptr) {
    const uint32_t step = regrow_step(*tile, tiles.now());
    regrowing_ = regrowing_ || step != 0;
    wanted = {key.packed(),
              found.packed(),
              found == key ? tile->revision : tile->shown,
              step,
              true,
              tile->lasting != nullptr,
              tile->paint != nullptr,
              slot.zero};
  }
  if (slot == wanted) return;
  texels_.assign(k_layer_texels * k_layers, 0);
  if (tile != nullptr) {
    int factor = 1;
    for (int l = level; l < found.level; ++l) factor *= k_level_factor;
    fill_texels(tiles, *tile, (place - found.place * factor) * k_tile_side, factor);
  }
  wanted.zero = std::ranges::all_of(texels_, [](uint16_t texel) { return texel == 0; });
  // Layers that were empty and stay so are left alone.
  const int layers = wanted.painted || slot.painted ? 3 : wanted.burnt || slot.burnt ? 2 : 1;
  const bool nothing = wanted.zero && slot.zero;
  slot = wanted;
  if (nothing) return;
  const glm::ivec2 corner = (place & (k_window_tiles - 1)) * k_tile_side;
  glTextureSubImage3D(map_.id(), 0, corner.x, corner.y, level * k_layers, k_tile_side, k_tile_side, layers, GL_RGBA,
                      GL_HALF_FLOAT, texels_.data());
  ++upload.tiles;
  upload.bytes += k_layer_texels * size_t(layers) * sizeof(uint16_t);
}

void DisturbanceTextures::write_block(const DisturbanceTiles& tiles, glm::dvec2 eye) {
  gl::DisturbanceBlock block;
  bool filled = false, burnt = false, painted = false;
  for (const Slot& slot : slots_) {
    filled = filled || !slot.zero;
    burnt = burnt || (slot.burnt && !slot.zero);
    painted = painted || (slot.painted && !slot.zero);
  }
  if (filled) {
    block.state = {float(k_tile_levels),
                   float(std::exp2(press_moment_ - tiles.time / double(tiles.options.press_half_life_s))),
                   float(std::exp2(wet_moment_ - tiles.time / double(tiles.options.wet_half_life_s))),
                   painted ? 2.0f
                   : burnt ? 1.0f
                           : 0.0f};
    for (int level = 0; level < k_tile_levels; ++level) {
      const double width = k_side * k_cell_m[level];
      const glm::dvec2 at = eye / width;
      block.level[size_t(level)] =
          glm::vec4(glm::vec2(at - glm::floor(at)), float(1.0 / width), float(level_reach(level)));
    }
  }
  values_ = block;
  glNamedBufferSubData(block_.id(), 0, sizeof values_, &values_);
}

size_t DisturbanceTextures::gpu_bytes() const {
  return gl::storage_bytes(map_) + gl::storage_bytes(block_);
}

}  // namespace sward
