// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/disturbed_ground.h>
#include <sward/gl/handles.h>
#include <sward/vegetation/disturbance.h>
#include <vector>

namespace sward {

struct DisturbanceTile;

/// What shaders read of a Disturbance around the eye: three nested windows of 256 x 256 cells (0.125, 0.5, 2 m), good
/// within 14.9, 59.5 and 238 m of the eye east and north; each is blended with the next over the last quarter of its
/// reach, and beyond the last nothing is disturbed. Cells keep their texels while the eye moves (toroidal), so that
/// only tiles of 16 x 16 cells that have changed or that the window has come to are written.
///
/// Press and water are stored as of one moment (half floats, exact to 1/2048 of themselves), and one factor a frame
/// lets them decay, so that plants rise smoothly with nothing written; every ten half-lives all of it is written anew.
///
/// GL thread. Owns a texture (RGBA16F array, 9 layers, 4.7 MB) and a uniform buffer.
class SWARD_API DisturbanceTextures {
 public:
  /// Fails where there is no context of GL 4.5. Leaves all state as it was.
  static Expected<DisturbanceTextures> create();

  struct Upload {
    uint32_t tiles = 0;  ///< Written.
    size_t bytes = 0;
  };
  /// Before a frame is drawn, for its eye (world, metres). Must not be called with an earlier time of the same
  /// disturbance, unless it has been loaded or cleared since. Leaves all state as it was. Cost: nothing but 64 bytes
  /// where neither the eye has come to other tiles nor anything has changed; else a look at 768 tiles and some 6 KB a
  /// tile that is new.
  Upload upload(const Disturbance& disturbance, glm::dvec2 eye);

  /// For GroundTextures::set_disturbed(): terrain and all plants then follow. Stays the same object for life.
  gl::DisturbedGround ground() const { return {block_.id(), map_.id()}; }

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;

  /// What was last written into the block; its first number is 0 while nothing is disturbed around the eye.
  const gl::DisturbanceBlock& block() const { return values_; }

 private:
  /// What a place in the texture for one tile holds.
  struct Slot {
    uint64_t key = 0, holder = 0, revision = 0;  ///< Tile; the tile that its cells came from, and its state.
    uint32_t step = 0;                           ///< Of regrowth.
    bool filled = false, burnt = false, painted = false;
    bool zero = true;  ///< The texels are all 0.
    bool operator==(const Slot&) const = default;
  };
  void fill_texels(const DisturbanceTiles& tiles, const DisturbanceTile& tile, glm::ivec2 first, int factor);
  bool stale(const Disturbance& disturbance, glm::dvec2 eye);
  void write_slot(const DisturbanceTiles& tiles, int level, glm::ivec2 place, Upload& upload);
  void write_block(const DisturbanceTiles& tiles, glm::dvec2 eye);

  gl::HomeContext home_;
  gl::Texture map_;
  gl::Buffer block_;
  gl::DisturbanceBlock values_;
  std::vector<Slot> slots_;
  std::vector<uint16_t> texels_;
  double press_moment_ = 0, wet_moment_ = 0;  ///< In half-lives: what stored press and water are as of.
  const Disturbance* source_ = nullptr;
  double last_time_ = -1;
  uint64_t last_revision_ = 0;
  glm::dvec2 last_corner_[gl::k_disturbance_levels];
  bool regrowing_ = false, whole_ = false;
};

}  // namespace sward
