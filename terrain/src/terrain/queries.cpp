// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rays against the bintree's wedgies (Duchaineau et al., "ROAMing Terrain", 1997, section 4).
//
// A piece of the ray inside a triangle is kept as its two ends: distance along the ray, weights of the left and the
// right corner, height above the triangle's plane. All are linear along the ray. Splitting the triangle at the middle
// m of its base cuts the piece where both weights are equal, so that its parts lie in one child each, without gap or
// overlap, and
//   child 0 = (m, apex, left):  weights (1 - l - r, l - r),     child 1 = (m, right, apex): weights (r - l, 1 - l - r),
//   and the child's plane is higher by (z(m) - (z(left) + z(right)) / 2) times m's weight, 2 r or 2 l.
// Nothing is clipped twice, so rays along edges and through corners need no care. The surface lies within the bound of
// the plane; where the bound is 0 it is the plane. Holes and padding are not in the bounds: pieces end at the data's
// border, and data triangles with a hole at a corner are left out.

#include <sward/terrain/queries.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bounds_parallel.h"

namespace sward {

namespace {

// Rounding of heights above planes, metres: heights below 2^18 m have 3e-11 m, and 40 of them are added up.
constexpr double k_touch = 1e-8;
// Depth that line of sight forgives.
constexpr double k_on_ground = 1e-6;

struct End {
  double t;            // Metres along the ray.
  double left, right;  // Weights of those corners.
  double above;        // Height over the triangle's plane.
};

End between(const End& a, const End& b, double share) {
  return {a.t + share * (b.t - a.t), a.left + share * (b.left - a.left), a.right + share * (b.right - a.right),
          a.above + share * (b.above - a.above)};
}

// Where the ray's height above the plane is 0, given that its ends are not on one side.
double crossing(const End& a, const End& b) {
  const double fall = a.above - b.above;
  return fall == 0.0 ? a.t : a.t + std::clamp(a.above / fall, 0.0, 1.0) * (b.t - a.t);
}

struct Corner {
  LatticePoint p;
  double z;
};

struct Node {
  Corner apex, left, right;
  int level;
};

enum class Answer { go_on, stop, look_below };

// Nearest hit of the surface, from either side.
struct HitSeeker {
  double t = 0;
  std::optional<Node> triangle;

  Answer judge(const Node&, const End& a, const End& b, double bound, bool) const {
    const bool outside = std::min(a.above, b.above) > bound + k_touch || std::max(a.above, b.above) < -bound - k_touch;
    return outside ? Answer::go_on : Answer::look_below;
  }
  // The surface is the plane.
  Answer flat(const Node& node, const End& a, const End& b) {
    if (judge(node, a, b, 0.0, true) == Answer::go_on) return Answer::go_on;
    t = std::abs(a.above) <= k_touch ? a.t : crossing(a, b);
    triangle = node;
    return Answer::stop;
  }
};

// First point in the ground.
struct GroundSeeker {
  double t = 0;

  Answer judge(const Node&, const End& a, const End& b, double bound, bool covered) {
    if (std::min(a.above, b.above) >= bound - k_on_ground) return Answer::go_on;
    if (!covered || a.above >= -bound - k_on_ground) return Answer::look_below;
    t = a.t;
    return Answer::stop;
  }
  Answer flat(const Node&, const End& a, const End& b) {
    if (std::min(a.above, b.above) >= -k_on_ground) return Answer::go_on;
    t = a.above < -k_on_ground ? a.t : crossing(a, b);
    return Answer::stop;
  }
};

// The part [begin, end] of origin + t * direction in which low <= it <= high; empty when end < begin.
struct Interval {
  double begin, end;

  bool empty() const { return !(begin <= end); }
  void clip(double origin, double direction, double low, double high) {
    if (direction == 0.0) {
      if (!(origin >= low && origin <= high)) end = -1.0, begin = 0.0;
      return;
    }
    const double a = (low - origin) / direction, b = (high - origin) / direction;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
};

// A line in lattice units across and metres up, parameter: metres.
struct Line {
  glm::dvec2 origin, direction;
  double z, rise;

