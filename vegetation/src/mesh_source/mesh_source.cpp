// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Newest-vertex bisection of a face with the longest edge as first base keeps the pieces' angles bounded.
#include <sward/mesh_source/mesh_source.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sward {

namespace {

constexpr int k_face_shift = 35;
constexpr int k_level_shift = 58;
constexpr int k_max_turns = 35;

struct Piece {
  glm::dvec3 apex, left, right;  // relative to the eye
  uint64_t turns = 0;
  int level = 0;
};

double area_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

bool finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// The corner opposite the longest edge comes first.
void make_apex_first(glm::dvec3* corners) {
  std::array<double, 3> opposite{};
  for (int i = 0; i < 3; ++i) opposite[size_t(i)] = glm::distance(corners[(i + 1) % 3], corners[(i + 2) % 3]);
  const auto longest = std::max_element(opposite.begin(), opposite.end()) - opposite.begin();
  std::rotate(corners, corners + longest, corners + 3);
}

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double t = std::clamp(-glm::dot(a, edge) / glm::dot(edge, edge), 0.0, 1.0);
  return glm::length(a + t * edge);
}

// From the origin to the nearest point of a triangle.
double distance_to_triangle(const Piece& p) {
  const glm::dvec3 n = glm::cross(p.left - p.apex, p.right - p.apex);
  const glm::dvec3 foot = n * (glm::dot(n, p.apex) / glm::dot(n, n));
  const bool over = glm::dot(glm::cross(p.left - p.apex, foot - p.apex), n) >= 0 &&
                    glm::dot(glm::cross(p.right - p.left, foot - p.left), n) >= 0 &&
                    glm::dot(glm::cross(p.apex - p.right, foot - p.right), n) >= 0;
  if (over) return glm::length(foot);
  return std::min({distance_to_segment(p.apex, p.left), distance_to_segment(p.left, p.right),
                   distance_to_segment(p.right, p.apex)});
}

// Area in units of (half the viewport's height) squared; infinite with a corner behind the near plane.
float projected_area(const View& view, const Piece& p) {
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

struct Emitter {
  const View& view;
  std::array<Plane, 6> planes;
  float max_area;
  const FixedLevelOptions& options;
  uint64_t face;
  FixedTriangles& out;

  bool culled(const Piece& p) const {
    for (const Plane& plane : planes) {
      const double highest =
          std::max({glm::dot(plane.n, p.apex), glm::dot(plane.n, p.left), glm::dot(plane.n, p.right)});
      if (highest + plane.d + options.canopy_m < 0.0) return true;
    }
    return distance_to_triangle(p) > double(options.horizon_m);
  }

  void emit(const Piece& p, double area) const {
    const glm::dvec3 normal = glm::normalize(glm::cross(p.left - p.apex, p.right - p.apex));
    if (options.skip_back_faces && glm::dot(normal, p.apex) > double(options.canopy_m)) return;
    FixedTriangle triangle;
    triangle.apex = p.apex + view.eye;
    triangle.to_left = glm::vec3(p.left - p.apex);
    triangle.to_right = glm::vec3(p.right - p.apex);
    triangle.id.bits = uint64_t(p.level) << k_level_shift | face << k_face_shift | p.turns;
    triangle.area = float(area);
    triangle.screen_area = projected_area(view, p);
    triangle.distance = float(distance_to_triangle(p));
    triangle.altitude = glm::vec3(glm::dvec3(p.apex.z, p.left.z, p.right.z) + view.eye.z);
    out.push_back(triangle);
  }

  // Depth is at most k_max_turns, so recursion is bounded.
  void visit(const Piece& p) const {
    if (culled(p)) return;
    const double area = area_of(p.apex, p.left, p.right);
    if (area <= double(max_area) || p.level == k_max_turns) return emit(p, area);
    const glm::dvec3 middle = 0.5 * (p.left + p.right);
    const uint64_t turn = uint64_t(1) << (k_max_turns - 1 - p.level);
    visit({middle, p.apex, p.left, p.turns, p.level + 1});
    visit({middle, p.right, p.apex, p.turns | turn, p.level + 1});
  }
};

}  // namespace

Expected<MeshSource> MeshSource::from_corners(std::vector<glm::dvec3> corners) {
  if (corners.size() % 3 != 0) return fail("a mesh of triangles needs three corners a face");
  MeshSource source;
  for (size_t i = 0; i < corners.size(); i += 3) {
    glm::dvec3* face = &corners[i];
    const bool usable =
        finite(face[0]) && finite(face[1]) && finite(face[2]) && area_of(face[0], face[1], face[2]) > 0.0;
    if (!usable) {
      ++source.dropped_faces_;
      continue;
    }
    make_apex_first(face);
    source.corners_.insert(source.corners_.end(), face, face + 3);
  }
  if (source.corners_.empty()) return fail("the mesh has no face with an area");
  if (source.faces() > k_max_faces) {
    return fail("the mesh has " + std::to_string(source.faces()) + " faces, at most " + std::to_string(k_max_faces) +
                " can be named");
  }
  return source;
}

void MeshSource::fixed_level_triangles(const View& view, float max_area_m2, const FixedLevelOptions& options,
                                       FixedTriangles& out) const {
  SWARD_ASSERT(max_area_m2 > 0.0f, "the largest area of a piece must be positive");
  out.clear();
  const auto planes = frustum_planes(view);
  for (size_t face = 0; face < faces(); ++face) {
    const glm::dvec3* c = &corners_[face * 3];
    const Emitter emitter{view, planes, max_area_m2, options, face, out};
    emitter.visit({c[0] - view.eye, c[1] - view.eye, c[2] - view.eye});
  }
}

}  // namespace sward
