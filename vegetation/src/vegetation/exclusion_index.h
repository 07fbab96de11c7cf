// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Which parts of a host's shapes concern a triangle. Shapes are cut down twice: to square cells of the world, which are
// kept until the shapes change, and from the cell's parts to the triangle's. What is left of a polygon for a triangle
// are the edges that the ray to the east can cross from a place on it, and whether the rest of them puts it inside:
//
//      +-----------------+         An edge is left out when it lies above, below or to the west of the box; one to the
//      |   box  .------->|  /      east that spans its height is crossed from everywhere, and only flips `inside`.
//      |                 | /
//      +-----------------+/
#include <sward/vegetation/placement.h>
#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace sward {

/// What a box needs to know of a polygon.
struct PolygonPart {
  uint32_t entry = 0;
  bool inside = false;
  std::vector<uint32_t> edges;  ///< By the number of their first corner.
};

enum class Reach { none, some, all };

class ExclusionIndex {
 public:
  /// Follows the shapes for a layer, dropping what no longer holds. `reach` bounds how far triangles extend from their
  /// apex, metres. Null: no shapes.
  void follow(const Exclusions* exclusions, const std::string& layer, double reach);
  bool empty() const { return exclusions_ == nullptr; }

  /// Shapes near the triangle `apex`, `apex + to_left`, `apex + to_right` (x, y), appended to `run` as
  /// common_placement.glsl describes, without its end. `all`: it is covered, and the run is of no use.
  Reach shapes_near(glm::dvec2 apex, glm::vec2 to_left, glm::vec2 to_right, std::vector<glm::vec4>& run);

 private:
  struct Cell {
    bool covered = false;
    std::vector<uint32_t> discs;
    std::vector<PolygonPart> polygons;
  };
  const Cell& cell_of(glm::dvec2 apex);
  Cell build(glm::dvec2 low, glm::dvec2 high) const;

  const Exclusions* exclusions_ = nullptr;
  std::string layer_;
  uint64_t version_ = 0;
  double reach_ = 0, cell_m_ = 1;
  std::unordered_map<uint64_t, Cell> cells_;
  uint64_t last_key_ = 0;
  const Cell* last_ = nullptr;
  PolygonPart scratch_;
};

}  // namespace sward