  Line(const Lattice& lattice, const glm::dvec3& from, const glm::dvec3& unit)
      : direction(glm::dvec2(unit.x, -unit.y) / lattice.spacing * double(lattice.sample_step())),
        z(from.z),
        rise(unit.z) {
    const glm::dvec2 samples = (glm::dvec2(from) - glm::dvec2(lattice.origin)) / lattice.spacing;
    origin = glm::dvec2(samples.x + 0.5 * (lattice.columns - 1), 0.5 * (lattice.rows - 1) - samples.y) *
             double(lattice.sample_step());
  }
};

template <class Seeker>
class Walk {
 public:
  Walk(const Bounds& bounds, const Line& line, Seeker& seeker)
      : bounds_(bounds),
        field_(bounds.field()),
        line_(line),
        seeker_(seeker),
        data_level_(field_.data_level()),
        max_level_(field_.max_level()),
        has_holes_(field_.hole_count() > 0) {}

  // Front to back through the root squares; `part` lies over the data.
  void run(Interval part) {
    const glm::ivec2 last_square = field_.root_squares() - 1;
    glm::ivec2 square;
    for (int i = 0; i < 2; ++i) {
      const double place = (line_.origin[i] + part.begin * line_.direction[i]) / k_root_side;
      square[i] = int(std::clamp(std::floor(place), 0.0, double(last_square[i])));
      // On the border with the square before, and bound for it.
      if (line_.direction[i] < 0.0 && square[i] > 0 && place <= double(square[i])) --square[i];
    }
    for (double begin = part.begin;;) {
      glm::dvec2 leaves(std::numeric_limits<double>::infinity());
      for (int i = 0; i < 2; ++i) {
        if (line_.direction[i] == 0.0) continue;
        const double border = double(k_root_side) * (square[i] + (line_.direction[i] > 0.0 ? 1 : 0));
        leaves[i] = (border - line_.origin[i]) / line_.direction[i];
      }
      const int axis = leaves.x <= leaves.y ? 0 : 1;
      const double end = std::min(part.end, std::max(begin, leaves[axis]));
      if (in_square(square, begin, end) == Answer::stop || end >= part.end) return;
      square[axis] += line_.direction[axis] > 0.0 ? 1 : -1;
      if (square[axis] < 0 || square[axis] > last_square[axis]) return;
      begin = end;
    }
  }

 private:
  Corner corner(LatticePoint p) const { return {p, field_.height(p)}; }

  // The end at t in a root triangle: legs from the apex run along the axes.
  End end_in(const Node& root, double t) const {
    const glm::dvec2 place = (line_.origin + t * line_.direction - glm::dvec2(root.apex.p)) / double(k_root_side);
    // Root 0: left is south, right is east; root 1: left is north, right is west.
    const double sign = root.left.p.y > root.apex.p.y ? 1.0 : -1.0;
    const double left = sign * place.y, right = sign * place.x;
    const double plane = root.apex.z + left * (root.left.z - root.apex.z) + right * (root.right.z - root.apex.z);
    return {t, left, right, line_.z + t * line_.rise - plane};
  }

  Answer in_square(glm::ivec2 square, double begin, double end) {
    const LatticePoint at = square * k_root_side;
    const Corner nw = corner(at), ne = corner(at + LatticePoint(k_root_side, 0));
    const Corner sw = corner(at + LatticePoint(0, k_root_side)), se = corner(at + k_root_side);
    const Node roots[2] = {{nw, sw, ne, 0}, {se, ne, sw, 0}};
    // Cut along the common base, where the apex has no weight.
    const auto apex_weight = [&](double t) {
      const End e = end_in(roots[0], t);
      return 1.0 - e.left - e.right;
    };
    const double a = apex_weight(begin), b = apex_weight(end);
    const int first = a > 0.0 || (a == 0.0 && b > 0.0) ? 0 : 1;
    if ((a >= 0.0) == (b >= 0.0) || a == 0.0 || b == 0.0) {
      const int side = a == 0.0 ? first : (a > 0.0 ? 0 : 1);
      return in_triangle(roots[side], end_in(roots[side], begin), end_in(roots[side], end));
    }
    const double cut = begin + a / (a - b) * (end - begin);
    const Node& front = roots[first];
    const Node& back = roots[1 - first];
    if (in_triangle(front, end_in(front, begin), end_in(front, cut)) == Answer::stop) return Answer::stop;
    return in_triangle(back, end_in(back, cut), end_in(back, end));
  }

