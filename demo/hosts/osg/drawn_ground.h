// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/color_map.h>
#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace osg {
class Image;
class Node;
}  // namespace osg

namespace sward::osg_host {

/// The triangles that OpenSceneGraph draws as ground, whoever made them (osgTerrain and its techniques, a model), and
/// their height anywhere. Plants stand on what is drawn, not on what it was made from: a technique chooses the diagonal
/// of each square of a height field, and interpolation of the four heights is neither of the two. Immutable; safe from
/// several threads.
class DrawnGround {
 public:
  /// Copies the triangles below a node, in its parent's coordinates. Tiles of osgTerrain have theirs after
  /// TerrainTile::init(). Fails where there are none.
  static Expected<DrawnGround> create(osg::Node& node);

  /// Of the highest triangle at x, y, in the node's parent's coordinates; NaN where there is none.
  double height(glm::dvec2 xy) const;
  glm::dvec3 low() const { return low_; }
  glm::dvec3 high() const { return high_; }

 private:
  struct Triangle {
    glm::dvec3 a, b, c;
  };
  void sort_into_cells();
  glm::ivec2 cell_of(glm::dvec2 xy) const;

  std::vector<Triangle> triangles_;
  std::vector<uint32_t> first_, of_cell_;  // triangles of cell i: of_cell_[first_[i]] to before first_[i + 1]
  glm::dvec3 low_{0}, high_{0};
  glm::ivec2 cells_{1};
};

/// A colour layer's image as base map over a rectangle of ground; the image's first row is the south, as osgTerrain's
/// layers have it. Fails without pixels.
Expected<ColorMap> color_map_of(const osg::Image& image, glm::dvec2 low, glm::dvec2 high);

}  // namespace sward::osg_host
