// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/handles.h>
#include <sward/terrain/height_field.h>
#include <sward/terrain/surface.h>
#include <cstddef>
#include <memory>
#include <span>

namespace sward::gl {

struct SlopeMapOptions {
  /// A surface with at most so many samples a side is held whole, a larger one in windows around the eye. 1..the
  /// device's largest texture.
  int whole_texels = 4097;
  /// Texels a side of each window: a power of two, 512..8192. A window takes 5.3 bytes a texel, and the farthest place
  /// that it serves sees its texels under an angle of 1 / (0.4 window_texels).
  int window_texels = 2048;
};

/// Slopes of the data (dz/dx, dz/dy) for shading: one array texture, one layer for a surface that fits, for larger ones
/// windows around the eye of which each is four times as wide and as coarse as the one before. GL thread.
class SWARD_API SlopeMap {
 public:
  /// All of a field, one layer. Fails beyond the device's largest texture. Leaves all state as it was.
  static Expected<SlopeMap> create(const HeightField& field);
  /// For a surface that may change: empty until the first follow(). Fails where the device's textures are too small.
  static Expected<SlopeMap> create(const Surface& surface, const SlopeMapOptions& options = {});
  /// Level ground over a rectangle (western, southern corner and metres): never followed or updated. For hosts that
  /// draw their ground themselves. Leaves all state as it was.
  static Expected<SlopeMap> create_level(glm::dvec2 min_corner, glm::dvec2 size);
  SlopeMap(SlopeMap&&) noexcept;
  SlopeMap& operator=(SlopeMap&&) noexcept;
  ~SlopeMap();

  /// Before each draw from another eye (world x, y): windows move, and at most `tiles` tiles of 128 x 128 slopes that
  /// are out of date are read again, the nearest first; places that would show nothing or other ground are filled at
  /// once, whatever that takes. Cost: some 0.5 ms a tile, and for a map held whole the
  /// GPU's for its mip levels. Leaves all state as it was. `surface` is the one it was created for.
  void follow(const Surface& surface, glm::dvec2 eye, size_t tiles);
  /// The data's slopes may have changed here: each box of World::poll(), EditResult::changed.
  void changed(const LatticeBox& box);
  /// Whether follow() has nothing left to do.
  bool settled() const;
  /// Reads what has changed of the field that it was made from, at once.
  void update(const HeightField& field, const LatticeBox& changed);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  GLuint texture() const;  ///< RG16F 2D array, trilinear.
  int layers() const;
  /// World corner (west, south) and metres of the rectangle that one period of a layer's texture covers.
  glm::dvec2 layer_min(int layer) const;
  glm::dvec2 layer_size(int layer) const;
  bool repeats() const;        ///< Layers are windows, addressed modulo their size.
  double reach() const;        ///< Samples from the eye up to which layer 0 is to be used; see SlopeTiles.
  glm::dvec2 spacing() const;  ///< Metres between samples.

 private:
  struct Impl;
  explicit SlopeMap(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward::gl
