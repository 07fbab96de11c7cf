// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "../terrain/src/terrain/roam_projection.h"
#include "../terrain/src/terrain/roam_tree.h"

/// Fixed-level triangles rebuilt from nothing for each view, in double precision: one recursion over the mesh's tree.
/// What the frame-coherent collection is tested against and timed against.
namespace fixed_level_reference {

using namespace sward;
using namespace sward::roam;

struct PlainTriangles {
  std::vector<FixedTriangle> triangles;
  std::vector<SurfaceNode> surface;  // node 0 is a placeholder
  double surface_z = 0;
};

// Nearest point of the triangle (0, ab, ac) + a to the origin: inside, on an edge or at a corner, by the signs of the
// barycentric coordinates of the projection.
inline double squared_distance_to_edge(glm::dvec3 a, glm::dvec3 ab) {
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(-glm::dot(a, ab) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 p = a + t * ab;
  return glm::dot(p, p);
}

inline double distance_to_triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac);
  const double area2 = glm::dot(normal, normal);
  const double to_b = glm::dot(glm::cross(ac, a), normal), to_c = glm::dot(glm::cross(a, ab), normal);
  if (to_b >= 0 && to_c >= 0 && to_b + to_c <= area2) return std::abs(glm::dot(a, normal)) / std::sqrt(area2);
  return std::sqrt(
      std::min({squared_distance_to_edge(a, ab), squared_distance_to_edge(a, ac), squared_distance_to_edge(b, c - b)}));
}

// A corner on the drawn surface.
struct Corner {
  LatticePoint lattice{0};
  glm::dvec3 world{0};
  std::array<double, 6> plane{};  // distances to the halfspaces
};

struct Triangle {
  TriangleId id;
  Corner apex, left, right;
  Cover cover = Cover::inside;
};

class Collector {
 public:
  Collector(const RoamTree& tree, const View& view, const FixedLevelOptions& options, PlainTriangles& out);
  void run();

 private:
  static constexpr unsigned k_all_planes = 0x3f;

  Corner corner(uint32_t vertex) const;
  Corner middle(const Corner& a, const Corner& b) const;
  bool culled(const Triangle& t, double bound, unsigned& active) const;
  bool beyond_horizon(const Triangle& t, double bound) const;
  bool faces_away(const Triangle& t) const;
  bool all_holes(const Triangle& t) const;
  float screen_area(const Triangle& t) const;
  void visit(uint32_t node, const Triangle& t, unsigned active);
  void split_flat(const Triangle& t, unsigned active);
  void emit(const Triangle& t, uint32_t split_node);
  uint32_t refine(uint32_t node);

  const RoamTree& tree_;
  const Surface& surface_;
  const Lattice& lattice_;
  const View& view_;
  const FixedLevelOptions& options_;
  PlainTriangles& out_;
  std::array<Plane, 6> planes_;
  glm::dmat4 clip_;
  double horizon2_ = 0;
  double level_area_ = 0;  // horizontal, square metres
};

inline Collector::Collector(const RoamTree& tree, const View& view, const FixedLevelOptions& options,
                            PlainTriangles& out)
    : tree_(tree),
      surface_(tree.surface()),
      lattice_(tree.lattice()),
      view_(view),
      options_(options),
      out_(out),
      planes_(frustum_planes(view)),
      clip_(view.clip_from_relative()),
      horizon2_(double(options.horizon_m) * options.horizon_m) {
  const double cells = double(int64_t(1) << lattice_.root_bits);
  level_area_ = std::ldexp(0.5 * cells * cells * lattice_.spacing.x * lattice_.spacing.y, -options.level);
}

inline void Collector::run() {
  out_.surface_z = std::round(view_.eye.z);
  for (uint32_t root = 0; root < tree_.root_count(); ++root) {
    const Corners& c = tree_.corner[root];
    visit(root, {tree_.nodes[root].id, corner(c.apex), corner(c.left), corner(c.right), tree_.nodes[root].cover},
          k_all_planes);
  }
}

inline Corner Collector::corner(uint32_t vertex) const {
  Corner c;
  c.lattice = tree_.vertices.lattice[vertex];
  c.world = tree_.vertices.points[vertex].world;
  for (int i = 0; i < 6; ++i) c.plane[i] = glm::dot(planes_[i].n, c.world - view_.eye) + planes_[i].d;
  return c;
}

inline Corner Collector::middle(const Corner& a, const Corner& b) const {
  Corner m;
  m.lattice = a.lattice + (b.lattice - a.lattice) / 2;
  m.world = glm::dvec3(lattice_.world_xy(m.lattice), 0.5 * (a.world.z + b.world.z));
  for (int i = 0; i < 6; ++i) m.plane[i] = 0.5 * (a.plane[i] + b.plane[i]);
  return m;
}

// What stands on the surface reaches `canopy_m` up and `spread_m` aside from it, the surface lies within `bound` of the triangle. Halfspaces
// that hold all of it are taken out of `active`.
inline bool Collector::culled(const Triangle& t, double bound, unsigned& active) const {
  if (t.cover == Cover::padding || beyond_horizon(t, bound)) return true;
  for (int i = 0; i < 6; ++i) {
    if (!(active >> i & 1)) continue;
    const double a = t.apex.plane[i], b = t.left.plane[i], c = t.right.plane[i];
    const double up = planes_[i].n.z, reach = bound * std::abs(up);
    const double spread = glm::length(glm::dvec2(planes_[i].n)) * options_.spread_m;
    if (std::max({a, b, c}) + reach + std::max(up, 0.0) * options_.canopy_m + spread < 0) return true;
    if (std::min({a, b, c}) - reach + std::min(up, 0.0) * options_.canopy_m - spread >= 0) active &= ~(1u << i);
  }
  return false;
}

