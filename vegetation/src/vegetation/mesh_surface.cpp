// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Newest-vertex bisection of a face with the longest edge as first base keeps the pieces' angles bounded.
#include <sward/vegetation/mesh_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/usable_view.h"
#include "vegetation/mesh_edges.h"

namespace sward {

namespace {

constexpr int k_face_shift = 35;
constexpr int k_level_shift = 58;
constexpr int k_max_turns = 35;
constexpr size_t k_block = 64;
/// Sine of the angle by which a back face has turned away at least.
constexpr double k_turned_away = 0.3;

/// Corners in the world: the same bits in every view.
struct Piece {
  glm::dvec3 apex, left, right;
  uint64_t turns = 0;
  int level = 0;
};

double area_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// How far the corner opposite the longest edge is from the first.
int apex_of(const std::array<glm::dvec3, 3>& corners) {
  std::array<double, 3> opposite{};
  for (size_t i = 0; i < 3; ++i) opposite[i] = glm::distance(corners[(i + 1) % 3], corners[(i + 2) % 3]);
  return int(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
}

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double t = std::clamp(-glm::dot(a, edge) / glm::dot(edge, edge), 0.0, 1.0);
  return glm::length(a + t * edge);
}

/// A piece relative to the eye.
struct Seen {
  glm::dvec3 apex, left, right;

  glm::dvec3 normal() const { return glm::normalize(glm::cross(left - apex, right - apex)); }

  double distance() const {
    const glm::dvec3 n = glm::cross(left - apex, right - apex);
    const glm::dvec3 foot = n * (glm::dot(n, apex) / glm::dot(n, n));
    const bool over = glm::dot(glm::cross(left - apex, foot - apex), n) >= 0 &&
                      glm::dot(glm::cross(right - left, foot - left), n) >= 0 &&
                      glm::dot(glm::cross(apex - right, foot - right), n) >= 0;
    if (over) return glm::length(foot);
    return std::min(
        {distance_to_segment(apex, left), distance_to_segment(left, right), distance_to_segment(right, apex)});
  }

  /// Wholly behind its own plane for the eye, beyond the canopy.
  bool turned_away(double canopy) const {
    const double above = glm::dot(normal(), apex);
    const double farthest = std::max({glm::length(apex), glm::length(left), glm::length(right)});
    return above > canopy && above > k_turned_away * farthest;
  }
};

/// Area in units of (half the viewport's height) squared; infinite with a corner behind the near plane.
float projected_area(const View& view, const Seen& p) {
  const glm::dmat4 clip = view.clip_from_relative();
  const double aspect = double(view.viewport.x) / view.viewport.y;
  std::array<glm::dvec2, 3> screen;
  const std::array<glm::dvec3, 3> corners{p.apex, p.left, p.right};
  for (size_t i = 0; i < 3; ++i) {
    if (-(view.eye_from_world * corners[i]).z < view.near_distance()) return std::numeric_limits<float>::infinity();
    const glm::dvec4 c = clip * glm::dvec4(corners[i], 1.0);
    screen[i] = glm::dvec2(c) / c.w * glm::dvec2(aspect, 1.0);
  }
  const glm::dvec2 u = screen[1] - screen[0], v = screen[2] - screen[0];
  return float(0.5 * std::abs(u.x * v.y - u.y * v.x));
}

/// What is static of a piece.
FixedTriangle make_triangle(const Piece& p, uint64_t face) {
  FixedTriangle triangle;
  triangle.apex = p.apex;
  triangle.to_left = glm::vec3(p.left - p.apex);
  triangle.to_right = glm::vec3(p.right - p.apex);
  triangle.id.bits = uint64_t(p.level) << k_level_shift | face << k_face_shift | p.turns;
  triangle.area = float(area_of(p.apex, p.left, p.right));
  triangle.altitude = glm::vec3(glm::dvec3(p.apex.z, p.left.z, p.right.z));
  return triangle;
}

/// Visits the pieces of a face; `take(piece)` is asked at every level and ends the descent where it answers true.
/// Depth is at most k_max_turns, so recursion is bounded.
template <class Take>
void descend(const Piece& p, const Take& take) {
  if (take(p)) return;
  const glm::dvec3 middle = 0.5 * (p.left + p.right);
  const uint64_t turn = uint64_t(1) << (k_max_turns - 1 - p.level);
  descend({middle, p.apex, p.left, p.turns, p.level + 1}, take);
  descend({middle, p.right, p.apex, p.turns | turn, p.level + 1}, take);
}

bool small_enough(const Piece& p, float max_area) {
  return p.level == k_max_turns || area_of(p.apex, p.left, p.right) <= double(max_area);
}

/// Whether some of a set of points may be seen: by frustum and horizon.
class Culling {
 public:
  Culling(const View& view, const FixedLevelOptions& options)
      : planes_(frustum_planes(view)), eye_(view.eye), options_(options) {}

