// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/fixed_triangles.h>

#include <algorithm>
#include <cmath>

namespace sward {

TriangleId TriangleId::root(int root, glm::ivec2 square) {
  SWARD_ASSERT(root == 0 || root == 1, "a root square has roots 0 and 1");
  SWARD_ASSERT(square.x >= -1024 && square.x < 1024 && square.y >= -1024 && square.y < 1024,
               "root squares are counted from -1024 to 1023");
  return {uint64_t(root) << 57 | uint64_t(square.x + 1024) << 46 | uint64_t(square.y + 1024) << 35};
}

TriangleId TriangleId::child(int turn) const {
  SWARD_ASSERT(level() < k_max_level, "triangles of the deepest level have no children");
  return {(bits + (uint64_t(1) << 58)) | uint64_t(turn) << (34 - level())};
}

TriangleCorners corners_of(TriangleId id) {
  const LatticePoint nw = id.square() * k_root_side;
  const LatticePoint se = nw + LatticePoint(k_root_side);
  const LatticePoint ne{se.x, nw.y}, sw{nw.x, se.y};
  TriangleCorners c = id.root() == 0 ? TriangleCorners{nw, sw, ne} : TriangleCorners{se, ne, sw};
  for (int level = 0; level < id.level(); ++level) {
    const LatticePoint m = c.left + (c.right - c.left) / 2;
    const bool second = id.bits >> (34 - level) & 1;
    c = second ? TriangleCorners{m, c.right, c.apex} : TriangleCorners{m, c.apex, c.left};
  }
  return c;
}

void FixedTriangles::Columns::resize(size_t count) {
  apex.resize(count);
  to_left.resize(count);
  to_right.resize(count);
  id.resize(count);
  surface.resize(count);
  area.resize(count);
  screen_area.resize(count);
  distance.resize(count);
}

FixedTriangles::FixedTriangles() : nodes_(1) {}

FixedTriangles::FixedTriangles(const FixedTriangles& other)
    : columns_(other.columns_), nodes_(other.nodes_), surface_z_(other.surface_z_) {}

FixedTriangles& FixedTriangles::operator=(const FixedTriangles& other) {
  columns_ = other.columns_;
  nodes_ = other.nodes_;
  surface_z_ = other.surface_z_;
  ++contents_;
  return *this;
}

FixedTriangles::FixedTriangles(FixedTriangles&&) noexcept = default;
FixedTriangles& FixedTriangles::operator=(FixedTriangles&&) noexcept = default;
FixedTriangles::~FixedTriangles() = default;

FixedTriangle FixedTriangles::operator[](size_t i) const {
  SWARD_ASSERT(i < size(), "no such triangle");
  const Columns& c = columns_;
  return {c.apex[i], c.to_left[i], c.to_right[i],    c.id[i],
          c.surface[i], c.area[i], c.screen_area[i], c.distance[i]};
}

void FixedTriangles::push_back(const FixedTriangle& triangle) {
  columns_.resize(size() + 1);
  set(size() - 1, triangle);
}

void FixedTriangles::set(size_t i, const FixedTriangle& triangle) {
  SWARD_ASSERT(i < size(), "no such triangle");
  columns_.apex[i] = triangle.apex;
  columns_.to_left[i] = triangle.to_left;
  columns_.to_right[i] = triangle.to_right;
  columns_.id[i] = triangle.id;
  columns_.surface[i] = triangle.surface;
  columns_.area[i] = triangle.area;
  columns_.screen_area[i] = triangle.screen_area;
  columns_.distance[i] = triangle.distance;
  ++contents_;
}

uint32_t FixedTriangles::add_node(const SurfaceNode& node) {
  nodes_.push_back(node);
  ++contents_;
  return uint32_t(nodes_.size() - 1);
}

void FixedTriangles::set_surface_z(double z) {
  surface_z_ = z;
  ++contents_;
}

void FixedTriangles::clear() {
  columns_.resize(0);
  nodes_.assign(1, SurfaceNode{});
  surface_z_ = 0;
  ++contents_;
}

FixedTriangles::Writer FixedTriangles::write(size_t triangles, size_t nodes) {
  SWARD_ASSERT(nodes >= 1, "the placeholder is a node");
  columns_.resize(triangles);
  nodes_.resize(nodes);
  nodes_[0] = {};
  ++contents_;
  Columns& c = columns_;
  return {c.apex, c.to_left, c.to_right, c.id, c.surface, c.area, c.screen_area, c.distance, nodes_};
}

int level_for_area(const HeightField& field, double area_m2) {
  SWARD_ASSERT(area_m2 > 0, "the area of a triangle must be positive");
  const double cells = double(int64_t(1) << field.root_bits());
  const double root_area = 0.5 * cells * cells * field.desc().spacing.x * field.desc().spacing.y;
  return int(std::clamp(std::round(std::log2(root_area / area_m2)), 0.0, double(k_max_level)));
}

}  // namespace sward