inline bool Collector::beyond_horizon(const Triangle& t, double bound) const {
  const glm::dvec3 a = t.apex.world, b = t.left.world, c = t.right.world;
  glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  low.z -= bound;
  high.z += bound + options_.canopy_m;
  const glm::dvec3 gap = view_.eye - glm::clamp(view_.eye, low, high);
  return glm::dot(gap, gap) > horizon2_;
}

inline bool Collector::faces_away(const Triangle& t) const {
  if (!options_.skip_back_faces) return false;
  const glm::dvec3 normal = glm::cross(t.left.world - t.apex.world, t.right.world - t.apex.world);
  return glm::dot(normal, view_.eye - t.apex.world) < -double(options_.canopy_m) * glm::length(normal);
}

// Whether no sample in the triangle's rectangle is valid; such a triangle is smaller than the hole it lies in.
inline bool Collector::all_holes(const Triangle& t) const {
  const LatticePoint a = t.apex.lattice, b = t.left.lattice, c = t.right.lattice;
  return surface_.all_holes({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
}

inline float Collector::screen_area(const Triangle& t) const {
  const double aspect = double(view_.viewport.x) / view_.viewport.y;
  glm::dvec2 p[3];
  const Corner* corners[3] = {&t.apex, &t.left, &t.right};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 clip = clip_ * glm::dvec4(corners[i]->world - view_.eye, 1.0);
    if (corners[i]->plane[4] < 0 || clip.w <= 0) return std::numeric_limits<float>::infinity();
    p[i] = glm::dvec2(clip.x * aspect, clip.y) / clip.w;
  }
  const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
  return float(0.5 * std::abs(u.x * v.y - u.y * v.x));
}

inline void Collector::visit(uint32_t node, const Triangle& t, unsigned active) {
  const bool leaf = tree_.is_leaf(node);
  if (culled(t, leaf ? 0.0 : tree_.corner[node].bound, active)) return;
  if (leaf) {
    if (!faces_away(t)) split_flat(t, active);
  } else if (t.id.level() == options_.level) {
    if (!faces_away(t)) emit(t, node);
  } else {
    const uint32_t child = tree_.child[node];
    const Corner m = corner(tree_.corner[child].apex);
    visit(child, {tree_.nodes[child].id, m, t.apex, t.left, tree_.nodes[child].cover}, active);
    visit(child + 1, {tree_.nodes[child + 1].id, m, t.right, t.apex, tree_.nodes[child + 1].cover}, active);
  }
}

// `t` lies in the plane of a leaf and has been culled against `active`.
inline void Collector::split_flat(const Triangle& t, unsigned active) {
  if (t.id.level() == options_.level) return emit(t, k_none);
  const Corner m = middle(t.left, t.right);
  for (int turn = 0; turn < 2; ++turn) {
    Triangle child{t.id.child(turn), m, turn == 0 ? t.apex : t.right, turn == 0 ? t.left : t.apex, Cover::inside};
    child.cover = cover_of(lattice_, {child.apex.lattice, child.left.lattice, child.right.lattice}, t.cover);
    unsigned still_active = active;
    if (!culled(child, 0.0, still_active)) split_flat(child, still_active);
  }
}

// `split_node`: the mesh's node where the mesh is finer, else k_none.
inline void Collector::emit(const Triangle& t, uint32_t split_node) {
  const glm::dvec3 a = t.apex.world, b = t.left.world, c = t.right.world;
  const double distance = distance_to_triangle(a - view_.eye, b - view_.eye, c - view_.eye);
  if (distance > options_.horizon_m || all_holes(t)) return;
  FixedTriangle f;
  f.apex = a;
  f.to_left = glm::vec3(b - a);
  f.to_right = glm::vec3(c - a);
  f.id = t.id;
  f.surface = split_node == k_none ? 0 : refine(split_node);
  const glm::dvec2 gradient = surface_.data_gradient(glm::dvec2(a + b + c) / 3.0);
  f.area = float(level_area_ * std::sqrt(1.0 + glm::dot(gradient, gradient)));
  f.screen_area = screen_area(t);
  f.distance = float(distance);
  out_.triangles.push_back(f);
}

inline uint32_t Collector::refine(uint32_t node) {
  const uint32_t index = uint32_t(out_.surface.size());
  const uint32_t first = tree_.child[node];
  const double z = tree_.vertices.points[tree_.corner[first].apex].world.z;
  out_.surface.push_back({float(z - out_.surface_z), {0, 0}, 0});
  for (uint32_t turn = 0; turn < 2; ++turn) {
    if (!tree_.is_split(first + turn)) continue;
    const uint32_t below = refine(first + turn);
    out_.surface[index].child[turn] = below;
  }
  return index;
}

/// Clears `out` and rebuilds it.
inline void collect(const RoamTree& tree, const View& view, const FixedLevelOptions& options, PlainTriangles& out) {
  out.triangles.clear();
  out.surface.assign(1, SurfaceNode{});
  Collector(tree, view, options, out).run();
}

}  // namespace fixed_level_reference