  bool culled(const Seen& p) const {
    for (const Plane& plane : planes_) {
      const double highest =
          std::max({glm::dot(plane.n, p.apex), glm::dot(plane.n, p.left), glm::dot(plane.n, p.right)});
      if (highest + plane.d + double(options_.canopy_m) < 0.0) return true;
    }
    return p.distance() > double(options_.horizon_m);
  }

  bool culled(const glm::dvec3& low, const glm::dvec3& high) const {
    const glm::dvec3 a = low - eye_, b = high - eye_;
    for (const Plane& plane : planes_) {
      const glm::dvec3 outermost(plane.n.x > 0 ? b.x : a.x, plane.n.y > 0 ? b.y : a.y, plane.n.z > 0 ? b.z : a.z);
      if (glm::dot(plane.n, outermost) + plane.d + double(options_.canopy_m) < 0.0) return true;
    }
    return glm::length(glm::max(glm::max(a, -b), glm::dvec3(0))) > double(options_.horizon_m);
  }

 private:
  std::array<Plane, 6> planes_;
  glm::dvec3 eye_;
  const FixedLevelOptions& options_;
};

Expected<void> check_arrays(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                            std::span<const glm::u8vec3> colors) {
  if (indices.size() % 3 != 0) return fail("a mesh of triangles needs three indices a face");
  if (indices.size() / 3 > MeshSurface::k_max_faces) {
    return fail("the mesh has " + std::to_string(indices.size() / 3) + " faces, at most " +
                std::to_string(MeshSurface::k_max_faces) + " can be named; simplify it or split it");
  }
  if (!colors.empty() && colors.size() != positions.size()) {
    return fail("the mesh has " + std::to_string(colors.size()) + " colours for " + std::to_string(positions.size()) +
                " positions, expected one each or none");
  }
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= positions.size()) {
      return fail("face " + std::to_string(i / 3) + " of the mesh has corner " + std::to_string(indices[i]) +
                  ", but there are only " + std::to_string(positions.size()));
    }
  }
  return {};
}

glm::u8vec3 middle_color(glm::u8vec3 a, glm::u8vec3 b) {
  return glm::u8vec3((glm::ivec3(a) + glm::ivec3(b) + 1) / 2);
}

}  // namespace

void TriangleMesh::transform(const glm::dmat4& matrix) {
  for (glm::dvec3& p : positions) p = glm::dvec3(matrix * glm::dvec4(p, 1.0));
}

void TriangleMesh::paint(glm::u8vec3 color) {
  colors.assign(positions.size(), color);
}

void TriangleMesh::append(const TriangleMesh& other) {
  if (colors.empty() != other.colors.empty()) colors.resize(positions.size(), glm::u8vec3(255));
  const uint32_t first = uint32_t(positions.size());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  colors.insert(colors.end(), other.colors.begin(), other.colors.end());
  if (!colors.empty()) colors.resize(positions.size(), glm::u8vec3(255));
  for (const uint32_t index : other.indices) indices.push_back(first + index);
}

std::string MeshReport::text() const {
  std::string text;
  const auto add = [&](size_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + what;
  };
  add(dropped_faces, "faces without area or with corners that are not finite are left out, the first is face " +
                         std::to_string(first_dropped) + " (remove or mend them)");
  add(open_edges, "edges have one face: the body has holes (close them, or plants will show what is behind)");
  add(non_manifold_edges, "edges have more than two faces (plants stand on all of them; separate the parts)");
  return text;
}

