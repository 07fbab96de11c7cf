// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/fixed_triangles.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

void FixedTriangles::Columns::grow(size_t count) {
  if (count <= id.size()) return;
  count = std::max(count, id.size() + id.size() / 2);
  apex.resize(count);
  to_left.resize(count);
  to_right.resize(count);
  id.resize(count);
  surface.resize(count);
  area.resize(count);
  screen_area.resize(count);
  distance.resize(count);
  altitude.resize(count);
}

FixedTriangles::FixedTriangles() : nodes_(1) {}

FixedTriangles::FixedTriangles(const FixedTriangles& other)
    : columns_(other.columns_),
      nodes_(other.nodes_),
      count_(other.count_),
      node_count_(other.node_count_),
      surface_z_(other.surface_z_) {}

FixedTriangles& FixedTriangles::operator=(const FixedTriangles& other) {
  columns_ = other.columns_;
  nodes_ = other.nodes_;
  count_ = other.count_;
  node_count_ = other.node_count_;
  surface_z_ = other.surface_z_;
  ++contents_;
  return *this;
}

FixedTriangles::FixedTriangles(FixedTriangles&& other) noexcept
    : columns_(std::move(other.columns_)),
      nodes_(std::move(other.nodes_)),
      count_(std::exchange(other.count_, 0)),
      node_count_(std::exchange(other.node_count_, 0)),
      surface_z_(other.surface_z_),
      contents_(other.contents_++),
      memory_(std::move(other.memory_)) {}

FixedTriangles& FixedTriangles::operator=(FixedTriangles&& other) noexcept {
  columns_ = std::move(other.columns_);
  nodes_ = std::move(other.nodes_);
  count_ = std::exchange(other.count_, 0);
  node_count_ = std::exchange(other.node_count_, 0);
  surface_z_ = other.surface_z_;
  contents_ = other.contents_++;
  memory_ = std::move(other.memory_);
  return *this;
}
FixedTriangles::~FixedTriangles() = default;

FixedTriangle FixedTriangles::operator[](size_t i) const {
  SWARD_ASSERT(i < size(), "no such triangle");
  const Columns& c = columns_;
  return {c.apex[i], c.to_left[i],     c.to_right[i], c.id[i],      c.surface[i],
          c.area[i], c.screen_area[i], c.distance[i], c.altitude[i]};
}

void FixedTriangles::push_back(const FixedTriangle& triangle) {
  write(count_ + 1, std::max<size_t>(node_count_, 1));
  set(count_ - 1, triangle);
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
  columns_.altitude[i] = triangle.altitude;
  ++contents_;
}

uint32_t FixedTriangles::add_node(const SurfaceNode& node) {
  write(count_, std::max<size_t>(node_count_, 1) + 1).nodes.back() = node;
  return uint32_t(node_count_ - 1);
}

void FixedTriangles::set_surface_z(double z) {
  surface_z_ = z;
  ++contents_;
}

void FixedTriangles::clear() {
  write(0, 1);
  surface_z_ = 0;
}

FixedTriangles::Writer FixedTriangles::write(size_t triangles, size_t nodes) {
  SWARD_ASSERT(nodes >= 1, "the placeholder is a node");
  columns_.grow(triangles);
  if (nodes > nodes_.size()) nodes_.resize(std::max(nodes, nodes_.size() + nodes_.size() / 2));
  nodes_[0] = {};
  count_ = triangles;
  node_count_ = nodes;
  ++contents_;
  Columns& c = columns_;
  return {{c.apex.data(), count_},        {c.to_left.data(), count_},  {c.to_right.data(), count_},
          {c.id.data(), count_},          {c.surface.data(), count_},  {c.area.data(), count_},
          {c.screen_area.data(), count_}, {c.distance.data(), count_}, {nodes_.data(), node_count_},
          {c.altitude.data(), count_}};
}

int level_for_area(const Lattice& lattice, double area_m2) {
  SWARD_ASSERT(area_m2 > 0, "the area of a triangle must be positive");
  const double cells = double(int64_t(1) << lattice.root_bits);
  const double root_area = 0.5 * cells * cells * lattice.spacing.x * lattice.spacing.y;
  return int(std::clamp(std::round(std::log2(root_area / area_m2)), 0.0, double(k_max_level)));
}

int level_for_area(const HeightField& field, double area_m2) {
  return level_for_area(field.lattice(), area_m2);
}

}  // namespace sward
