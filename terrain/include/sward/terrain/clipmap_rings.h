// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sward {

struct ClipmapOptions {
  /// Points a side of the memory of each ring: a power of two, 64..1024. A ring has 16 cells fewer a side.
  int texels = 256;
};

/// Geometry clipmaps (Losasso and Hoppe, "Geometry Clipmaps", 2004; Asirvatham and Hoppe, "Terrain Rendering Using
/// GPU-Based Geometry Clipmaps", 2005): nested square grids of the finest heights around the eye, each with cells twice
/// as wide as the one inside of it. The CPU's half: what each ring holds, what has to be read, where the drawn surface
/// is. One thread at a time.
/// ```
///  +---------------+   Ring 0 is the finest: its cells are the triangles of the lattice's deepest level. A ring draws
///  | ring 1        |   what the finer one does not cover. Towards its outer border its heights melt into the coarser
///  |   +-------+   |   ring's surface, so that neighbours meet. Cells are cut as the bintree cuts them (the diagonal
///  |   | ring 0|   |   joins corners whose indices are both even with such as are both odd): a ring is a uniform
///  |   |  eye  |   |   bintree of an even level, and on ring 0 within its melting border the drawn surface is
///  |   +-------+   |   Surface::height(xy).
///  +---------------+
/// ```
/// Departures: heights come from the surface's own height function, relief included, instead of a compressed pyramid;
/// rings' windows follow the bintree's lattice, so that the plants of a triangle are those of any other terrain; the
/// innermost ring melts away as the eye rises above it instead of vanishing.
class SWARD_API ClipmapRings {
 public:
  static constexpr int k_most_rings = 20;
  static constexpr int k_block_cells = 16;  ///< Cells a side of what is culled as one.

  /// `surface` must outlive the rings. Empty until the first follow(). Fails on options out of range.
  static Expected<ClipmapRings> create(const Surface& surface, const ClipmapOptions& options = {});

  /// Points of a ring read anew: first column and row, counted in the ring's cells from lattice point 0, and how many.
  struct Change {
    int ring = 0;
    glm::ivec2 first{0}, size{0};
  };
  /// Moves the rings to a view: only rows and columns that a window has come to are read, of at most `most_points`
  /// points (at least one whole ring), the coarsest ring first. Rings that would take more are left out of the picture
  /// until a later call. The answer is valid until the next call. Cost: that of Surface::grid_heights for them.
  std::span<const Change> follow(const View& view, size_t most_points = std::numeric_limits<size_t>::max());
  /// Heights may have changed here (EditResult::changed, World::poll): later calls of follow() read them again.
  void changed(const LatticeBox& box);
  /// Whether follow() with this view has nothing left to read.
  bool settled() const { return settled_; }

  const Surface& surface() const { return *surface_; }
  int texels() const { return texels_; }      ///< Of the memory, a side: point p lies at p modulo texels().
  int cells() const { return texels_ - 16; }  ///< Of a ring, a side.
  int rings() const { return int(rings_.size()); }
  int finest() const { return finest_; }  ///< Of the rings that are drawn; rings() before the first follow().
  int shift(int ring) const { return rings_[size_t(ring)].shift; }         ///< log2 of a cell's side, lattice units.
  glm::ivec2 first(int ring) const { return rings_[size_t(ring)].first; }  ///< First column, row of its window.
  double base() const { return base_; }                                    ///< World z that heights are above, metres.
  /// Toroidal rows of texels() heights above base(), and of gradients of the relief (empty far away, where it is 0).
  std::span<const float> heights(int ring) const { return rings_[size_t(ring)].z; }
  std::span<const glm::vec2> relief(int ring) const { return rings_[size_t(ring)].relief; }

  // How heights melt: at `m` cells from the eye, the larger of the two axes, by clamp((m - begin) / width, 0, 1).
  double melt_begin() const { return cells() / 2 - 2 - melt_width(); }
  double melt_width() const { return cells() / 10; }
  /// How far all of the finest ring has melted, because the eye is high above it: 0..1.
  double finest_melt() const { return finest_melt_; }
  /// The eye of the last follow(), moved onto the data, in lattice units (x east, y south).
  glm::dvec2 eye() const { return eye_; }

  /// The drawn surface at world x, y as of the last follow(), metres; NaN beyond the data and before it.
  double height(glm::dvec2 xy) const;

  /// A part of a ring: cells from k_block_cells * place.
  struct Block {
    int32_t ring = 0;
    glm::ivec2 place{0};
  };
  /// The blocks that may be seen from the last follow()'s view, the nearest ring first. Clears `out` first.
  void visible_blocks(const View& view, std::vector<Block>& out) const;

 private:
  struct Ring {
    int shift = 0;
    bool filled = false, has_relief = false;
    glm::ivec2 first{0};
    glm::ivec2 stale_first{0}, stale_last{-1};  // points that have changed; empty: none
    std::vector<float> z;
    std::vector<glm::vec2> relief;
    std::vector<glm::vec2> range;  // of heights, by block
  };
  ClipmapRings(const Surface& surface, int texels);
  glm::ivec2 window_for(const Ring& ring) const;
  size_t plan(const Ring& ring, int index, glm::ivec2 want, std::vector<Change>& parts) const;
  void read(const Change& change);
  void measure(Ring& ring);
  void choose_finest(const View& view, int first_usable);
  size_t place_of(glm::ivec2 point) const;
  double melted_height(int ring, glm::ivec2 point) const;
  double coarser_height(int ring, glm::ivec2 point) const;
  bool in_hole(int ring, glm::ivec2 first_cell, int cells) const;

  const Surface* surface_ = nullptr;
  int texels_ = 256;
  int finest_ = 0;
  double base_ = 0, finest_melt_ = 0;
  bool settled_ = false;
  glm::dvec2 eye_{0};
  std::vector<Ring> rings_;
  std::vector<Change> changes_, parts_;
  std::vector<float> scratch_z_;
  std::vector<glm::vec2> scratch_relief_;
};

}  // namespace sward