Expected<MeshSurface> MeshSurface::create(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                                          std::span<const glm::u8vec3> colors) {
  if (auto valid = check_arrays(positions, indices, colors); !valid) return tl::unexpected(valid.error());
  MeshSurface surface;
  surface.corners_.reserve(indices.size());
  surface.colors_.reserve(indices.size());
  for (size_t i = 0; i < indices.size(); i += 3) {
    const std::array<glm::dvec3, 3> face{positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]};
    const bool usable =
        finite(face[0]) && finite(face[1]) && finite(face[2]) && area_of(face[0], face[1], face[2]) > 0.0;
    if (!usable && surface.report_.dropped_faces++ == 0) surface.report_.first_dropped = i / 3;
    const int apex = usable ? apex_of(face) : 0;
    for (int corner = 0; corner < 3; ++corner) {
      const size_t at = size_t(apex + corner) % 3;
      surface.corners_.push_back(usable ? face[at] : glm::dvec3(0));
      surface.colors_.push_back(colors.empty() ? glm::u8vec3(255) : colors[indices[i + at]]);
    }
  }
  if (surface.report_.dropped_faces == surface.faces()) return fail("the mesh has no face with an area");
  const EdgeCount edges = count_edges(surface.corners_);
  surface.report_.open_edges = edges.open;
  surface.report_.non_manifold_edges = edges.non_manifold;
  surface.bound_blocks();
  return surface;
}

void MeshSurface::bound_blocks() {
  for (size_t first = 0; first < faces(); first += k_block) {
    Block block{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (size_t i = 3 * first; i < std::min(3 * (first + k_block), corners_.size()); ++i) {
      if (corners_[i] == glm::dvec3(0) && corners_[i / 3 * 3] == corners_[i / 3 * 3 + 1]) continue;  // left out
      block.low = glm::min(block.low, corners_[i]);
      block.high = glm::max(block.high, corners_[i]);
    }
    blocks_.push_back(block);
  }
}

void MeshSurface::fixed_level_triangles(const View& view, float max_area_m2, const FixedLevelOptions& options,
                                        FixedTriangles& out) const {
  SWARD_ASSERT(max_area_m2 > 0.0f, "the largest area of a piece must be positive");
  out.clear();
  if (!usable(view, "MeshSurface::fixed_level_triangles")) return;
  const Culling culling(view, options);
  for (size_t face = 0; face < faces(); ++face) {
    if (face % k_block == 0 && culling.culled(blocks_[face / k_block].low, blocks_[face / k_block].high)) {
      face += k_block - 1;
      continue;
    }
    const glm::dvec3* c = &corners_[face * 3];
    if (c[0] == c[1]) continue;  // left out
    descend({c[0], c[1], c[2]}, [&](const Piece& p) {
      const Seen seen{p.apex - view.eye, p.left - view.eye, p.right - view.eye};
      if (culling.culled(seen)) return true;
      if (!small_enough(p, max_area_m2)) return false;
      if (options.skip_back_faces && seen.turned_away(double(options.canopy_m))) return true;
      FixedTriangle triangle = make_triangle(p, face);
      triangle.screen_area = projected_area(view, seen);
      triangle.distance = float(seen.distance());
      out.push_back(triangle);
      return true;
    });
  }
}

void MeshSurface::all_triangles(float max_area_m2, FixedTriangles& out) const {
  SWARD_ASSERT(max_area_m2 > 0.0f, "the largest area of a piece must be positive");
  out.clear();
  for (size_t face = 0; face < faces(); ++face) {
    const glm::dvec3* c = &corners_[face * 3];
    if (c[0] == c[1]) continue;  // left out
    descend({c[0], c[1], c[2]}, [&](const Piece& p) {
      if (!small_enough(p, max_area_m2)) return false;
      FixedTriangle triangle = make_triangle(p, face);
      triangle.screen_area = std::numeric_limits<float>::infinity();
      out.push_back(triangle);
      return true;
    });
  }
}

std::array<glm::u8vec3, 3> MeshSurface::piece_colors(TriangleId id) const {
  const size_t face = size_t(id.bits >> k_face_shift) & (k_max_faces - 1);
  SWARD_ASSERT(face < faces(), "the piece is of another mesh");
  std::array<glm::u8vec3, 3> c{colors_[3 * face], colors_[3 * face + 1], colors_[3 * face + 2]};
  for (int level = 0; level < id.level(); ++level) {
    const glm::u8vec3 middle = middle_color(c[1], c[2]);
    const bool second = id.bits >> (k_max_turns - 1 - level) & 1;
    if (second)
      c = {middle, c[2], c[0]};
    else
      c = {middle, c[0], c[1]};
  }
  return c;
}

}  // namespace sward
