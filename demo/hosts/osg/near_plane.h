// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Brings in epoxy's GL header, which must come before OpenSceneGraph's.
#include "host/scene_terrain.h"

#include <memory>
#include <osg/Drawable>

namespace osgUtil {
class CullVisitor;
}

namespace sward::osg_host {

/// How close the near plane has to come, metres: 0.1 where the eye (world) is among plants or a few metres above them,
/// a hundredth of its height above them further up, where depth needs the precision. `canopy_m`: height of the tallest
/// plant.
double near_plane_m(const Surface& surface, glm::dvec3 eye, double canopy_m);

/// Lets the near plane come that close. OpenSceneGraph puts it at the far plane's distance times the viewer's near/far
/// ratio (0.0005: 10 m before the eye for ground of 20 km), because the eye is inside the ground's box. Set as the cull
/// callback of a drawable, this lowers the ratio of the cull traversal that it runs in; a camera's own ratio that is
/// smaller stays. Without an effect where the host computes near and far planes itself (DO_NOT_COMPUTE_NEAR_FAR).
///
/// Drawables that are culled later and lie farther away than the ground push the plane out in proportion.
///
/// A drawable whose culling is switched off, because it has a sky, is drawn even when its box is wholly behind the eye.
/// Cull thread.
class NearPlane : public osg::DrawableCullCallback {
 public:
  NearPlane(std::shared_ptr<const host::SceneTerrain> terrain, double canopy_m)
      : terrain_(std::move(terrain)), canopy_m_(canopy_m) {}
  bool cull(osg::NodeVisitor* visitor, osg::Drawable* drawable, osg::RenderInfo* info) const override;

 private:
  void come_close(osgUtil::CullVisitor& cull, double far_m) const;

  std::shared_ptr<const host::SceneTerrain> terrain_;
  double canopy_m_;
};

}  // namespace sward::osg_host
