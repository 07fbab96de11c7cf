// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/bindings.h>
#include <sward/gl/handles.h>
#include <sward/terrain/clipmap_rings.h>
#include <cstddef>
#include <limits>

namespace sward::gl {

/// Mirror of `SwardClipmap` in shaders/common_clipmap.glsl (std140; offsets asserted in clipmap.cpp).
struct ClipmapUniforms {
  glm::ivec4 grid{0};   ///< Cells a side of a ring; mask of its memory's indices; rings; the finest that is drawn.
  glm::ivec4 from{0};   ///< x, y: the lattice point that places count from, near the eye.
  glm::vec4 place{0};   ///< Metres a lattice unit east and north (negative); x, y of that point, relative to the eye.
  glm::vec4 eye{0};     ///< x, y: the rings' eye, in lattice units from that point.
  glm::vec4 height{0};  ///< The heights' origin, relative to the eye; where melting begins, cells, 1 / its width; how
                        ///< far the finest ring has melted.
  glm::ivec4 ring[ClipmapRings::k_most_rings]{};  ///< First column, row; log2 of a cell's side; 1 where it has relief.
};

/// Clipmap rings in textures, for shaders that want the drawn surface: terrain, seeding, plants. GL thread.
class SWARD_API Clipmap {
 public:
  /// `surface` must outlive it. Empty until the first follow(). Fails on options out of range and a GL below 4.5.
  /// Memory on the GPU: 8 bytes a point of a ring. Leaves all state as it was.
  static Expected<Clipmap> create(const Surface& surface, const ClipmapOptions& options = {});

  /// What one follow() sent to the GPU.
  struct Upload {
    size_t points = 0;  ///< Heights.
    size_t bytes = 0;   ///< Theirs, those of the relief's gradients and of the uniforms.
    int rects = 0;      ///< Texture updates.
  };
  /// Moves the rings to a view before it is drawn, by rows and columns: see ClipmapRings::follow(). Leaves all state as
  /// it was; asks GL for pixel-store state only in frames that have something to send.
  Upload follow(const View& view, size_t most_points = std::numeric_limits<size_t>::max());
  /// ClipmapRings::changed().
  void changed(const LatticeBox& box) { rings_.changed(box); }

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  const ClipmapRings& rings() const { return rings_; }
  GLuint heights() const { return heights_.id(); }  ///< R32F 2D array, one layer a ring, for texelFetch.
  GLuint relief() const { return relief_.id(); }    ///< RG16F 2D array, layers as far as rings have relief.
  GLuint block() const { return block_.id(); }      ///< Uniform buffer of ClipmapUniforms for the last view.

 private:
  explicit Clipmap(ClipmapRings rings) : rings_(std::move(rings)) {}
  void send(const ClipmapRings::Change& change, Upload& upload);

  HomeContext home_;
  ClipmapRings rings_;
  Texture heights_, relief_;
  Buffer block_;
};

/// The uniforms of rings as of their last follow(), which was for `view`.
SWARD_API ClipmapUniforms make_clipmap_uniforms(const ClipmapRings& rings, const View& view);

}  // namespace sward::gl
