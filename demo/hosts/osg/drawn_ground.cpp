// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "drawn_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <osg/Drawable>
#include <osg/Image>
#include <osg/NodeVisitor>
#include <osg/TriangleFunctor>

namespace sward::osg_host {

namespace {

// Corners are floats: how far beyond an edge, as a share of the triangle, a place still belongs to it.
constexpr double k_slack = 1e-4;

glm::dvec3 to_glm(const osg::Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

template <class Take>
struct TakeTriangles {
  const Take* take = nullptr;
  void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const { (*take)(a, b, c); }
};

template <class Take>
class Collector : public osg::NodeVisitor {
 public:
  explicit Collector(const Take& take) : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), take_(take) {}
  void apply(osg::Drawable& drawable) override {
    const osg::Matrixd world = osg::computeLocalToWorld(getNodePath());
    const auto in_world = [&](const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c) {
      take_(to_glm(osg::Vec3d(a) * world), to_glm(osg::Vec3d(b) * world), to_glm(osg::Vec3d(c) * world));
    };
    osg::TriangleFunctor<TakeTriangles<decltype(in_world)>> functor;
    functor.take = &in_world;
    drawable.accept(functor);
  }

 private:
  const Take& take_;
};

}  // namespace

Expected<DrawnGround> DrawnGround::create(osg::Node& node) {
  DrawnGround ground;
  const auto take = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    // Walls and skirts are no ground.
    if (std::abs(cross(glm::dvec2(b - a), glm::dvec2(c - a))) > 1e-9) ground.triangles_.push_back({a, b, c});
  };
  Collector collector(take);
  node.accept(collector);
  if (ground.triangles_.empty()) return fail("the node has no triangles to stand on; call init() on its tiles first");
  ground.low_ = ground.high_ = ground.triangles_[0].a;
  for (const Triangle& t : ground.triangles_)
    for (const glm::dvec3& p : {t.a, t.b, t.c}) {
      ground.low_ = glm::min(ground.low_, p);
      ground.high_ = glm::max(ground.high_, p);
    }
  ground.sort_into_cells();
  return ground;
}

glm::ivec2 DrawnGround::cell_of(glm::dvec2 xy) const {
  const glm::dvec2 share = (xy - glm::dvec2(low_)) / glm::dvec2(high_ - low_);
  return glm::clamp(glm::ivec2(glm::floor(share * glm::dvec2(cells_))), glm::ivec2(0), cells_ - 1);
}

// About two triangles a cell.
void DrawnGround::sort_into_cells() {
  cells_ = glm::ivec2(std::max(1, int(std::sqrt(double(triangles_.size()) / 2))));
  const auto for_cells = [&](const Triangle& t, const auto& take) {
    const glm::ivec2 first = cell_of(glm::min(glm::dvec2(t.a), glm::min(glm::dvec2(t.b), glm::dvec2(t.c)))),
                     last = cell_of(glm::max(glm::dvec2(t.a), glm::max(glm::dvec2(t.b), glm::dvec2(t.c))));
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) take(size_t(y) * size_t(cells_.x) + size_t(x));
  };
  first_.assign(size_t(cells_.x) * size_t(cells_.y) + 1, 0);
  for (const Triangle& t : triangles_) for_cells(t, [&](size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  of_cell_.resize(first_.back());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (size_t i = 0; i < triangles_.size(); ++i)
    for_cells(triangles_[i], [&](size_t cell) { of_cell_[next[cell]++] = uint32_t(i); });
}

double DrawnGround::height(glm::dvec2 xy) const {
  const glm::ivec2 place = cell_of(xy);
  const size_t cell = size_t(place.y) * size_t(cells_.x) + size_t(place.x);
  double highest = std::numeric_limits<double>::quiet_NaN();
  for (uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const Triangle& t = triangles_[of_cell_[i]];
    const glm::dvec2 u(t.b - t.a), v(t.c - t.a), to = xy - glm::dvec2(t.a);
    const double area = cross(u, v), along_u = cross(to, v) / area, along_v = cross(u, to) / area;
    if (along_u < -k_slack || along_v < -k_slack || along_u + along_v > 1 + k_slack) continue;
    highest = std::fmax(highest, t.a.z + along_u * (t.b.z - t.a.z) + along_v * (t.c.z - t.a.z));
  }
  return highest;
}

Expected<ColorMap> color_map_of(const osg::Image& image, glm::dvec2 low, glm::dvec2 high) {
  if (!image.valid()) return fail("the colour layer has no image; load it before the plants are made");
  ColorMap map;
  map.width = image.s();
  map.height = image.t();
  map.min_corner = low;
  map.size = high - low;
  for (int row = map.height - 1; row >= 0; --row)
    for (int column = 0; column < map.width; ++column) {
      const osg::Vec4 color = image.getColor(unsigned(column), unsigned(row));
      map.texels.emplace_back(glm::round(glm::vec4(color.r(), color.g(), color.b(), 1) * 255.0f));
    }
  map.bounds = bound_colors(map);
  return map;
}

}  // namespace sward::osg_host