  bool touches_hole(const Node& node) const {
    const int step = field_.sample_step();
    const auto hole = [&](LatticePoint p) { return field_.is_hole(p.x / step, p.y / step); };
    return hole(node.apex.p) || hole(node.left.p) || hole(node.right.p);
  }

  Answer in_triangle(const Node& node, const End& a, const End& b) {
    if (has_holes_ && node.level == data_level_ && touches_hole(node)) return Answer::go_on;
    // Above the data's level bounds say nothing of holes, and where they are 0 there may be no data at all.
    const bool covered = !has_holes_ || node.level >= data_level_;
    const LatticePoint middle = (node.left.p + node.right.p) / 2;
    const double bound = double(bounds_.bound(middle, node.level));
    if (node.level >= max_level_ || (covered && bound == 0.0)) return seeker_.flat(node, a, b);
    const Answer answer = seeker_.judge(node, a, b, bound, covered);
    if (answer != Answer::look_below) return answer;
    return in_children(node, corner(middle), a, b);
  }

  Answer in_child(int turn, const Node& node, const Corner& middle, const End& a, const End& b) {
    const double bend = middle.z - 0.5 * (node.left.z + node.right.z);
    const auto seen = [&](const End& e) {
      const double apex = 1.0 - e.left - e.right;
      if (turn == 0) return End{e.t, apex, e.left - e.right, e.above - 2.0 * e.right * bend};
      return End{e.t, e.right - e.left, apex, e.above - 2.0 * e.left * bend};
    };
    const Node child = turn == 0 ? Node{middle, node.apex, node.left, node.level + 1}
                                 : Node{middle, node.right, node.apex, node.level + 1};
    return in_triangle(child, seen(a), seen(b));
  }

  Answer in_children(const Node& node, const Corner& middle, const End& a, const End& b) {
    const double at_a = a.left - a.right, at_b = b.left - b.right;
    if (at_a >= 0.0 && at_b >= 0.0) return in_child(0, node, middle, a, b);
    if (at_a <= 0.0 && at_b <= 0.0) return in_child(1, node, middle, a, b);
    End cut = between(a, b, at_a / (at_a - at_b));
    cut.left = cut.right = 0.5 * (cut.left + cut.right);
    const int front = at_a > 0.0 ? 0 : 1;
    if (in_child(front, node, middle, a, cut) == Answer::stop) return Answer::stop;
    return in_child(1 - front, node, middle, cut, b);
  }

