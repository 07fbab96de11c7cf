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

void NearPlane::come_close(osgUtil::CullVisitor& cull, double far_m) const {
  const osg::Vec3d eye = osg::Matrixd::inverse(*cull.getModelViewMatrix()).getTrans();
  const double near_m = near_plane_m(terrain_->surface(), {eye.x(), eye.y(), eye.z()}, canopy_m_);
  // A traversal's ratio outlives its frame; the host's is the camera's.
  const osg::Camera* camera = cull.getCurrentCamera();
  const double own = camera != nullptr ? camera->getNearFarRatio() : cull.getNearFarRatio();
  cull.setNearFarRatio(std::min(own, near_m / far_m));
  // Planes that are computed from primitives know the ground's coarse triangles alone, not what grows on them.
  if (cull.getComputeNearFarMode() != osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES)
    cull.setCalculatedNearPlane(std::min(cull.getCalculatedNearPlane(), near_m));
}

bool NearPlane::cull(osg::NodeVisitor* visitor, osg::Drawable* drawable, osg::RenderInfo*) const {
  osgUtil::CullVisitor* cull = visitor->asCullVisitor();
  if (cull == nullptr) return false;
  const double far_m = far_corner(drawable->getBoundingBox(), *cull->getModelViewMatrix());
  if (far_m > 0) {
    come_close(*cull, std::max(far_m, cull->getCalculatedFarPlane()));
    return false;
  }
  if (drawable->getCullingActive()) return false;
  // OpenSceneGraph would leave out what is wholly behind the eye; a sky is not.
  cull->pushStateSet(drawable->getStateSet());
  cull->addDrawableAndDepth(drawable, cull->getModelViewMatrix(), 0);
  cull->popStateSet();
  return true;
}

}  // namespace sward::osg_host
