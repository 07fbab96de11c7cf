// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/lattice.h>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace sward::gl {

inline constexpr int k_slope_tile = 128;   ///< Texels along the side of what is written at a time.
inline constexpr int k_slope_factor = 4;   ///< From a layer's stride to the next one's; as in terrain.frag.glsl.
inline constexpr int k_slope_layers = 12;  ///< At most: enough for 1024 squares of 16384 cells in windows of 256.

/// Which texels of a slope map hold what: bookkeeping without GL, after the geometry clipmaps of Losasso and Hoppe
/// (2004). Texel (i, j) of the layer of stride s stands for the sample s (i, j). Where the whole surface fits there is
/// one layer of stride 1. Else each layer is a square window of the same size around the eye, four times as wide as the
/// one before, the last as wide as the surface; a window moves by whole tiles, and a tile lies at its place modulo the
/// window, so that what stays is not written again.
///
///     stride 16   +---------------+       a tile of 128 x 128 texels is
///     stride 4    |   +-------+   |         missing  its place holds another tile, or nothing
///     stride 1    |   | [eye] |   |         stale    the surface has changed since
///                 |   +-------+   |
///                 +---------------+
class SlopeTiles {
 public:
  struct Tile {
    int layer = 0;
    glm::ivec2 tile{0};    ///< Counted in tiles of the layer.
    bool missing = false;  ///< Where a picture may need it, as opposed to one that is old or beyond reach.
    double distance = 0;   ///< From the eye, samples.
  };

  /// `samples` of the surface; at most `window` texels a side (a power of two, at least 4 tiles) unless all of it fits
  /// into `whole` texels.
  SlopeTiles(glm::ivec2 samples, int window, int whole);

  int layers() const { return int(layers_.size()); }
  int stride(int layer) const { return layers_[size_t(layer)].stride; }
  /// Texels of every layer.
  glm::ivec2 texels() const { return texels_; }
  bool windowed() const { return layers_.size() > 1; }
  /// Samples from the eye, in x and in y, up to which the first layer holds all that is there; the others four times as
  /// far each, the last everywhere.
  double reach() const { return (texels_.x / 2 - 1.5 * k_slope_tile); }

  /// Moves the windows; `eye` in samples.
  void follow(glm::dvec2 eye);
  /// The surface has changed between these samples, both included.
  void changed(glm::ivec2 first, glm::ivec2 last);
  /// What is to be written next: all that is missing within reach, and of the rest the nearest ones, `budget` at most.
  std::vector<Tile> take(size_t budget);
  bool settled() const { return pending_ == 0; }

  /// Texels of a tile: from `first`, `size` of them; `place` is where they lie in the texture.
  struct Box {
    glm::ivec2 first, size, place;
  };
  Box box(const Tile& tile) const;

 private:
  struct Layer {
    int stride = 1;
    glm::ivec2 grid{1};                // tiles of the whole surface
    glm::ivec2 first{0};               // tile of the window
    std::vector<glm::ivec2> holds;     // by slot; -1: nothing
    std::vector<unsigned char> stale;  // by slot
  };
  size_t slot(glm::ivec2 tile) const;
  void count_pending();
  void gather(int layer, std::vector<Tile>& all) const;

  glm::ivec2 texels_{1}, slots_{1};
  std::vector<Layer> layers_;
  glm::dvec2 eye_{0};
  size_t pending_ = 0;
};

}  // namespace sward::gl
