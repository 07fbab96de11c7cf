// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/terrain.h>
#include <bitset>
#include <unordered_map>
#include <vector>

namespace roam_driver {

/// A field whose finer data come and go by squares, 4 x 4 over the lattice, as a world's do: a diamond below the coarse
/// level may be split while the squares of all its ancestors of that level are there. What each diamond needs is found
/// by going down the bintree once, not by the world's own search upwards.
class PartlyResident final : public sward::Surface {
 public:
  static constexpr int k_across = 4;
  using Squares = std::bitset<size_t(k_across* k_across)>;

  explicit PartlyResident(const sward::Bounds& bounds) : field_(bounds) {
    present_.set();
    coarsest_ = std::max(2, (lattice().max_level - 6) / 2 * 2);
  }

  const sward::Lattice& lattice() const override { return field_.lattice(); }
  double height(sward::LatticePoint p) const override { return field_.height(p); }
  glm::dvec2 relief_gradient(sward::LatticePoint p) const override { return field_.relief_gradient(p); }
  float bound(sward::LatticePoint centre, int level) const override { return field_.bound(centre, level); }
  glm::dvec2 data_gradient(glm::dvec2 xy) const override { return field_.data_gradient(xy); }
  bool all_holes(const sward::LatticeBox& box) const override { return field_.all_holes(box); }
  double height(glm::dvec2 xy) const override { return field_.height(xy); }
  glm::dvec2 height_range() const override { return field_.height_range(); }
  bool can_split(sward::LatticePoint centre, int level) const override {
    if (level < coarsest_ || present_.all()) return true;
    if (level >= lattice().max_level) return false;
    return (needs(centre) & ~present_).none();
  }

  const Squares& present() const { return present_; }
  /// Loads and drops squares; the box around all that may be split or may not any more.
  sward::LatticeBox set_present(const Squares& present) {
    const Squares changed = present ^ present_;
    present_ = present;
    sward::LatticeBox box{sward::LatticePoint(0), sward::LatticePoint(-1)};
    const sward::LatticePoint end = extent();
    // Descendants of a cell of the coarse level stay within one and a half cells of its centre.
    const int reach = 2 * (sward::k_root_side >> (coarsest_ / 2));
    for (int i = 0; i < k_across * k_across; ++i) {
      if (!changed[size_t(i)]) continue;
      const sward::LatticePoint at(i % k_across, i / k_across);
      const sward::LatticePoint first = end / k_across * at - reach, last = (end / k_across + 1) * (at + 1) + reach;
      box = box.empty() ? sward::LatticeBox{first, last}
                        : sward::LatticeBox{glm::min(box.first, first), glm::max(box.last, last)};
    }
    return box;
  }

 private:
  static uint64_t key(sward::LatticePoint p) { return uint64_t(uint32_t(p.x)) << 32 | uint32_t(p.y); }
  sward::LatticePoint extent() const { return lattice().root_squares * sward::k_root_side; }

  const Squares& needs(sward::LatticePoint centre) const {
    if (needs_.empty()) go_down();
    return needs_.at(key(centre));
  }

  // Level by level; the apex of a triangle is the centre of its parent's diamond.
  void go_down() const {
    std::vector<sward::TriangleCorners> level_of, next;
    for (int row = 0; row < lattice().root_squares.y; ++row)
      for (int column = 0; column < lattice().root_squares.x; ++column)
        for (const int root : {0, 1})
          level_of.push_back(sward::corners_of(sward::TriangleId::root(root, {column, row})));
    for (int level = 0; level < lattice().max_level; ++level, level_of.swap(next)) {
      next.clear();
      for (const sward::TriangleCorners& c : level_of) {
        const sward::LatticePoint m = (c.left + c.right) / 2;
        if (level == coarsest_) {
          const sward::LatticePoint at = glm::min(m / (extent() / k_across + 1), sward::LatticePoint(k_across - 1));
          needs_[key(m)].set(size_t(at.y * k_across + at.x));
        } else if (level > coarsest_) {
          needs_[key(m)] |= needs_.at(key(c.apex));
        }
        next.push_back({m, c.apex, c.left});
        next.push_back({m, c.right, c.apex});
      }
    }
  }

  sward::FieldSurface field_;
  Squares present_;
  int coarsest_ = 0;
  mutable std::unordered_map<uint64_t, Squares> needs_;
};

}  // namespace roam_driver
