// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// What OpenSceneGraph's visitors find of a scene's ground.

#include "sward_drawable.h"

#include <cmath>
#include <osgUtil/LineSegmentIntersector>
#include <utility>

#include "ground_ray.h"

namespace sward::osg_host {

namespace {

constexpr int k_most_squares = 128;  // along a side

osg::Vec3d to_osg(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}
glm::dvec3 to_glm(const osg::Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

osgUtil::LineSegmentIntersector::Intersection intersection_of(const GroundHit& hit,
                                                              osgUtil::IntersectionVisitor& visitor,
                                                              osg::Drawable* drawable) {
  osgUtil::LineSegmentIntersector::Intersection result;
  result.ratio = hit.ratio;
  result.matrix = visitor.getModelMatrix();
  result.nodePath = visitor.getNodePath();
  result.drawable = drawable;
  result.localIntersectionPoint = to_osg(hit.point);
  result.localIntersectionNormal = to_osg(hit.normal);
  return result;
}

void intersect_segment(osgUtil::IntersectionVisitor& visitor, osgUtil::LineSegmentIntersector& segment,
                       SwardDrawable& drawable) {
  if (segment.reachedLimit()) return;
  using Limit = osgUtil::Intersector;
  const auto limit = segment.getIntersectionLimit();
  const auto hits =
      meet_ground(drawable.terrain(), to_glm(segment.getStart()), to_glm(segment.getEnd()), limit != Limit::NO_LIMIT);
  for (const GroundHit& hit : hits) {
    auto& known = segment.getIntersections();
    if (limit == Limit::LIMIT_NEAREST && !known.empty()) {
      if (known.begin()->ratio <= hit.ratio) return;
      known.clear();
    }
    segment.insertIntersection(intersection_of(hit, visitor, &drawable));
  }
}

}  // namespace

struct SwardDrawable::Grid {
  std::vector<osg::Vec3> points;
  std::vector<GLuint> triangles;

  explicit Grid(const Surface& surface);
};

SwardDrawable::Grid::Grid(const Surface& surface) {
  const Lattice& lattice = surface.lattice();
  const glm::ivec2 squares = glm::min(glm::ivec2(lattice.columns, lattice.rows) - 1, glm::ivec2(k_most_squares));
  const glm::dvec2 low = lattice.min_corner(), size = lattice.max_corner() - low;
  for (int y = 0; y <= squares.y; ++y)
    for (int x = 0; x <= squares.x; ++x) {
      const glm::dvec2 at = low + size * glm::dvec2(x, y) / glm::dvec2(squares);
      const double height = surface.height(at);
      points.emplace_back(osg::Vec3d(at.x, at.y, std::isfinite(height) ? height : surface.height_range().x));
    }
  const auto index = [&](int x, int y) { return GLuint(y * (squares.x + 1) + x); };
  for (int y = 0; y < squares.y; ++y)
    for (int x = 0; x < squares.x; ++x)
      for (const GLuint corner :
           {index(x, y), index(x + 1, y), index(x + 1, y + 1), index(x, y), index(x + 1, y + 1), index(x, y + 1)})
        triangles.push_back(corner);
}

const SwardDrawable::Grid& SwardDrawable::grid() const {
  std::call_once(grid_once_, [this] { grid_ = std::make_shared<const Grid>(terrain().surface()); });
  return *grid_;
}

void SwardDrawable::accept(osg::PrimitiveFunctor& functor) const {
  if (!pool_) return;
  functor.setVertexArray(unsigned(grid().points.size()), grid().points.data());
  functor.drawElements(GL_TRIANGLES, GLsizei(grid().triangles.size()), grid().triangles.data());
}

void SwardDrawable::accept(osg::NodeVisitor& visitor) {
  osgUtil::IntersectionVisitor* intersections = visitor.asIntersectionVisitor();
  if (intersections == nullptr || intersections->getIntersector() == nullptr || !pool_)
    return osg::Drawable::accept(visitor);
  if (!visitor.validNodeMask(*this) || intersections->getDoDummyTraversal()) return;
  visitor.pushOntoNodePath(this);
  // In the coordinates of this node, and writing to the visitor's own.
  const osg::ref_ptr<osgUtil::Intersector> local(intersections->getIntersector()->clone(*intersections));
  intersect(*intersections, *local);
  visitor.popFromNodePath();
}

void SwardDrawable::intersect(osgUtil::IntersectionVisitor& visitor, osgUtil::Intersector& intersector) {
  if (auto* segment = dynamic_cast<osgUtil::LineSegmentIntersector*>(&intersector))
    return intersect_segment(visitor, *segment, *this);
  if (auto* group = dynamic_cast<osgUtil::IntersectorGroup*>(&intersector)) {
    for (auto& each : group->getIntersectors()) intersect(visitor, *each);
    return;
  }
  intersector.intersect(visitor, this);
}

}  // namespace sward::osg_host
