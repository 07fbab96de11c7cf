// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "near_plane.h"

#include <algorithm>
#include <cmath>
#include <osgUtil/CullVisitor>

namespace sward::osg_host {

namespace {

constexpr double k_share_of_height = 0.01;

// Distance ahead of the eye of the box's farthest corner.
double far_corner(const osg::BoundingBox& box, const osg::Matrixd& eye_from_local) {
  double farthest = 0;
  for (unsigned i = 0; i < 8; ++i) farthest = std::max(farthest, -(osg::Vec3d(box.corner(i)) * eye_from_local).z());
  return farthest;
}

}  // namespace

double near_plane_m(const Surface& surface, glm::dvec3 eye, double canopy_m) {
  const double ground = surface.height(glm::dvec2(eye));
  const double above = eye.z - canopy_m - (std::isfinite(ground) ? ground : surface.height_range().y);
  return std::max(host::k_near_plane_m, k_share_of_height * above);
}

bool NearPlane::cull(osg::NodeVisitor* visitor, osg::Drawable* drawable, osg::RenderInfo*) const {
  osgUtil::CullVisitor* cull = visitor->asCullVisitor();
  if (cull == nullptr) return false;
  const osg::Matrixd eye_from_local = *cull->getModelViewMatrix();
  const double far_m = std::max(far_corner(drawable->getBoundingBox(), eye_from_local), cull->getCalculatedFarPlane());
  if (!(far_m > 0)) return false;
  const osg::Vec3d eye = osg::Matrixd::inverse(eye_from_local).getTrans();
  const double near_m = near_plane_m(terrain_->surface(), {eye.x(), eye.y(), eye.z()}, canopy_m_);
  cull->setNearFarRatio(std::min(cull->getNearFarRatio(), near_m / far_m));
  // Planes that are computed from primitives know the ground's coarse triangles alone, not what grows on them.
  if (cull->getComputeNearFarMode() != osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES)
    cull->setCalculatedNearPlane(std::min(cull->getCalculatedNearPlane(), near_m));
  return false;
}

}  // namespace sward::osg_host