  const Bounds& bounds_;
  const HeightField& field_;
  const Line& line_;
  Seeker& seeker_;
  int data_level_, max_level_;
  bool has_holes_;
};

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Cuts the line to what is over the data.
void clip_to_data(const HeightField& field, const Line& line, Interval& part) {
  const glm::dvec2 last(field.lattice().last());
  part.clip(line.origin.x, line.direction.x, 0.0, last.x);
  part.clip(line.origin.y, line.direction.y, 0.0, last.y);
}

glm::dvec3 normal_of(const Lattice& lattice, const Node& node) {
  const auto place = [&](const Corner& c) { return glm::dvec3(lattice.world_xy(c.p), c.z); };
  const glm::dvec3 apex = place(node.apex);
  return glm::normalize(glm::cross(place(node.left) - apex, place(node.right) - apex));
}

// Splits [0, questions) over threads; `cost` is that of one in units of which 2^14 are worth a thread.
template <class One>
void in_parallel(size_t questions, int64_t cost, int threads, One&& one) {
  constexpr size_t k_block = 16;
  const auto rows = int((questions + k_block - 1) / k_block);
  parallel_rows({rows, cost * int64_t(k_block), threads}, {}, [&](int row) {
    const size_t first = size_t(row) * k_block;
    for (size_t i = first; i < std::min(first + k_block, questions); ++i) one(i);
  });
}

constexpr int64_t k_ray_cost = 64;

}  // namespace

std::optional<RayHit> TerrainQueries::ray(const Ray& ray) const {
  const double largest = std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
  if (!finite(ray.origin) || !finite(ray.direction) || !(largest > 0.0) || !(ray.max_distance >= 0.0)) return {};
  // Twice, so that neither the largest nor the smallest numbers lose their direction.
  const glm::dvec3 unit = glm::normalize(ray.direction / largest);
  const Line line(field_->lattice(), ray.origin, unit);
  Interval part{0.0, ray.max_distance};
  clip_to_data(*field_, line, part);
  const double beyond = field_->relief_amplitude() + k_touch;
  part.clip(line.z, line.rise, field_->height_range()[0] - beyond, field_->height_range()[1] + beyond);
  if (part.empty()) return {};
  HitSeeker seeker;
  Walk<HitSeeker>(*bounds_, line, seeker).run(part);
  if (!seeker.triangle) return {};
  return RayHit{seeker.t, ray.origin + seeker.t * unit, normal_of(field_->lattice(), *seeker.triangle)};
}

SightResult TerrainQueries::line_of_sight(const Sight& sight) const {
  SightResult result;
  if (!finite(sight.from) || !finite(sight.to)) return result;
  const glm::dvec3 way = sight.to - sight.from;
  const double length = glm::length(way);
  if (!std::isfinite(length)) return result;
  const glm::dvec3 unit = length > 0.0 ? way / length : glm::dvec3(0.0);
  const Line line(field_->lattice(), sight.from, unit);
  Interval part{0.0, length};
  clip_to_data(*field_, line, part);
  const double top = field_->height_range()[1] + field_->relief_amplitude();
  part.clip(line.z, line.rise, -std::numeric_limits<double>::max(), top);
  result.visible = true;
  if (part.empty()) return result;
  GroundSeeker seeker{-1.0};
  Walk<GroundSeeker>(*bounds_, line, seeker).run(part);
  if (seeker.t < 0.0) return result;
  return {false, sight.from + seeker.t * unit};
}

void TerrainQueries::heights(std::span<const glm::dvec2> xy, std::span<double> out, int threads) const {
  SWARD_ASSERT(xy.size() == out.size(), "one answer a question");
  in_parallel(xy.size(), 1, threads, [&](size_t i) { out[i] = height(xy[i]); });
}

void TerrainQueries::normals(std::span<const glm::dvec2> xy, std::span<glm::dvec3> out, int threads) const {
  SWARD_ASSERT(xy.size() == out.size(), "one answer a question");
  in_parallel(xy.size(), 1, threads, [&](size_t i) { out[i] = normal(xy[i]); });
}

void TerrainQueries::rays(std::span<const Ray> rays, std::span<std::optional<RayHit>> out, int threads) const {
  SWARD_ASSERT(rays.size() == out.size(), "one answer a question");
  in_parallel(rays.size(), k_ray_cost, threads, [&](size_t i) { out[i] = ray(rays[i]); });
}

void TerrainQueries::lines_of_sight(std::span<const Sight> sights, std::span<SightResult> out, int threads) const {
  SWARD_ASSERT(sights.size() == out.size(), "one answer a question");
  in_parallel(sights.size(), k_ray_cost, threads, [&](size_t i) { out[i] = line_of_sight(sights[i]); });
}

}  // namespace sward
